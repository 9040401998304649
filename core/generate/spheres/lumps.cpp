// What is lost where a cluster of leaves is drawn as one smooth Gaussian.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/spheres/cut.h"

namespace awan::spheres {
namespace {

// The area that a Gaussian of this depth through its middle covers, over 2 pi s^2: the integral of (1 - e^-t) / t from
// t = 0 to the depth. Simpson's rule in the logarithm, within 1e-4.
double covered(double depth) {
    constexpr int kSteps = 64;
    constexpr double kFrom = 1e-6;
    if (!(depth > kFrom)) return depth;
    const double step = exact::log(depth / kFrom) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum -= weight * exact::expm1(-kFrom * exact::exp(step * i));
    }
    return kFrom + sum * step / 3;
}

}  // namespace

// From the leaves upwards: children that stand by chance within their parent's Gaussian cover, together, what a
// Gaussian of that width and of the depth sum(areas of the children) / (2 pi s^2) does. Their mass alone would give it
// the depth of the one that is drawn. Children are taken to be all of one size, and so many that their areas and their
// masses come to what is to be expected.
double lost_in_lumps(const SphereTree& tree, const std::vector<ClusterMoments>& moments,
                     double radius, int below, double sigma) {
    const double square = mean_of_power(tree.ratios(), tree.ratio_law(), 2);
    const double cube = mean_of_power(tree.ratios(), tree.ratio_law(), 3);
    const double ratio = cube / square, children = tree.parts() * square / (ratio * ratio);
    // 2 pi s^2 of a sphere of radius 1 with so many levels below it, over its radius squared.
    const auto area = [&](int levels) {
        const ClusterMoments& one = moments[static_cast<std::size_t>(levels)];
        const double variance = (one.square - (one.mean.x * one.mean.x + one.mean.y * one.mean.y +
                                               one.mean.z * one.mean.z)) /
                                3;
        return 2 * std::numbers::pi * std::max(variance, 1e-12);
    };
    const int top = std::min(below, static_cast<int>(moments.size()) - 1);
    double r = radius * exact::pow(ratio, top);
    double hidden = area(0) * r * r * covered(sigma * kLeafMass * r / area(0));
    for (int level = 1; level <= top; ++level) {
        r = radius * exact::pow(ratio, top - level);
        const double own = area(level) * r * r;
        hidden = own * covered(children * hidden / own);
    }
    const double own = area(top) * radius * radius;
    const double mass =
        sigma * kLeafMass * moments[static_cast<std::size_t>(top)].mass * radius * radius * radius;
    const double drawn = own * covered(mass / own);
    return drawn > 0 ? std::clamp(1 - hidden / drawn, 0.0, 1.0) : 0;
}

}  // namespace awan::spheres
