// What a cloud of model "spheres" is: Ostroushko et al. 2010. A sphere is divided into five that lie inside it, each of
// these again, K times; the spheres of the last level are the cloud. How it is divided:
// core/generate/spheres/subdivision.h.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "core/base/result.h"
#include "core/scene/cloud.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Sets of ranges for what is random. Ostroushko et al. print those of cumulus clouds, and for the rest the widest
// ranges (I_j from 0 to 1, s_j from .5 to 1) beside a picture of cirrus clouds, without the figures that made it;
// kCirrus is ours within them.
enum class SpheresKind { kCumulus, kCirrus };
inline constexpr const char* kSpheresKindWords[] = {"cumulus", "cirrus"};

// At which steps the sides of the cloud squeeze the places of the spheres. As printed at the first only, and then a
// flat cloud is as high as its largest child, whatever its sides say. At every step it keeps its sides.
enum class SpheresScaling { kFirst, kEvery };
inline constexpr const char* kSpheresScalingWords[] = {"first", "every"};

// Where the fifth sphere goes, the only one that leaves the plane of its parent's middle. Printed: y less. With y up,
// as here, such a cloud hangs from a flat top; figures drawn with y down have the flat base of a cumulus.
enum class SpheresGrowth { kUp, kDown };
inline constexpr const char* kSpheresGrowthWords[] = {"up", "down"};

// The cloud becomes another realisation of itself, with as many spheres: centres and radii go linearly from one's to
// the other's. Before 0 s it is its own seed's; step i (from 1) ends at i * duration with that of `seed` + i - 1.
struct SpheresMorph {
    std::uint64_t seed = 2;
    double duration = 10;
    std::uint64_t steps = 1;
};

inline constexpr Field kSpheresMorphFields[] = {
    field<&SpheresMorph::seed>(
        {.name = "seed",
         .wanted = "an integer from 0 to 18446744073709551615",
         .says =
             "Of the realisation that the first step ends with; each further step's is one more."}),
    field<&SpheresMorph::duration>({.name = "duration",
                                    .wanted = "a number > 0 (seconds)",
                                    .range = from_to(limits::kMinMorphDuration, limits::kMaxTime),
                                    .unit = "seconds",
                                    .says = "Seconds a step."}),
    field<&SpheresMorph::steps>({.name = "steps",
                                 .wanted = "an integer >= 1",
                                 .counts = count_from_to(1, limits::kMaxMorphSteps),
                                 .says = "How many realisations it becomes in turn."}),
};
static_assert(covers<SpheresMorph>(kSpheresMorphFields));
inline constexpr Table kSpheresMorphTable{.name = "SpheresMorph",
                                          .says =
                                              "With time, places and radii go linearly from the "
                                              "cloud's own realisation to that of another seed.",
                                          .fields = kSpheresMorphFields,
                                          .standard = standard_of<SpheresMorph>};
template <>
inline const Table& table_of<SpheresMorph>() {
    return kSpheresMorphTable;
}

struct SpheresCloud {
    SpheresKind kind = SpheresKind::kCumulus;
    // K of Ostroushko et al. 2010: 5^K spheres, seen or not.
    std::uint64_t levels = 6;
    // a, b, c. The sphere of level 0 has the radius max / 2 (K = 0: min / 2).
    glm::dvec3 size{500, 300, 400};
    // S_M: so far away a black thing keeps 2% of its contrast. ln .02 = S_M ln t gives the specific transparency t, and
    // the extinction -ln t = ln 50 / S_M. None: the cloud's density is the extinction.
    std::optional<double> visual_range;
    // I_j is uniform between these; none: the kind's.
    std::optional<double> ratio_min;
    std::optional<double> ratio_max;
    // s_j is uniform between these; none: the kind's.
    std::optional<double> shift_min;
    std::optional<double> shift_max;
    SpheresScaling scaling = SpheresScaling::kFirst;
    SpheresGrowth growth = SpheresGrowth::kUp;
    std::optional<SpheresMorph> morph;
};

inline constexpr Range kSphereRatio = from_to(limits::kMinSphereRatio, limits::kMaxSphereRatio);
inline constexpr const char* kSphereRatioWanted =
    "a number from 0.05 to 0.9 (radius of a sphere over its parent's)";

inline constexpr Field kSpheresFields[] = {
    field<&SpheresCloud::kind>({.name = "kind",
                                .words = kSpheresKindWords,
                                .says = "Which ranges the ratios and shifts have that are not "
                                        "given: cumulus .26...76 and .9..1, cirrus .2...7 "
                                        "and .5..1."}),
    field<&SpheresCloud::levels>({.name = "levels",
                                  .wanted = "an integer from 0 to 10",
                                  .counts = at_most(limits::kMaxSphereLevels),
                                  .says = "Each level has five times as many spheres; 0 is one "
                                          "sphere. A picture goes as deep as its pixels "
                                          "need."}),
    field<&SpheresCloud::size>({.name = "size",
                                .wanted = "[x, y, z]: three numbers > 0 (sides, scene units)",
                                .range = from_to(limits::kMinSpheresSide, limits::kMaxSpheresSide),
                                .unit = "units",
                                .says = "Sides, scene units."}),
    field<&SpheresCloud::visual_range>(
        {.name = "visual_range",
         .wanted = "a number > 0 (meteorological optical range, scene units)",
         .range = from_to(limits::kMinVisualRange, limits::kMaxVisualRange),
         .unit = "units",
         .says = "Meteorological optical range in the cloud, scene units: extinction ln 50 / "
                 "visual_range instead of "
                 "the density.",
         .otherwise = "by the cloud's density"}),
    field<&SpheresCloud::ratio_min>(
        {.name = "ratio_min",
         .wanted = kSphereRatioWanted,
         .range = kSphereRatio,
         .says = "A sphere's radius over its parent's is at least this; at most ratio_max.",
         .otherwise = "the kind's"}),
    field<&SpheresCloud::ratio_max>({.name = "ratio_max",
                                     .wanted = kSphereRatioWanted,
                                     .range = kSphereRatio,
                                     .says = "And at most this.",
                                     .otherwise = "the kind's"}),
    field<&SpheresCloud::shift_min>({.name = "shift_min",
                                     .wanted = "a number from 0 to 1",
                                     .range = from_to(0, 1),
                                     .says = "How far towards its parent's surface a sphere goes "
                                             "along its axis, at least; at most shift_max.",
                                     .otherwise = "the kind's"}),
    field<&SpheresCloud::shift_max>({.name = "shift_max",
                                     .wanted = "a number from 0 to 1",
                                     .range = from_to(0, 1),
                                     .says = "And at most so far.",
                                     .otherwise = "the kind's"}),
    field<&SpheresCloud::scaling>({.name = "scaling",
                                   .words = kSpheresScalingWords,
                                   .says = "At which steps the sides squeeze the cloud: at the "
                                           "first alone (as printed) a flat cloud is as high "
                                           "as its largest child."}),
    field<&SpheresCloud::growth>(
        {.name = "growth",
         .words = kSpheresGrowthWords,
         .says = "Where the fifth sphere of each goes: up gives a flat base, down (as printed) a "
                 "flat top."}),
    field<&SpheresCloud::morph>({.name = "morph",
                                 .wanted = R"(an object or "none")",
                                 .absent = "none",
                                 .says = "With time, places and radii go linearly from the cloud's "
                                         "own realisation to that of another seed."}),
};
static_assert(covers<SpheresCloud>(kSpheresFields));
inline constexpr Table kSpheresTable{.name = "Spheres",
                                     .says =
                                         "Spheres within spheres, each divided into five that lie "
                                         "inside it (Ostroushko et al. 2010).",
                                     .fields = kSpheresFields,
                                     .standard = standard_of<SpheresCloud>};

// A range, its ends included.
struct Span {
    double low, high;
};
// Of I_j, radius of a sphere over its parent's. Cumulus: .26...76, printed.
Span ratios_of(const SpheresCloud& cloud);
// Of s_j, a sphere's distance along its own axis over the farthest at which it lies in its parent. Cumulus: .9..1,
// printed.
Span shifts_of(const SpheresCloud& cloud);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const SpheresCloud& cloud);

}  // namespace awan
