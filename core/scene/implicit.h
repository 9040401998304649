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
// described (without keys), or of the growth's particles where there are none. So a cloud described twice as large
// looks the same.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/cloud.h"
#include "core/scene/interpolation.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Sets of defaults; fields that are given override them.
enum class ImplicitPreset { kCumulus, kCirrus, kStratus, kMackerel, kCreature };
inline constexpr const char* kImplicitPresetWords[] = {"cumulus", "cirrus", "stratus", "mackerel",
                                                       "creature"};

enum class ImplicitShape {
    // The closest point q is within `core` of the centre.
    kSphere,
    // A sphere scaled by `radii`.
    kEllipsoid,
    // Solid, flat ends at two `points`, of radius `core`.
    kCylinder,
    // A skeleton: q is within `core` of the line through `points`.
    kSegment,
};
inline constexpr const char* kImplicitShapeWords[] = {"sphere", "ellipsoid", "cylinder", "segment"};

inline constexpr Range kImplicitPlace = within(limits::kMaxImplicitCoordinate);
inline constexpr Range kImplicitRadius =
    from_to(limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
inline constexpr Range kImplicitWeight = within(limits::kMaxImplicitWeight);
inline constexpr const char* kPointWanted = "[x, y, z]: three numbers";

// What is given holds at that time; between keys that have it a value is interpolated, before the first and after the
// last it holds.
struct ImplicitKey {
    // The keys of a primitive rise.
    double time = 0;
    std::optional<glm::dvec3> center;
    std::optional<double> radius;
    std::optional<double> weight;
};

inline constexpr Field kImplicitKeyFields[] = {
    field<&ImplicitKey::time>({.name = "time",
                               .wanted = "a number (seconds)",
                               .range = within(limits::kMaxTime),
                               .required = true,
                               .unit = "seconds",
                               .says = "Seconds."}),
    field<&ImplicitKey::center>({.name = "center",
                                 .wanted = kPointWanted,
                                 .range = kImplicitPlace,
                                 .unit = "units",
                                 .says = "Where it is then.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::radius>({.name = "radius",
                                 .wanted = "a number > 0",
                                 .range = kImplicitRadius,
                                 .unit = "units",
                                 .says = "Its radius of influence then.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::weight>({.name = "weight",
                                 .wanted = "a number",
                                 .range = kImplicitWeight,
                                 .says = "Its weight then.",
                                 .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitKey>(kImplicitKeyFields));
inline constexpr Table kImplicitKeyTable{.name = "ImplicitKey",
                                         .says = "What a primitive is at one time.",
                                         .fields = kImplicitKeyFields,
                                         .standard = standard_of<ImplicitKey>};
template <>
inline const Table& table_of<ImplicitKey>() {
    return kImplicitKeyTable;
}

struct ImplicitPrimitive {
    ImplicitShape shape = ImplicitShape::kSphere;
    glm::dvec3 center{0};
    double radius = 1;
    glm::dvec3 radii{1};
    double core = 0;
    std::vector<glm::dvec3> points;
    // Turns ellipsoids and points.
    glm::dvec3 rotate{0};
    double weight = 1;
    std::vector<ImplicitKey> keys;
};

inline constexpr Field kImplicitPrimitiveFields[] = {
    field<&ImplicitPrimitive::shape>(
        {.name = "shape", .words = kImplicitShapeWords, .says = "From what distances are taken."}),
    field<&ImplicitPrimitive::center>({.name = "center",
                                       .wanted = kPointWanted,
                                       .range = kImplicitPlace,
                                       .unit = "units",
                                       .says = "Units."}),
    field<&ImplicitPrimitive::radius>({.name = "radius",
                                       .wanted = "a number > 0",
                                       .range = kImplicitRadius,
                                       .unit = "units",
                                       .says = "Of influence, from the primitive outward; units."}),
    field<&ImplicitPrimitive::radii>(
        {.name = "radii",
         .wanted = "[x, y, z]: three numbers > 0 (times the radius)",
         .range = from_to(limits::kMinImplicitRadii, limits::kMaxImplicitRadii),
         .says = "An ellipsoid's semi-axes over `radius`."}),
    field<&ImplicitPrimitive::core>({.name = "core",
                                     .wanted = "a number >= 0",
                                     .range = from_to(0, limits::kMaxImplicitRadius),
                                     .unit = "units",
                                     .says = "As far as that from its middle, line or axis a "
                                             "sphere, segment or cylinder is solid; units."}),
    // A skeleton of n pieces has n + 1 points.
    field<&ImplicitPrimitive::points>(
        {.name = "points",
         .wanted = "a list of [x, y, z]",
         .range = kImplicitPlace,
         .counts = at_most(limits::kMaxImplicitElements + 1),
         .unit = "units",
         .says = "From `center`: the two ends of a cylinder, two or more points of a segment."}),
    field<&ImplicitPrimitive::rotate>({.name = "rotate",
                                       .wanted = "[x, y, z]: three numbers (degrees)",
                                       .range = within(limits::kMaxAngle),
                                       .unit = "degrees",
                                       .says = "Degrees about x, then y, then z."}),
    field<&ImplicitPrimitive::weight>({.name = "weight",
                                       .wanted = "a number",
                                       .range = kImplicitWeight,
                                       .says = "Negative takes away."}),
    field<&ImplicitPrimitive::keys>({.name = "keys",
                                     .wanted = "a list of keys",
                                     .counts = at_most(limits::kMaxImplicitKeys),
                                     .says = "In rising order of time."}),
};
static_assert(covers<ImplicitPrimitive>(kImplicitPrimitiveFields));
inline constexpr Table kImplicitPrimitiveTable{
    .name = "ImplicitPrimitive",
    .says = "A weight and a density that falls off from a shape.",
    .fields = kImplicitPrimitiveFields,
    .standard = standard_of<ImplicitPrimitive>};
template <>
inline const Table& table_of<ImplicitPrimitive>() {
    return kImplicitPrimitiveTable;
}

// The particle system whose particles are primitives (spheres): seeds rise and wander in a turbulent force, bear
// children as often as the turbulence where they are is strong, come to rest after their lifetime, and never die.
// Lengths are in `radius`.
struct ImplicitGrowth {
    std::uint64_t seeds = 12;
    std::uint64_t most = 50;
    double radius = 54;
    // Of a full-grown child.
    double shrink = 0.85;
    // Of each when full-grown.
    double weight = 1;
    glm::dvec3 center{0};
    glm::dvec3 spread{2.2, 0.15, 1.6};
    glm::dvec3 velocity{0, 0.03, 0};
    glm::dvec3 force{0, 0.006, 0};
    double turbulence = 0.05;
    double drag = 0.12;
    // They are full-grown halfway.
    double lifetime = 25;
    double rate = 0.175;
    double duration = 60;
};

inline constexpr Range kGrowthSeconds =
    from_to(limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
inline constexpr Range kGrowthMotion = within(limits::kMaxGrowthMotion);

inline constexpr Field kImplicitGrowthFields[] = {
    field<&ImplicitGrowth::seeds>({.name = "seeds",
                                   .wanted = "an integer from 1 to 500",
                                   .counts = count_from_to(1, limits::kMaxGrowth),
                                   .says = "Particles at time 0."}),
    field<&ImplicitGrowth::most>({.name = "most",
                                  .wanted = "an integer from 1 to 500",
                                  .counts = count_from_to(1, limits::kMaxGrowth),
                                  .says = "Particles in all, at least `seeds`."}),
    field<&ImplicitGrowth::radius>(
        {.name = "radius",
         .wanted = "a number > 0",
         .range = from_to(limits::kMinImplicitRadius, limits::kMaxImplicitRadius / 10),
         .unit = "units",
         .says = "Of a full-grown seed, units. Lengths below are in it."}),
    field<&ImplicitGrowth::shrink>({.name = "shrink",
                                    .wanted = "a number from 0.1 to 1",
                                    .range = from_to(0.1, 1),
                                    .says = "A child's radius over its parent's."}),
    field<&ImplicitGrowth::weight>(
        {.name = "weight", .wanted = "a number", .range = kImplicitWeight, .says = "Of each."}),
    field<&ImplicitGrowth::center>({.name = "center",
                                    .wanted = kPointWanted,
                                    .range = kImplicitPlace,
                                    .unit = "units",
                                    .says = "Of the seeds, units."}),
    field<&ImplicitGrowth::spread>({.name = "spread",
                                    .wanted = "[x, y, z]: three numbers >= 0 (radii)",
                                    .range = from_to(0, limits::kMaxGrowthSpread),
                                    .unit = "radii",
                                    .says = "Seeds stand within so much of it, either way."}),
    field<&ImplicitGrowth::velocity>({.name = "velocity",
                                      .wanted = "[x, y, z]: three numbers (radii a second)",
                                      .range = kGrowthMotion,
                                      .unit = "radii a second",
                                      .says = "At birth, radii a second."}),
    field<&ImplicitGrowth::force>(
        {.name = "force",
         .wanted = "[x, y, z]: three numbers (radii a second, each second)",
         .range = kGrowthMotion,
         .unit = "radii a second^2",
         .says = "Radii a second, each second."}),
    field<&ImplicitGrowth::turbulence>({.name = "turbulence",
                                        .wanted = "a number >= 0",
                                        .range = from_to(0, limits::kMaxGrowthMotion),
                                        .unit = "radii a second^2",
                                        .says = "Of the force."}),
    field<&ImplicitGrowth::drag>({.name = "drag",
                                  .wanted = "a number >= 0",
                                  .range = from_to(0, limits::kMaxGrowthMotion),
                                  .unit = "1/second",
                                  .says = "1/second."}),
    field<&ImplicitGrowth::lifetime>({.name = "lifetime",
                                      .wanted = "a number > 0 (seconds)",
                                      .range = kGrowthSeconds,
                                      .unit = "seconds",
                                      .says = "Seconds from birth to rest."}),
    field<&ImplicitGrowth::rate>(
        {.name = "rate",
         .wanted = "a number >= 0 (children a second)",
         .range = from_to(0, 1000),
         .unit = "1/second",
         .says = "Children a second, times the turbulence where a particle is."}),
    field<&ImplicitGrowth::duration>({.name = "duration",
                                      .wanted = "a number > 0 (seconds)",
                                      .range = kGrowthSeconds,
                                      .unit = "seconds",
                                      .says = "Seconds from time 0; then all rests."}),
};
static_assert(covers<ImplicitGrowth>(kImplicitGrowthFields));
inline constexpr Table kImplicitGrowthTable{
    .name = "ImplicitGrowth",
    .says =
        "A particle system whose particles are primitives. Without `primitives` of its own a cloud "
        "has only these.",
    .fields = kImplicitGrowthFields,
    .standard = standard_of<ImplicitGrowth>};
template <>
inline const Table& table_of<ImplicitGrowth>() {
    return kImplicitGrowthTable;
}

// Draws matter towards (or, negative, pushes it from) a place: what is seen at p is what was at
// p + strength h(d / reach) (p - at), d the distance from `at`.
struct ImplicitAttractor {
    glm::dvec3 at{0};
    double strength = 0;
    double reach = 1;
};

inline constexpr Field kImplicitAttractorFields[] = {
    field<&ImplicitAttractor::at>({.name = "at",
                                   .wanted = kPointWanted,
                                   .range = kImplicitPlace,
                                   .unit = "units",
                                   .says = "Its place."}),
    field<&ImplicitAttractor::strength>(
        {.name = "strength",
         .wanted = "a number",
         .range = from_to(limits::kMinAttraction, limits::kMaxAttraction),
         .required = true,
         .says = "Positive draws matter in."}),
    field<&ImplicitAttractor::reach>({.name = "reach",
                                      .wanted = "a number > 0",
                                      .range = kImplicitRadius,
                                      .required = true,
                                      .unit = "units",
                                      .says = "Beyond it moves nothing."}),
};
static_assert(covers<ImplicitAttractor>(kImplicitAttractorFields));
inline constexpr Table kImplicitAttractorTable{
    .name = "ImplicitAttractor",
    .says = "Draws matter towards a place, or pushes it away.",
    .fields = kImplicitAttractorFields,
    .standard = standard_of<ImplicitAttractor>};
template <>
inline const Table& table_of<ImplicitAttractor>() {
    return kImplicitAttractorTable;
}

// Turns matter about an axis through `at` by angle h(d / reach).
struct ImplicitVortex {
    glm::dvec3 at{0};
    glm::dvec3 axis{0, 1, 0};
    // Right-handed.
    double angle = 0;
    double reach = 1;
};

inline constexpr Field kImplicitVortexFields[] = {
    field<&ImplicitVortex::at>({.name = "at",
                                .wanted = kPointWanted,
                                .range = kImplicitPlace,
                                .unit = "units",
                                .says = "Its place."}),
    field<&ImplicitVortex::axis>({.name = "axis",
                                  .wanted = kPointWanted,
                                  .range = kImplicitPlace,
                                  .says = "Of any length > 0."}),
    field<&ImplicitVortex::angle>({.name = "angle",
                                   .wanted = "a number (degrees)",
                                   .range = within(limits::kMaxVortexAngle),
                                   .required = true,
                                   .unit = "degrees",
                                   .says = "Degrees, in the middle."}),
    field<&ImplicitVortex::reach>({.name = "reach",
                                   .wanted = "a number > 0",
                                   .range = kImplicitRadius,
                                   .required = true,
                                   .unit = "units",
                                   .says = "Beyond it turns nothing."}),
};
static_assert(covers<ImplicitVortex>(kImplicitVortexFields));
inline constexpr Table kImplicitVortexTable{.name = "ImplicitVortex",
                                            .says = "Turns matter about an axis.",
                                            .fields = kImplicitVortexFields,
                                            .standard = standard_of<ImplicitVortex>};
template <>
inline const Table& table_of<ImplicitVortex>() {
    return kImplicitVortexTable;
}

// A vector flow table: matter at p was moved there by the vector of p, trilinear between the table's, those of the
// faces outside.
struct ImplicitFlow {
    // Of the box; the first and the last vectors of a row stand on its faces.
    glm::dvec3 min{-1};
    glm::dvec3 max{1};
    // Whole numbers.
    glm::dvec3 size{0};
    std::vector<glm::dvec3> vectors;
};

inline constexpr Field kImplicitFlowFields[] = {
    field<&ImplicitFlow::min>({.name = "min",
                               .wanted = kPointWanted,
                               .range = kImplicitPlace,
                               .required = true,
                               .unit = "units",
                               .says = "Corner of the box."}),
    field<&ImplicitFlow::max>({.name = "max",
                               .wanted = kPointWanted,
                               .range = kImplicitPlace,
                               .required = true,
                               .unit = "units",
                               .says = "The corner opposite."}),
    field<&ImplicitFlow::size>(
        {.name = "size",
         .wanted = "[x, y, z]: three whole numbers, how many vectors along each axis",
         .range = from_to(1, static_cast<double>(limits::kMaxFlowVectors)),
         .whole = true,
         .required = true,
         .says = "Vectors along x, y, z."}),
    field<&ImplicitFlow::vectors>({.name = "vectors",
                                   .wanted = "a list of [x, y, z]",
                                   .range = within(limits::kMaxImplicitRadius),
                                   .counts = count_from_to(1, limits::kMaxFlowVectors),
                                   .required = true,
                                   .unit = "units",
                                   .says = "Units by which matter was moved there; x fastest, then "
                                           "y, then z; trilinear between."}),
};
static_assert(covers<ImplicitFlow>(kImplicitFlowFields));
inline constexpr Table kImplicitFlowTable{.name = "ImplicitFlow",
                                          .says = "A vector flow table.",
                                          .fields = kImplicitFlowFields,
                                          .standard = standard_of<ImplicitFlow>};
template <>
inline const Table& table_of<ImplicitFlow>() {
    return kImplicitFlowTable;
}

// As given; resolved() below fills in the rest.
struct ImplicitCloud {
    ImplicitPreset preset = ImplicitPreset::kCumulus;
    // None: the preset's, or none beside a growth.
    std::optional<std::vector<ImplicitPrimitive>> primitives;
    std::optional<ImplicitGrowth> growth;
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
                                       .otherwise = "the preset's, or none beside a growth"}),
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
};
ImplicitSettings resolved(const ImplicitCloud& cloud);

// The same cloud with every field given that a preset may decide: equal for clouds that come to the same.
ImplicitCloud spelled_out(const ImplicitCloud& cloud);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const ImplicitCloud& cloud);

}  // namespace awan
