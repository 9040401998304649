// What an automaton is at a step, and how it goes on (core/scene/automaton.h).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/automaton/fall_off.h"
#include "core/generate/automaton/grid.h"
#include "core/scene/automaton.h"

namespace awan {

// The bits of all cells: vapour, phase transition, cloud. Each grid.all_words() long.
struct AutomatonState {
    std::uint64_t nx = 0, ny = 0, nz = 0;
    // Of all that is random (models.h).
    std::uint64_t key = 0;
    // rules_key() of the cloud it belongs to.
    std::uint64_t rules = 0;
    // Steps made.
    std::uint64_t step = 0;
    std::vector<std::uint64_t> hum, act, cld;
    // cld after the steps before, the last one first: as many as smooth_steps - 1 or as there were.
    std::vector<std::vector<std::uint64_t>> earlier;
    std::vector<AutomatonEllipsoid> ellipsoids;
};

// Of everything that the bits depend on but the key. Two clouds of one rules_key() go on alike.
std::uint64_t rules_key(const AutomatonCloud& cloud);

// Memory that steps need and nobody keeps.
struct AutomatonScratch {
    // Of the next step.
    std::vector<std::uint64_t> act;
    // Whether any bit of a row is set.
    std::vector<std::uint8_t> row_lives;
    FallOff fall_off;
    // And belongs to the state's ellipsoids.
    bool fall_off_ready = false;
    std::vector<AutomatonEllipsoid> first;
};

// Step 0: hum and act are set with their probabilities, cld is 0 (document 000, below (3.7)).
Result<AutomatonState> first_state(const AutomatonCloud& cloud, std::uint64_t key, int threads,
                                   const Deadline& deadline, AutomatonScratch& scratch);

// One step: the wind moves the ellipsoids; growth, (3.1)-(3.4); supply and extinction, (3.5)-(3.7), with the
// inequalities of document 000 (those of document 001, (6) and (7), are the wrong way round); the wind shifts layers,
// (3.8)-(3.10). All of the bits of one step are read before any of the next is written.
//   f_act = act at (+-1,0,0), (0,+-1,0), (0,0,+-1), (+-2,0,0), (0,0,+-2), (0,-2,0), any of them
Status step_automaton(const AutomatonCloud& cloud, int threads, const Deadline& deadline,
                      AutomatonScratch& scratch, AutomatonState& state);

}  // namespace awan
