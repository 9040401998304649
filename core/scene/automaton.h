// What a cloud of model "automaton" is: clouds grown by a cellular automaton of three bits a cell, after Nagel & Raschke 1992
// and Dobashi et al. 2000 (document 000, section 3.2) and Upchurch 2009 (document 001). The automaton itself is in
// core/generate/automaton.
//
// Lengths are in cells where nothing else is said, x along the wind, y up: cell (i, j, k) is the cube from (i, j, k) to
// (i + 1, j + 1, k + 1). In the cloud's own coordinates the grid stands with the middle of its floor at the origin.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace awan {

struct AutomatonState;  // core/generate/automaton/state.h

// A parcel of wet air: vapour and phase transition are supplied in it, most at its centre, and clouds in it vanish fastest
// at its edge; all linear in d, the distance from the centre in radii (document 001, "Controlling Clouds with Ellipsoids").
struct AutomatonEllipsoid {
    glm::dvec3 center{0};
    glm::dvec3 radii{8};
};

// The random ellipsoid generator of document 001: each radius uniform from `smallest` to `largest`, each ellipsoid anywhere
// as long as it lies in the grid. One radius there serves all three axes; here each axis has its own.
struct RandomEllipsoids {
    std::uint64_t count = 30;
    glm::dvec3 smallest{5, 5, 5};
    glm::dvec3 largest{15, 13, 15};
    // Height of all centres: clouds of one condensation level, domes with the automaton's `base` there. None: anywhere.
    std::optional<double> level = 5.0;
};

// Which of several ellipsoids that contain a cell says its probabilities: the first one (document 001; its edge then cuts
// through the middle of others), or the one in which the cell lies deepest (the smallest d).
enum class AutomatonOverlap { kDeepest, kFirst };

// Of height y (cells): constant + linear y + quadratic y^2, cells a step towards +x.
struct AutomatonSpeed {
    double constant = 0, linear = 0, quadratic = 0;
    bool operator==(const AutomatonSpeed&) const = default;
};

// Moves the ellipsoids whose centre's y is from `from` to `to`; those in several bands by the sum (document 001, "Cloud
// Advection by Wind").
struct AutomatonWindBand {
    double from = 0, to = 1024;
    AutomatonSpeed speed;
};

struct AutomatonWind {
    // All three bits of a layer of cells shift by v(j + 1/2) a step, document 000 (3.8)-(3.10): whole cells, the fractions
    // of slow winds saved up. Nothing comes in at the border.
    AutomatonSpeed layers;
    std::vector<AutomatonWindBand> ellipsoids;
    // An ellipsoid that has left the grid comes back at the upwind side, at a random y and z, its radii those of the
    // beginning times 1 - mutation .. 1 + mutation.
    double mutation = 0.25;
};

struct AutomatonCloud {
    glm::dvec3 cells{96, 32, 96};  // whole numbers
    double cell = 5;               // length of a cell, units

    std::vector<AutomatonEllipsoid> ellipsoids;
    // Further ones. Where neither these nor `ellipsoids` are given: RandomEllipsoids{}.
    std::optional<RandomEllipsoids> random;
    AutomatonOverlap overlap = AutomatonOverlap::kDeepest;
    double base = 5;  // no vapour is supplied to cells below: clouds are flat there. 0: none

    // Probabilities a step, 0..1, each a damping factor of document 001 (without, "puff-balls"):
    double humidity = 0.1;      // p_hum = humidity (1 - d) in an ellipsoid, else 0
    double activation = 0.002;  // p_act = activation (1 - d) in an ellipsoid, else 0
    double extinction = 0.12;   // p_ext = extinction d in an ellipsoid
    double outside_extinction =
        0.25;  // p_ext elsewhere: 0 (document 001) leaves stranded clouds for ever

    AutomatonWind wind;

    // At time t (seconds) warm_up + t steps_per_second steps have been made, never fewer than 0 nor more than `steps`;
    // between two steps density is interpolated.
    std::uint64_t warm_up = 40;
    double steps_per_second = 1;
    std::uint64_t steps = 1000;

    // Density of a cell, 0..1: the mean of cld over (2i+1)(2j+1)(2k+1) cells and the last `smooth_steps` steps (Dobashi et
    // al.'s q, weights 1).
    glm::dvec3 smooth{1, 1, 1};  // i, j, k; whole numbers
    std::uint64_t smooth_steps = 1;
    // Each cell is a metaball of this effective radius, in cells; drawn as the Gaussian of the same mass and second moment.
    double metaball_radius = 2;
    double threshold = 0;  // cells of at most this density make no particle
    // More cells than these with matter are merged, 2x2x2, 4x4x4, ... to one Gaussian, until they are no more.
    std::uint64_t most_particles = 1u << 20;

    // Where to begin instead of at step 0, if it fits: set by the command line, never by a document, and it changes nothing
    // but the time taken.
    std::shared_ptr<const AutomatonState> start;
};

// The ellipsoids to be drawn, if any.
RandomEllipsoids random_ellipsoids_of(const AutomatonCloud& cloud);
// Steps made at time t: from 0 to cloud.steps.
double automaton_steps_at(const AutomatonCloud& cloud, double time);

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are. Not `start`.
std::vector<double> figures_of(const AutomatonCloud& cloud);
// Of these, what the bits of the automaton depend on.
std::vector<double> automaton_rules_of(const AutomatonCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "automaton".
Status check_automaton(const AutomatonCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const AutomatonCloud& cloud);

}  // namespace awan
