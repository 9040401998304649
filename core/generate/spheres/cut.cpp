#include "core/generate/spheres/cut.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/parallel.h"
#include "core/generate/spheres/walk.h"
#include "core/scene/limits.h"

namespace awan::spheres {
namespace {

// The diameter below which a sphere is cut, in pixels.
constexpr double kCutPixels = 1.5;

// Sizes are counted in classes of an eighth of an octave, from 2^-60 on, by the bits of the double, so that every
// machine agrees.
constexpr int kFirstOctave = -60, kOctaves = 82, kParts = 8;
constexpr std::size_t kClasses = kOctaves * kParts;
using Histogram = std::array<std::uint64_t, kClasses>;

std::size_t class_of(double size) {
    int exponent = 0;
    // The mantissa's place in its octave, 0..1.
    const double mantissa = 2 * std::frexp(size, &exponent) - 1;
    if (!(size > 0) || exponent <= kFirstOctave) return 0;
    const int octave = std::min(exponent - kFirstOctave, kOctaves - 1);
    return static_cast<std::size_t>(octave * kParts + static_cast<int>(mantissa * kParts));
}

// The smallest size of a class: no size in it is smaller, and none in the classes below is larger.
double lower_edge(std::size_t index) {
    const auto octave = static_cast<int>(index / kParts);
    const double part = static_cast<double>(index % kParts) / kParts;
    return std::ldexp((1 + part) / 2, octave + kFirstOctave);
}

}  // namespace

double SphereCut::size_of(const Sphere& sphere) const {
    const double near = eye ? glm::length(sphere.center - *eye) - sphere.radius : distance;
    return sphere.radius / std::max(near, least_distance);
}

bool SphereCut::cuts(const Sphere& sphere, const Span& ratios) const {
    // A leaf's particle has .72 of the leaf's radius. Children of next to nothing are no reason.
    constexpr double kLeastRatio = 0.05;
    return size_of(sphere) < smallest ||
           sphere.radius * std::max(ratios.low, kLeastRatio) < 2 * limits::kMinRadius;
}

Result<SphereCut> choose_cut(const SphereTree& tree, const std::optional<glm::dvec3>& eye,
                             double pixel_angle, std::uint64_t most, int threads,
                             const Deadline& deadline) {
    const double radius = tree.root().sphere.radius;
    SphereCut cut;
    cut.eye = eye;
    cut.least_distance = radius * 0x1p-20;
    // The automatic camera stands three radii from the middle of a cloud that fills its picture, so two from its near
    // side.
    cut.distance = 2 * radius;
    cut.smallest = kCutPixels / 2 * pixel_angle;

    // A cut leaves one sphere, and one less than there are parts more for every sphere that it divides.
    const auto more = static_cast<std::uint64_t>(tree.parts()) - 1;
    std::vector<Histogram> divided(walk_tasks(tree));
    const bool whole = walk_spheres(
        tree, threads, deadline, [&](const SphereNode& node, int level, std::size_t task) {
            if (level == tree.levels() || cut.cuts(node.sphere, tree.ratios())) return false;
            ++divided[task][class_of(cut.size_of(node.sphere))];
            return true;
        });
    if (!whole) return *deadline.over();
    std::uint64_t left = 1;
    for (std::size_t k = kClasses; k-- > 0;) {
        std::uint64_t here = 0;
        for (const Histogram& one : divided) here += one[k];
        left += more * here;
        if (left > most) {
            cut.smallest = std::max(cut.smallest, k + 1 < kClasses ? lower_edge(k + 1) : 0x1p30);
            break;
        }
    }
    return cut;
}

}  // namespace awan::spheres
