// What an automaton is at a step, and how it goes on (core/scene/automaton.h).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/automaton/fall_off.h"
#include "core/generate/automaton/grid.h"
#include "core/scene/automaton.h"

namespace awan {

// The bits of all cells: vapour (hum), phase transition (act), cloud (cld). Each is grid.all_words() long.
struct AutomatonState {
    std::uint64_t nx = 0, ny = 0, nz = 0;
    // The key of all that is random (ModelRequest in models.h).
    std::uint64_t key = 0;
    // rules_key() of the cloud that it belongs to.
    std::uint64_t rules = 0;
    // How many steps have been made.
    std::uint64_t step = 0;
    std::vector<std::uint64_t> hum, act, cld;
    // The cloud bits after the steps before, the last one first: smooth_steps - 1 of them, or as many as there were.
    std::vector<std::vector<std::uint64_t>> earlier;
    std::vector<AutomatonEllipsoid> ellipsoids;
};

}  // namespace awan

namespace awan::automaton {

// A key of everything that the bits depend on but `key`. Two clouds of one rules_key() go on alike.
std::uint64_t rules_key(const AutomatonCloud& cloud);

// Memory that steps use and nobody keeps.
struct AutomatonScratch {
    // The activation bits of the next step.
    std::vector<std::uint64_t> act;
    // Of each row: whether any bit is set.
    std::vector<std::uint8_t> row_lives;
    FallOff fall_off;
    // Whether fall_off belongs to the state's ellipsoids.
    bool fall_off_ready = false;
    std::vector<AutomatonEllipsoid> first;
};

// Step 0: hum and act are set with their probabilities, cld is 0 (Sunar et al. 2005, below (3.7)).
Result<AutomatonState> first_state(const AutomatonCloud& cloud, std::uint64_t key, int threads,
                                   const Deadline& deadline, AutomatonScratch& scratch);

// One step, in the order of Sunar et al. 2005 (which follows Nagel & Raschke 1992 and Dobashi et al. 2000): the wind
// moves the ellipsoids;
//   growth (3.1)-(3.4):    hum' = hum & !act,    cld' = cld | act,    act' = !act & hum & f_act,
//   f_act = any act at (+-1,0,0), (0,+-1,0), (0,0,+-1), (+-2,0,0), (0,0,+-2), (0,-2,0);
//   chance (3.5)-(3.7):    cld &= random > p_ext,    hum |= random < p_hum,    act |= random < p_act;
// the wind shifts layers (3.8)-(3.10). All bits of one step are read before any of the next is written. Upchurch 2009
// prints the inequalities of (3.6) and (3.7) the wrong way round, as (6) and (7).
Status step_automaton(const AutomatonCloud& cloud, int threads, const Deadline& deadline,
                      AutomatonScratch& scratch, AutomatonState& state);

}  // namespace awan::automaton
