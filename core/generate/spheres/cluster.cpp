#include "core/generate/spheres/cluster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace awan::spheres {
namespace {

// (2 pi)^1.5: the mass of a Gaussian of peak 1 and s = 1.
constexpr double kSqrtTwoPiCubed = 15.749609945722419;

// A point of the Gauss-Legendre rule on 0..1; five of them are exact for polynomials of degree 9.
struct GaussPoint {
    double at, weight;
};
constexpr GaussPoint kGauss[] = {{0.04691007703066800, 0.11846344252809454},
                                 {0.23076534494715845, 0.23931433524968324},
                                 {0.5, 0.28444444444444444},
                                 {0.76923465505284155, 0.23931433524968324},
                                 {0.95308992296933200, 0.11846344252809454}};

double at(const Span& span, double share) {
    return span.low + (span.high - span.low) * share;
}

// One step up the tree: the mean over five children with `below` in each.
ClusterMoments step_up(const SphereTree& tree, const ClusterMoments& below) {
    ClusterMoments sum{0, glm::dvec3(0), 0};
    for (const GaussPoint& i : kGauss)
        for (const GaussPoint& s : kGauss)
            for (int j = 0; j < kSphereChildren; ++j)
                for (const double side : {-1.0, 1.0}) {
                    const double ratio = at(tree.ratios(), i.at);
                    const glm::dvec3 offset =
                        child_offset(j, {ratio, at(tree.shifts(), s.at), side}, tree.axes(1),
                                     tree.across(1), tree.up());
                    const double mass =
                        i.weight * s.weight * 0.5 * ratio * ratio * ratio * below.mass;
                    sum.mass += mass;
                    sum.mean += mass * (offset + ratio * below.mean);
                    sum.square += mass * (glm::dot(offset, offset) +
                                          2 * ratio * glm::dot(offset, below.mean) +
                                          ratio * ratio * below.square);
                }
    sum.mean /= sum.mass;
    sum.square /= sum.mass;
    return sum;
}

}  // namespace

std::vector<ClusterMoments> cluster_moments(const SphereTree& tree) {
    std::vector<ClusterMoments> moments(static_cast<std::size_t>(std::max(tree.levels(), 1)));
    for (std::size_t n = 1; n < moments.size(); ++n) moments[n] = step_up(tree, moments[n - 1]);
    return moments;
}

GaussianBlob leaf_blob(const Sphere& sphere) {
    const double s = sphere.radius * std::sqrt(kLeafVariance);
    const double over = sphere.radius / s;
    return {sphere.center, s, kLeafMass * over * over * over / kSqrtTwoPiCubed};
}

GaussianBlob cluster_blob(const std::array<SphereNode, kSphereChildren>& children,
                          const ClusterMoments& below) {
    // Relative to the first child, in its radii, so that neither places nor radii lose their digits.
    const Sphere& first = children[0].sphere;
    double mass = 0, square = 0;
    glm::dvec3 mean(0);
    for (const SphereNode& node : children) {
        const double r = node.sphere.radius / first.radius;
        const glm::dvec3 at = (node.sphere.center - first.center) / first.radius;
        const double own = r * r * r * below.mass;
        mass += own;
        mean += own * (at + r * below.mean);
        square +=
            own * (glm::dot(at, at) + 2 * r * glm::dot(at, below.mean) + r * r * below.square);
    }
    mean /= mass;
    square /= mass;
    const double variance = std::max((square - glm::dot(mean, mean)) / 3, 1e-12);
    const double s = std::sqrt(variance);
    return {first.center + first.radius * mean, first.radius * s,
            kLeafMass * mass / (variance * s * kSqrtTwoPiCubed)};
}

}  // namespace awan::spheres
