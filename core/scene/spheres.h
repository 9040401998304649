// What a cloud of model "spheres" is: Ostroushko et al. 2010. A sphere is divided into five, or another number, that
// lie inside it, each of these again, K times; the spheres of the last level are the cloud. How it is divided:
// core/generate/spheres/subdivision.h.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

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

// Where the parts of a sphere go. Printed, for five: kCross. Ostroushko et al. 2010 find that the "number of figures
// into which the sphere is subdivided" has a great influence on what comes out, and say no more of it; the rest is ours
// (core/generate/spheres/subdivision.h).
enum class SpheresPlaces { kCross, kTurned, kDome, kBall, kRow };
inline constexpr const char* kSpheresPlacesWords[] = {"cross", "turned", "dome", "ball", "row"};

// How a random variable is distributed over its range: its density is even, or a straight line, or two. "Controlling
// the probability distribution of random variables" makes the types of clouds; which distributions is not printed.
enum class SpheresLaw { kUniform, kFalling, kRising, kMiddle, kEnds };
inline constexpr const char* kSpheresLawWords[] = {"uniform", "falling", "rising", "middle",
                                                   "ends"};

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

// Where the whole cloud is at a time: the affine transformations of Ostroushko et al. 2010, rotation, shift and
// scaling. Between two poses each goes linearly; before the first and after the last it stays.
struct SpheresPose {
    double time = 0;
    glm::dvec3 shift{0};
    // Its direction is the axis, its length the angle, degrees.
    glm::dvec3 turn{0};
    // Times the sides a, b, c. All alike: centres and radii are scaled. Else the sides squeeze the cloud by their rule.
    glm::dvec3 scale{1};
};

inline constexpr Field kSpheresPoseFields[] = {
    field<&SpheresPose::time>({.name = "time",
                               .wanted = "a number (seconds)",
                               .range = within(limits::kMaxTime),
                               .required = true,
                               .unit = "seconds",
                               .says = "When; later than that of the pose before."}),
    field<&SpheresPose::shift>({.name = "shift",
                                .wanted = "[x, y, z]: three numbers",
                                .range = within(limits::kMaxSpheresSide),
                                .unit = "units",
                                .says = "Of the cloud's middle."}),
    field<&SpheresPose::turn>(
        {.name = "turn",
         .wanted = "[x, y, z]: three numbers (degrees)",
         .range = within(limits::kMaxAngle),
         .unit = "degrees",
         .says = "Along the axis that it turns about, as long as the angle."}),
    field<&SpheresPose::scale>({.name = "scale",
                                .wanted = "a number > 0, or [x, y, z]: three",
                                .range = from_to(limits::kMinPoseScale, limits::kMaxPoseScale),
                                .one_for_all = true,
                                .says = "Times the cloud's sides."}),
};
static_assert(covers<SpheresPose>(kSpheresPoseFields));
inline constexpr Table kSpheresPoseTable{.name = "SpheresPose",
                                         .says =
                                             "Rotation, shift and scaling of the cloud at a time; "
                                             "linear between two of them.",
                                         .fields = kSpheresPoseFields,
                                         .standard = standard_of<SpheresPose>};
template <>
inline const Table& table_of<SpheresPose>() {
    return kSpheresPoseTable;
}

// A wave of the relief on a sphere: amplitude * sin(2 pi (around u + down v + phase)), where u = 0..1 goes round the
// sphere's upright axis and v = 0..1 from its top to its bottom.
struct SpheresWave {
    double amplitude = 1;
    std::uint64_t around = 4;
    double down = 0;
    double phase = 0;
};

inline constexpr Field kSpheresWaveFields[] = {
    field<&SpheresWave::amplitude>({.name = "amplitude",
                                    .wanted = "a number from -1 to 1",
                                    .range = within(1),
                                    .says = "Times the relief's height."}),
    field<&SpheresWave::around>({.name = "around",
                                 .wanted = "an integer from 0 to 64",
                                 .counts = at_most(limits::kMaxBumpFrequency),
                                 .says = "How often it goes up and down round the sphere, along "
                                         "u."}),
    field<&SpheresWave::down>({.name = "down",
                               .wanted = "a number",
                               .range = within(static_cast<double>(limits::kMaxBumpFrequency)),
                               .says = "And how often from its top to its bottom, along v."}),
    field<&SpheresWave::phase>({.name = "phase",
                                .wanted = "a number from 0 to 1 (turns)",
                                .range = from_to(0, 1),
                                .unit = "turns",
                                .says = "Of a whole turn."}),
};
static_assert(covers<SpheresWave>(kSpheresWaveFields));
inline constexpr Table kSpheresWaveTable{.name = "SpheresWave",
                                         .says = "amplitude sin(2 pi (around u + down v + phase)).",
                                         .fields = kSpheresWaveFields,
                                         .standard = standard_of<SpheresWave>};
template <>
inline const Table& table_of<SpheresWave>() {
    return kSpheresWaveTable;
}

// The function f(u, v, n) of Ostroushko et al. 2010 (4): "it can be represented analytically or, alternatively, it can
// use sampling from the texture map". Without waves and texture it is waves by chance, others on each sphere.
struct SpheresBump {
    double height = 0.06;
    std::vector<SpheresWave> waves;
    // Of one of Awan's own or one that was uploaded (texture.h), which is the deeper the higher the relief.
    std::optional<std::string> texture;
    // How often it lies round a sphere.
    std::uint64_t repeat = 2;
};

inline constexpr Field kSpheresBumpFields[] = {
    field<&SpheresBump::height>({.name = "height",
                                 .wanted = "a number from 0 to 1 (radii)",
                                 .range = from_to(0, limits::kMaxBumpHeight),
                                 .unit = "radii",
                                 .says = "Of the relief, in radii of a sphere; 0: none."}),
    field<&SpheresBump::waves>({.name = "waves",
                                .wanted = "a list of waves",
                                .counts = at_most(limits::kMaxBumpWaves),
                                .says = "The relief as a sum of waves; none, and no texture: by "
                                        "chance."}),
    field<&SpheresBump::texture>({.name = "texture",
                                  .wanted = "the name of a texture",
                                  .says = "The relief as a picture: soft, puff, cauliflower, torn, "
                                          "wisp, hard, one that was uploaded, or a texture's hash.",
                                  .otherwise = "none"}),
    field<&SpheresBump::repeat>({.name = "repeat",
                                 .wanted = "an integer from 1 to 64",
                                 .counts = count_from_to(1, limits::kMaxBumpFrequency),
                                 .says = "How often the texture lies round a sphere."}),
};
static_assert(covers<SpheresBump>(kSpheresBumpFields));
inline constexpr Table kSpheresBumpTable{.name = "SpheresBump",
                                         .says =
                                             "The relief that turns the normals of spheres; of the "
                                             "look ostroushko only.",
                                         .fields = kSpheresBumpFields,
                                         .standard = standard_of<SpheresBump>};
template <>
inline const Table& table_of<SpheresBump>() {
    return kSpheresBumpTable;
}

struct SpheresCloud {
    SpheresKind kind = SpheresKind::kCumulus;
    // K of Ostroushko et al. 2010: parts^K spheres, seen or not.
    std::uint64_t levels = 6;
    std::uint64_t parts = 5;
    SpheresPlaces places = SpheresPlaces::kCross;
    // a, b, c. The sphere of level 0 has the radius max / 2 (K = 0: min / 2).
    glm::dvec3 size{500, 300, 400};
    // S_M: so far away a black thing keeps 2% of its contrast. ln .02 = S_M ln t gives the specific transparency t, and
    // the extinction -ln t = ln 50 / S_M. None: the cloud's density is the extinction.
    std::optional<double> visual_range;
    // I_j is between these; none: the kind's.
    std::optional<double> ratio_min;
    std::optional<double> ratio_max;
    // s_j is between these; none: the kind's.
    std::optional<double> shift_min;
    std::optional<double> shift_max;
    SpheresLaw ratio_law = SpheresLaw::kUniform;
    SpheresLaw shift_law = SpheresLaw::kUniform;
    SpheresScaling scaling = SpheresScaling::kFirst;
    SpheresGrowth growth = SpheresGrowth::kUp;
    std::optional<SpheresMorph> morph;
    // The parts of each sphere turn about its middle, upright, at a speed of its own up to this, degrees a second.
    double turning = 0;
    // In order of their times.
    std::vector<SpheresPose> poses;
    std::optional<SpheresBump> bump;
};

inline constexpr Field kSpheresFields[] = {
    field<&SpheresCloud::kind>({.name = "kind",
                                .words = kSpheresKindWords,
                                .says = "Which ranges the ratios and shifts have that are not "
                                        "given: cumulus .26...76 and .9..1, cirrus .2...7 "
                                        "and .5..1."}),
    field<&SpheresCloud::levels>({.name = "levels",
                                  .wanted = "an integer from 0 to 10",
                                  .counts = at_most(limits::kMaxSphereLevels),
                                  .says = "Each level has `parts` times as many spheres; 0 is one "
                                          "sphere. A picture goes as deep as its pixels "
                                          "need."}),
    field<&SpheresCloud::parts>(
        {.name = "parts",
         .wanted = "an integer from 2 to 12",
         .counts = count_from_to(limits::kMinSphereParts, limits::kMaxSphereParts),
         .says = "How many a sphere is divided into; at most 9765625 spheres in all."}),
    field<&SpheresCloud::places>(
        {.name = "places",
         .words = kSpheresPlacesWords,
         .says = "Where they go. cross: about the sphere's middle, level, and one up or down (as "
                 "printed); turned: the same, turned by chance; dome: over the upper or lower "
                 "half; ball: all round; row: along x."}),
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
         .wanted = "a number from 0 to 1 (radius of a sphere over its parent's)",
         .range = from_to(0, limits::kMaxSphereRatio),
         .says = "A sphere's radius over its parent's is at least this; at most ratio_max.",
         .otherwise = "the kind's"}),
    field<&SpheresCloud::ratio_max>(
        {.name = "ratio_max",
         .wanted = "a number from 0.01 to 1 (radius of a sphere over its parent's)",
         .range = from_to(limits::kLeastUpperRatio, limits::kMaxSphereRatio),
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
    field<&SpheresCloud::ratio_law>(
        {.name = "ratio_law",
         .words = kSpheresLawWords,
         .says = "How ratios are spread over their range: evenly, the most at its lower end "
                 "(falling), its upper end (rising), in its middle, or at both ends."}),
    field<&SpheresCloud::shift_law>(
        {.name = "shift_law", .words = kSpheresLawWords, .says = "The same of shifts."}),
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
    field<&SpheresCloud::turning>({.name = "turning",
                                   .wanted = "a number >= 0 (degrees a second)",
                                   .range = from_to(0, limits::kMaxSphereTurning),
                                   .unit = "degrees a second",
                                   .says = "With time, the parts of each sphere turn about its "
                                           "upright axis, at a speed of its own up to this."}),
    field<&SpheresCloud::poses>({.name = "poses",
                                 .wanted = "a list of poses",
                                 .counts = at_most(limits::kMaxSpheresPoses),
                                 .says = "Rotation, shift and scaling in time."}),
    field<&SpheresCloud::bump>({.name = "bump",
                                .wanted = R"(an object or "none")",
                                .absent = "none",
                                .says = "The relief on spheres in the look ostroushko; none: waves "
                                        "by chance, .06 high."}),
};
static_assert(covers<SpheresCloud>(kSpheresFields));
inline constexpr Table kSpheresTable{.name = "Spheres",
                                     .says =
                                         "Spheres within spheres, each divided into five, or as "
                                         "many as are wanted, that lie inside it (Ostroushko et "
                                         "al. 2010).",
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
