// What a cloud of model "spheres" is: Ostroushko, Bilous, Bugriy & Chagovets, "Mathematical model of the cloud for ray
// tracing" (document 003). A sphere is divided into five that lie inside it, each of these again, K times; the spheres of
// the last level are the cloud. How it is divided: core/generate/spheres/subdivision.h.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace awan {

// Sets of ranges for what is random. The source prints those of cumulus clouds, and for the rest the widest ranges (I_j from
// 0 to 1, s_j from .5 to 1) beside a picture of cirrus clouds, without the figures that made it; kCirrus is ours within them.
enum class SpheresKind { kCumulus, kCirrus };

// At which steps the sides of the cloud squeeze the places of the spheres. As printed at the first only, and then a flat
// cloud is as high as its largest child, whatever its sides say. At every step it keeps its sides.
enum class SpheresScaling { kFirst, kEvery };

// Where the fifth sphere goes, the only one that leaves the plane of its parent's middle. Printed: y less. With y up, as here,
// such a cloud hangs from a flat top; figures drawn with y down have the flat base of a cumulus.
enum class SpheresGrowth { kUp, kDown };

// The cloud becomes another realisation of itself, with as many spheres: centres and radii go linearly from one's to the
// other's. Before 0 s it is its own seed's; step i (from 1) ends at i * duration with that of `seed` + i - 1.
struct SpheresMorph {
    std::uint64_t seed = 2;
    double duration = 10;     // seconds a step, > 0
    std::uint64_t steps = 1;  // 1..
};

struct SpheresCloud {
    SpheresKind kind = SpheresKind::kCumulus;
    // K, 0..10: 5^K spheres, seen or not. 0: one sphere.
    std::uint64_t levels = 6;
    // a, b, c: sides along x, y, z, scene units. The sphere of level 0 has the radius max / 2 (K = 0: min / 2).
    glm::dvec3 size{500, 300, 400};
    // S_M, the meteorological optical range: so far away a black thing keeps 2% of its contrast. Scene units;
    // ln .02 = S_M ln t gives the specific transparency t, and the extinction -ln t = ln 50 / S_M. None: the cloud's density
    // is the extinction.
    std::optional<double> visual_range;
    // I_j is uniform between these, none: the kind's.
    std::optional<double> ratio_min, ratio_max;
    // s_j is uniform between these, none: the kind's.
    std::optional<double> shift_min, shift_max;
    SpheresScaling scaling = SpheresScaling::kFirst;
    SpheresGrowth growth = SpheresGrowth::kUp;
    std::optional<SpheresMorph> morph;
};

// A range, its ends included.
struct Span {
    double low, high;
};
// Of I_j, radius of a sphere over its parent's. Cumulus: .26...76, printed.
Span ratios_of(const SpheresCloud& cloud);
// Of s_j, a sphere's distance along its own axis over the farthest at which it lies in its parent. Cumulus: .9..1, printed.
Span shifts_of(const SpheresCloud& cloud);

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const SpheresCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "spheres".
Status check_spheres(const SpheresCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const SpheresCloud& cloud);

}  // namespace awan
