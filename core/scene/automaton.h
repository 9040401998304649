// What a cloud of model "automaton" is: clouds grown by a cellular automaton of three bits a cell, after Nagel &
// Raschke 1992 and Dobashi et al. 2000 and Upchurch 2009. The automaton
// itself is in core/generate/automaton.
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
#include "core/scene/automaton_drawing.h"
#include "core/scene/automaton_shape.h"
#include "core/scene/automaton_wind.h"
#include "core/scene/cloud.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

struct AutomatonState;  // core/generate/automaton/state.h
namespace automaton {
class KeptStates;  // core/generate/automaton/kept_states.h
}

// A parcel of wet air: vapour and phase transition are supplied in it, most at its centre, and clouds in it vanish
// fastest at its edge, by d, the distance from the centre in radii (Upchurch 2009, "Controlling Clouds with
// Ellipsoids").
struct AutomatonEllipsoid {
    glm::dvec3 center{0};
    glm::dvec3 radii{8};
};

inline constexpr const char* kCellsWanted = "[x, y, z]: three numbers (cells)";
inline constexpr Range kAutomatonRadius =
    from_to(limits::kMinAutomatonRadius, limits::kMaxAutomatonRadius);

inline constexpr Field kAutomatonEllipsoidFields[] = {
    field<&AutomatonEllipsoid::center>({.name = "center",
                                        .wanted = kCellsWanted,
                                        .range = kAutomatonPlace,
                                        .required = true,
                                        .unit = "cells",
                                        .says = "In cells from the grid's corner."}),
    field<&AutomatonEllipsoid::radii>({.name = "radii",
                                       .wanted = kCellsWanted,
                                       .range = kAutomatonRadius,
                                       .required = true,
                                       .unit = "cells",
                                       .says = "In cells."}),
};
static_assert(covers<AutomatonEllipsoid>(kAutomatonEllipsoidFields));
inline constexpr Table kAutomatonEllipsoidTable{.name = "AutomatonEllipsoid",
                                                .says = "A parcel of wet air, along the axes.",
                                                .fields = kAutomatonEllipsoidFields,
                                                .standard = standard_of<AutomatonEllipsoid>};
template <>
inline const Table& table_of<AutomatonEllipsoid>() {
    return kAutomatonEllipsoidTable;
}

// The random ellipsoid generator of Upchurch 2009: each radius uniform from `smallest` to `largest`, each ellipsoid
// anywhere as long as it lies in the grid. One radius there serves all three axes; here each axis has its own.
struct RandomEllipsoids {
    std::uint64_t count = 30;
    glm::dvec3 smallest{5, 5, 5};
    glm::dvec3 largest{15, 13, 15};
    // Clouds of one condensation level, domes with the automaton's `base` there. None: anywhere.
    std::optional<double> level = 5.0;
};

inline constexpr Field kRandomEllipsoidsFields[] = {
    field<&RandomEllipsoids::count>({.name = "count",
                                     .wanted = "an integer >= 0",
                                     .counts = at_most(limits::kMaxAutomatonEllipsoids),
                                     .says = "How many, with those listed at most 1000."}),
    field<&RandomEllipsoids::smallest>({.name = "smallest",
                                        .wanted = kCellsWanted,
                                        .range = kAutomatonRadius,
                                        .unit = "cells",
                                        .says = "Radii, in cells."}),
    field<&RandomEllipsoids::largest>(
        {.name = "largest",
         .wanted = kCellsWanted,
         .range = kAutomatonRadius,
         .unit = "cells",
         .says = "Radii, in cells; each is drawn evenly from `smallest` to this."}),
    field<&RandomEllipsoids::level>(
        {.name = "level",
         .wanted = R"(a number (cells) or "any")",
         .range = kAutomatonPlace,
         .absent = "any",
         .unit = "cells",
         .says = "Height of all centres in cells, or \"any\" within the grid."}),
};
static_assert(covers<RandomEllipsoids>(kRandomEllipsoidsFields));
inline constexpr Table kRandomEllipsoidsTable{.name = "AutomatonRandom",
                                              .says = "Ellipsoids drawn at random within the grid.",
                                              .fields = kRandomEllipsoidsFields,
                                              .standard = standard_of<RandomEllipsoids>};
template <>
inline const Table& table_of<RandomEllipsoids>() {
    return kRandomEllipsoidsTable;
}

// Which of several ellipsoids that contain a cell says its probabilities: the first one (Upchurch 2009; its edge then
// cuts through the middle of others), or the one in which the cell lies deepest (the smallest d).
enum class AutomatonOverlap { kDeepest, kFirst };
inline constexpr const char* kAutomatonOverlapWords[] = {"deepest", "first"};

struct AutomatonCloud {
    // Whole numbers.
    glm::dvec3 cells{96, 32, 96};
    double cell = 5;

    std::vector<AutomatonEllipsoid> ellipsoids;
    // Further ones. Where neither these nor `ellipsoids` are given: RandomEllipsoids{}.
    std::optional<RandomEllipsoids> random;
    AutomatonOverlap overlap = AutomatonOverlap::kDeepest;
    // Clouds are flat there. 0: none.
    double base = 5;

    // Probabilities a step, each a damping factor of Upchurch 2009 (without, "puff-balls"): p_hum = humidity F(d) in an
    // ellipsoid, else 0; p_act = activation F(d), else 0; p_ext = extinction (1 - F(d)), else outside_extinction, for
    // which Upchurch's 0 leaves stranded clouds for ever.
    double humidity = 0.1;
    double activation = 0.002;
    double extinction = 0.12;
    double outside_extinction = 0.25;
    // F. Linear in Upchurch 2009, which calls one that the user defines "an interesting extension".
    AutomatonShape fall_off = AutomatonShape::kLinear;
    // Of kTable.
    std::vector<float> fall_off_table;

    AutomatonWind wind;

    // At time t (seconds) warm_up + t steps_per_second steps have been made, never fewer than 0 nor more than `steps`;
    // between two steps density is interpolated.
    std::uint64_t warm_up = 40;
    double steps_per_second = 1;
    std::uint64_t steps = 1000;

    // Density of a cell, 0..1: the weighted mean of cld over (2i+1)(2j+1)(2k+1) cells (i, j, k whole numbers) and the
    // last `smooth_steps` steps (q of Dobashi et al. 2000). The weight w(i', j', k') of Upchurch 2009, who does not say
    // which it is, is F(|i'|/(i+1)) F(|j'|/(j+1)) F(|k'|/(k+1)); even: 1.
    glm::dvec3 smooth{1, 1, 1};
    AutomatonWeight smooth_weight = AutomatonWeight::kEven;
    // Of kTable.
    std::vector<float> smooth_weight_table;
    std::uint64_t smooth_steps = 1;
    // Each cell is a metaball of this effective radius; drawn as the Gaussian of the same mass and second moment.
    double metaball_radius = 2;
    double threshold = 0;
    std::uint64_t most_particles = 1u << 20;

    // Of the look "upchurch".
    AutomatonDrawing drawing;
    // The ellipsoid that the display "ellipsoids" shows in red, by its number: those listed first, then the random
    // ones.
    std::optional<std::uint64_t> chosen;

    // Where to begin instead of at step 0: the latest of those that are not too late. Set by the command line, never by
    // a document; it changes nothing but the time taken.
    std::vector<std::shared_ptr<const AutomatonState>> starts{};
    // Where states are kept for other frames; null: nowhere.
    std::shared_ptr<automaton::KeptStates> kept{};
};

inline constexpr Field kAutomatonFields[] = {
    field<&AutomatonCloud::cells>({.name = "cells",
                                   .wanted = "[x, y, z]: three whole numbers",
                                   .range = from_to(1, limits::kMaxAutomatonSide),
                                   .whole = true,
                                   .says = "The grid, at most 67108864 cells in all."}),
    field<&AutomatonCloud::cell>(
        {.name = "cell",
         .wanted = "a number > 0 (units)",
         .range = from_to(limits::kMinAutomatonCell, limits::kMaxAutomatonCell),
         .unit = "units",
         .says = "Length of a cell, scene units. The middle of the grid's floor is the cloud's "
                 "origin."}),
    field<&AutomatonCloud::ellipsoids>(
        {.name = "ellipsoids",
         .wanted = "a list of ellipsoids",
         .counts = at_most(limits::kMaxAutomatonEllipsoids),
         .says = "Parcels of wet air; without these and `random`, the default of `random`."}),
    field<&AutomatonCloud::random>(
        {.name = "random",
         .wanted = "an object",
         .says = "Further parcels of wet air.",
         .otherwise = "one of the defaults, where no ellipsoids are given"}),
    field<&AutomatonCloud::overlap>({.name = "overlap",
                                     .words = kAutomatonOverlapWords,
                                     .says = "Which of several ellipsoids says a cell's "
                                             "probabilities: that in which it lies deepest, or the "
                                             "first."}),
    field<&AutomatonCloud::base>({.name = "base",
                                  .wanted = "a number (cells)",
                                  .range = kAutomatonPlace,
                                  .unit = "cells",
                                  .says = "Cells; no vapour is supplied below."}),
    field<&AutomatonCloud::humidity>({.name = "humidity",
                                      .wanted = "a number from 0 to 1",
                                      .range = from_to(0, 1),
                                      .says = "Probability a step that vapour comes to the middle "
                                              "of an ellipsoid; linear to 0 at its edge."}),
    field<&AutomatonCloud::activation>(
        {.name = "activation",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "Probability a step of a phase transition, likewise."}),
    field<&AutomatonCloud::extinction>(
        {.name = "extinction",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "Probability a step that a cloud vanishes at the edge of an ellipsoid; linear to "
                 "0 at its middle."}),
    field<&AutomatonCloud::outside_extinction>({.name = "outside_extinction",
                                                .wanted = "a number from 0 to 1",
                                                .range = from_to(0, 1),
                                                .says = "The same outside of all ellipsoids."}),
    field<&AutomatonCloud::fall_off>(
        {.name = "fall_off",
         .words = kAutomatonShapeWords,
         .says = "How vapour and phase transition fall off from an ellipsoid's middle (1) to its "
                 "edge, over the distance d: linear 1 - d, quadratic 1 - d^2, smooth 1 - 3 d^2 + 2 "
                 "d^3, or a table's; vanishing is what is left of 1."}),
    field<&AutomatonCloud::fall_off_table>(shape_table(
        {.name = "fall_off_table",
         .says =
             "Of fall_off \"table\": 2 to 64 values at equal steps from the middle to the edge, "
             "straight between them.",
         .idle =
             [](const void* o) {
                 return static_cast<const AutomatonCloud*>(o)->fall_off != AutomatonShape::kTable;
             }})),
    field<&AutomatonCloud::wind>({.name = "wind", .wanted = "an object", .says = "What moves."}),
    field<&AutomatonCloud::warm_up>({.name = "warm_up",
                                     .wanted = "an integer >= 0",
                                     .counts = at_most(limits::kMaxAutomatonSteps),
                                     .says = "Steps made at time 0; at most `steps`."}),
    field<&AutomatonCloud::steps_per_second>(
        {.name = "steps_per_second",
         .wanted = "a number >= 0",
         .range = from_to(0, limits::kMaxStepsPerSecond),
         .says = "Steps made a second; between two steps density is interpolated."}),
    field<&AutomatonCloud::steps>(
        {.name = "steps",
         .wanted = "an integer >= 0",
         .counts = at_most(limits::kMaxAutomatonSteps),
         .says =
             "The last step; later the cloud stands still. Cells times steps are at most 2^36."}),
    field<&AutomatonCloud::smooth>(
        {.name = "smooth",
         .wanted = "[x, y, z]: three whole numbers (cells)",
         .range = from_to(0, limits::kMaxAutomatonSmooth),
         .whole = true,
         .unit = "cells",
         .says = "i, j, k: density is the mean of (2i+1)(2j+1)(2k+1) cells."}),
    field<&AutomatonCloud::smooth_weight>(
        {.name = "smooth_weight",
         .words = kAutomatonWeightWords,
         .says = "How much each of them counts: even, all alike; else the product of how much it "
                 "does along each axis, by its distance over (i+1), (j+1), (k+1), falling off as "
                 "`fall_off` does."}),
    field<&AutomatonCloud::smooth_weight_table>(shape_table(
        {.name = "smooth_weight_table",
         .says = "Of smooth_weight \"table\": 2 to 64 values at equal steps, the first above 0.",
         .idle =
             [](const void* o) {
                 return static_cast<const AutomatonCloud*>(o)->smooth_weight !=
                        AutomatonWeight::kTable;
             }})),
    field<&AutomatonCloud::smooth_steps>({.name = "smooth_steps",
                                          .wanted = "an integer >= 1",
                                          .counts = count_from_to(1, limits::kMaxAutomatonHistory),
                                          .says = "And of so many steps, the last ones."}),
    field<&AutomatonCloud::metaball_radius>(
        {.name = "metaball_radius",
         .wanted = "a number (cells)",
         .range = from_to(limits::kMinMetaballRadius, limits::kMaxMetaballRadius),
         .unit = "cells",
         .says = "Effective radius of a cell's metaball, in cells."}),
    field<&AutomatonCloud::threshold>({.name = "threshold",
                                       .wanted = "a number from 0 to 1",
                                       .range = from_to(0, 1),
                                       .says = "Cells of at most this density make no particle."}),
    field<&AutomatonCloud::most_particles>(
        {.name = "most_particles",
         .wanted = "an integer >= 1",
         .counts = count_from_to(1, limits::kMaxParticles),
         .says = "More cells with matter are merged, 2x2x2, 4x4x4, ... to one particle."}),
    field<&AutomatonCloud::drawing>({.name = "drawing",
                                     .wanted = "an object",
                                     .says = "How the look upchurch draws the cells."}),
    field<&AutomatonCloud::chosen>(
        {.name = "chosen",
         .wanted = "an integer >= 0",
         .counts = at_most(limits::kMaxAutomatonEllipsoids - 1),
         .says = "Number of the ellipsoid that the display `ellipsoids` shows in red: those listed "
                 "first, then the random ones.",
         .otherwise = "none"}),
    outside_document<&AutomatonCloud::starts>("only where to begin; the cloud is the same"),
    outside_document<&AutomatonCloud::kept>("only where to begin; the cloud is the same"),
};
static_assert(covers<AutomatonCloud>(kAutomatonFields));
inline constexpr Table kAutomatonTable{
    .name = "Automaton",
    .says =
        "A cellular automaton of three bits a cell: vapour, phase transition and cloud (Nagel & "
        "Raschke 1992, Dobashi "
        "et al. 2000, Upchurch 2009).",
    .fields = kAutomatonFields,
    .standard = standard_of<AutomatonCloud>};

// The ellipsoids to be drawn by chance, if any.
RandomEllipsoids random_ellipsoids_of(const AutomatonCloud& cloud);
// Steps made at time t: from 0 to cloud.steps.
double automaton_steps_at(const AutomatonCloud& cloud, double time);

// Equal for clouds whose automata have the same bits at every step (with the same seed): all fields but those that only
// say how bits become particles, or which step is looked at.
std::string automaton_rules_of(const AutomatonCloud& cloud);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const AutomatonCloud& cloud);

}  // namespace awan
