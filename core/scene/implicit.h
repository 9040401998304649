// What a cloud of model "implicit" is: volumetric implicit functions (Ebert 2002).
//
// Macrostructure: primitives, each a weight and a density that falls off from it (Wyvill, McPheeters & Wyvill 1986),
//   m(p) = max(0, sum_i w_i h(r_i / R_i)),  h(a) = -4/9 a^6 + 17/9 a^4 - 22/9 a^2 + 1 for a <= 1, else 0,
// r_i the distance from p to the closest point q_i of primitive i, R_i its radius of influence.
// Microstructure: turbulence t (octaves of gradient noise) moves the point before m is taken there, and
//   density = (p1 (p3 m + (1 - p3) t m))^p2,
// p1 `amount`, p2 `exponent`, p3 `blend`, p4 `displacement`. All of it is a multiple of the cloud's density (1/unit).
//
// Positions, radii and points are in units. What is a matter of style is in mean radii: of the primitives as they are
// described (without keys), or of the growth's particles, the procedures' or the table's where there are none. So a
// cloud described twice as large looks the same.
//
// A formula (formula.h) has the last word: it is given that density and says another.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/cloud.h"
#include "core/scene/implicit_growth.h"
#include "core/scene/implicit_keys.h"
#include "core/scene/implicit_primitive.h"
#include "core/scene/implicit_procedures.h"
#include "core/scene/implicit_warps.h"
#include "core/scene/interpolation.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Sets of defaults; fields that are given override them.
enum class ImplicitPreset { kCumulus, kCirrus, kStratus, kMackerel, kCreature };
inline constexpr const char* kImplicitPresetWords[] = {"cumulus", "cirrus", "stratus", "mackerel",
                                                       "creature"};

// As given; resolved() below fills in the rest.
struct ImplicitCloud {
    ImplicitPreset preset = ImplicitPreset::kCumulus;
    // None: the preset's, or none beside what makes primitives of its own (the next five).
    std::optional<std::vector<ImplicitPrimitive>> primitives;
    std::optional<ImplicitGrowth> growth;
    std::optional<ImplicitBubbles> bubbles;
    std::optional<ImplicitBillows> billows;
    std::optional<ImplicitCells> cells;
    std::vector<ImplicitParticle> particles;
    // In rising order of time.
    std::vector<ImplicitCloudKey> keys;
    // Straight, else smoothstep.
    bool linear_keys = false;
    // Soft over a fifth of a mean radius.
    std::optional<double> base;

    std::optional<double> amount;
    std::optional<double> exponent;
    std::optional<double> blend;
    std::optional<double> displacement;
    // Ebert moves points along (1, -1, 1) by the turbulence, which is positive: the whole cloud shifts. Else each axis
    // has noise of its own around 0.
    bool diagonal = false;
    std::optional<double> noise_size;
    std::optional<std::uint64_t> octaves;
    std::optional<double> gain;
    std::optional<double> stretch;

    std::optional<glm::dvec3> jet;
    std::optional<double> jet_turbulence;
    // Warps (jet, flow, attractors, vortices) come in smoothly between these times; where to <= from they are always in
    // full.
    double warp_from = 0;
    double warp_to = 0;
    std::vector<ImplicitAttractor> attractors;
    std::vector<ImplicitVortex> vortices;
    std::optional<ImplicitFlow> flow;
    std::optional<ImplicitSquash> squash;

    // Mackerel: the density times 1 - depth (1 - s_x s_y s_z), s = (1 + sin(2 pi x / wavelength + turbulence t)) / 2,
    // for axes with a wavelength > 0, mean radii.
    std::optional<glm::dvec3> ripple;
    std::optional<double> ripple_depth;
    std::optional<double> ripple_turbulence;

    // In Ebert's frames a second: 30 is video.
    double swirl = 3;
    // Ebert's path winds out for ever, and its noise coarsens into chaos with the frame number. Else the same path
    // without these two.
    bool printed_swirl = false;

    std::optional<std::string> formula;

    std::uint64_t resolution = 96;
    double threshold = 0.004;
};

inline constexpr const char* kDisplaceWords[] = {"every_way", "diagonal"};
inline constexpr const char* kSwirlPathWords[] = {"steady", "printed"};
inline constexpr const char* kOfPreset = "the preset's";

inline constexpr Field kImplicitFields[] = {
    field<&ImplicitCloud::preset>({.name = "preset",
                                   .words = kImplicitPresetWords,
                                   .says = "A set of defaults that the other fields override."}),
    field<&ImplicitCloud::primitives>({.name = "primitives",
                                       .wanted = "a list of primitives",
                                       .counts = at_most(limits::kMaxImplicitElements),
                                       .says =
                                           "Instead of the preset's. Density is the sum of their "
                                           "weights times Wyvill's cubic of distance over "
                                           "radius, at least 0.",
                                       .otherwise = "the preset's, or none beside a growth, "
                                                    "procedures or particles"}),
    field<&ImplicitCloud::linear_keys>(
        {.name = "interpolation", .words = kInterpolationWords, .says = "Between keys."}),
    field<&ImplicitCloud::base>({.name = "base",
                                 .wanted = "a number (height of a flat base)",
                                 .range = kImplicitPlace,
                                 .unit = "units",
                                 .says = "Height of a flat base; nothing is below it.",
                                 .otherwise = "the preset's with its primitives, else none"}),
    field<&ImplicitCloud::amount>(
        {.name = "amount",
         .wanted = "a number >= 0",
         .range = from_to(0, limits::kMaxImplicitAmount),
         .says =
             "p1: density = (p1 (p3 m + (1 - p3) t m))^p2, m of the primitives, t the turbulence.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::exponent>(
        {.name = "exponent",
         .wanted = "a number > 0",
         .range = from_to(limits::kMinImplicitExponent, limits::kMaxImplicitExponent),
         .says = "p2.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::blend>({.name = "blend",
                                  .wanted = "a number from 0 (turbulence) to 1 (primitives alone)",
                                  .range = from_to(0, 1),
                                  .says = "p3; 1: by the primitives alone.",
                                  .otherwise = kOfPreset}),
    field<&ImplicitCloud::displacement>(
        {.name = "displacement",
         .wanted = "a number >= 0 (mean radii)",
         .range = from_to(0, limits::kMaxDisplacement),
         .unit = "mean radii",
         .says = "p4: how far the turbulence moves points, mean radii of the primitives.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::diagonal>({.name = "displace",
                                     .words = kDisplaceWords,
                                     .says = "diagonal: as printed, all along (1, -1, 1)."}),
    field<&ImplicitCloud::noise_size>(
        {.name = "noise_size",
         .wanted = "a number > 0 (of the largest bumps, mean radii)",
         .range = from_to(limits::kMinNoiseSize, limits::kMaxNoiseSize),
         .unit = "mean radii",
         .says = "Of the largest bumps, mean radii.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::octaves>({.name = "octaves",
                                    .wanted = "an integer from 1 to 10",
                                    .counts = count_from_to(1, limits::kMaxOctaves),
                                    .says = "Each half the size of the one before.",
                                    .otherwise = kOfPreset}),
    field<&ImplicitCloud::gain>(
        {.name = "gain",
         .wanted = "a number from 0 to 1 (strength of an octave over that of the one before)",
         .range = from_to(0, 1),
         .says = "Strength of an octave over that of the one before; 0.5 is 1/f.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::stretch>({.name = "stretch",
                                    .wanted = "a number >= 1 (of the noise along the jet stream)",
                                    .range = from_to(1, limits::kMaxStretch),
                                    .says = "Of the noise along the jet stream.",
                                    .otherwise = kOfPreset}),
    field<&ImplicitCloud::jet>(
        {.name = "jet",
         .wanted = "[x, y, z]: three numbers (mean radii)",
         .range = within(limits::kMaxJet),
         .unit = "mean radii",
         .says =
             "The jet stream: the cloud's top is blown so far, its bottom not at all; mean radii.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::jet_turbulence>(
        {.name = "jet_turbulence",
         .wanted = "a number >= 0",
         .range = from_to(0, 10),
         .says = "Adds (.2, .3, .25) times this and the turbulence to the jet stream.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::warp_from>({.name = "warp_from",
                                      .wanted = "a number (seconds)",
                                      .range = within(limits::kMaxTime),
                                      .unit = "seconds",
                                      .says =
                                          "Seconds. The jet stream, flow, attractors and vortices "
                                          "come in smoothly from here to `warp_to`; where "
                                          "that is not later they are always in full."}),
    field<&ImplicitCloud::warp_to>({.name = "warp_to",
                                    .wanted = "a number (seconds)",
                                    .range = within(limits::kMaxTime),
                                    .unit = "seconds",
                                    .says = "Seconds."}),
    field<&ImplicitCloud::attractors>({.name = "attractors",
                                       .wanted = "a list of attractors",
                                       .counts = at_most(limits::kMaxImplicitWarps),
                                       .says = "Draw matter in or push it away."}),
    field<&ImplicitCloud::vortices>({.name = "vortices",
                                     .wanted = "a list of vortices",
                                     .counts = at_most(limits::kMaxImplicitWarps),
                                     .says = "Turn matter about an axis."}),
    field<&ImplicitCloud::flow>(
        {.name = "flow", .wanted = "an object", .says = "A vector flow table."}),
    field<&ImplicitCloud::ripple>({.name = "ripple",
                                   .wanted = "[x, y, z]: three wavelengths (mean radii; 0: none)",
                                   .range = from_to(limits::kMinRipple, limits::kMaxRipple),
                                   .or_zero = true,
                                   .unit = "mean radii",
                                   .says = "Wavelengths of the waves that modulate the density, "
                                           "mean radii; 0: none along that axis.",
                                   .otherwise = kOfPreset}),
    field<&ImplicitCloud::ripple_depth>({.name = "ripple_depth",
                                         .wanted = "a number from 0 to 1",
                                         .range = from_to(0, 1),
                                         .says = "How much of the density the waves take.",
                                         .otherwise = kOfPreset}),
    field<&ImplicitCloud::ripple_turbulence>(
        {.name = "ripple_turbulence",
         .wanted = "a number >= 0 (radians)",
         .range = from_to(0, 100),
         .unit = "radians",
         .says = "Radians by which the turbulence moves the waves' phase.",
         .otherwise = kOfPreset}),
    field<&ImplicitCloud::swirl>(
        {.name = "swirl",
         .wanted = "a number (frames a second)",
         .range = within(limits::kMaxSwirl),
         .unit = "frames a second",
         .says = "Frames a second of the path along which the noise moves."}),
    field<&ImplicitCloud::printed_swirl>(
        {.name = "swirl_path",
         .words = kSwirlPathWords,
         .says = "printed: the path winds out for ever and its noise coarsens."}),
    field<&ImplicitCloud::growth>({.name = "growth",
                                   .wanted = "an object",
                                   .says = "A particle system whose particles are primitives."}),
    field<&ImplicitCloud::bubbles>(
        {.name = "bubbles", .wanted = "an object", .says = "Bubbles of warm air rise."}),
    field<&ImplicitCloud::billows>(
        {.name = "billows", .wanted = "an object", .says = "Kelvin-Helmholtz billows roll up."}),
    field<&ImplicitCloud::cells>(
        {.name = "cells", .wanted = "an object", .says = "Benard cells turn over."}),
    field<&ImplicitCloud::particles>(
        {.name = "particles",
         .wanted = "a list of particles",
         .counts = at_most(limits::kMaxImplicitRows),
         .says =
             "Spheres moved by a particle system elsewhere: a row for each particle and time, in "
             "any order."}),
    field<&ImplicitCloud::keys>(
        {.name = "keys",
         .wanted = "a list of keys",
         .counts = at_most(limits::kMaxImplicitKeys),
         .says = "Of the cloud's own parameters, in rising order of time."}),
    field<&ImplicitCloud::squash>(
        {.name = "squash", .wanted = "an object", .says = "Squash and stretch."}),
    field<&ImplicitCloud::formula>(
        {.name = "formula",
         .wanted = "a formula",
         .counts = at_most(limits::kMaxFormulaBytes),
         .says = "Of the density, from 0 to 1000, at each place. It is given density (that of the "
                 "model), mdens (of the primitives), turb (the turbulence), x, y, z, height, time, "
                 "seed, and may use noise, turbulence, fbm, primitives.",
         .otherwise = "density"}),
    field<&ImplicitCloud::resolution>(
        {.name = "resolution",
         .wanted = "an integer from 16 to 400 (cells along the longest side)",
         .counts = count_from_to(limits::kMinImplicitResolution, limits::kMaxImplicitResolution),
         .says = "Cells along the longest side; each with any density becomes a particle. Never "
                 "more than 160^3 in "
                 "all."}),
    field<&ImplicitCloud::threshold>({.name = "threshold",
                                      .wanted = "a number from 0 to 0.5 (of the largest density)",
                                      .range = from_to(0, 0.5),
                                      .says = "Of the largest density: cells below are left out."}),
};
static_assert(covers<ImplicitCloud>(kImplicitFields));
inline constexpr Table kImplicitTable{.name = "Implicit",
                                      .says = "Ebert's volumetric implicit functions.",
                                      .fields = kImplicitFields,
                                      .standard = standard_of<ImplicitCloud>};

// With all that a preset decides. Of any cloud.
struct ImplicitSettings {
    std::vector<ImplicitPrimitive> primitives;
    std::optional<double> base;
    double amount = 0, exponent = 1, blend = 1, displacement = 0;
    double noise_size = 1, gain = 0.5, stretch = 1;
    std::uint64_t octaves = 1;
    glm::dvec3 jet{0};
    double jet_turbulence = 0;
    glm::dvec3 ripple{0};
    double ripple_depth = 0, ripple_turbulence = 0;
    double mean_radius = 1;  // units
    // What share of the warps there is; keys alone say less than all.
    double warp = 1;
};
ImplicitSettings resolved(const ImplicitCloud& cloud);

// Whether it has a growth, procedures or particles, which stand for the preset's primitives.
bool makes_primitives(const ImplicitCloud& cloud);

// The same cloud with every field given that a preset may decide: equal for clouds that come to the same.
ImplicitCloud spelled_out(const ImplicitCloud& cloud);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const ImplicitCloud& cloud);

}  // namespace awan
