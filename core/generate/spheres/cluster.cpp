#include "core/generate/spheres/cluster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace awan::spheres {
namespace {

// (2 pi)^1.5: the mass of a Gaussian of peak 1 and s = 1.
constexpr double kSqrtTwoPiCubed = 15.749609945722419;

double at(const Span& span, double share) {
    return span.low + (span.high - span.low) * share;
}

// One step up the tree: the mean over the children with `below` in each. Parts that stand turned by chance are tried in
// four turns, which is exact for what is linear or square in the sine and the cosine.
ClusterMoments step_up(const SphereTree& tree, const ClusterMoments& below) {
    const std::vector<LawPoint> ratios = points_of(tree.ratio_law());
    const std::vector<LawPoint> shifts = points_of(tree.shift_law());
    const int turns = tree.turns() ? 4 : 1;
    ClusterMoments sum{0, glm::dvec3(0), 0};
    for (const LawPoint& i : ratios)
        for (const LawPoint& s : shifts)
            for (int j = 0; j < tree.parts(); ++j)
                for (const double side : {-1.0, 1.0})
                    for (int turn = 0; turn < turns; ++turn) {
                        const double ratio = at(tree.ratios(), i.at);
                        const glm::dvec3 offset =
                            tree.offset(1, j, {ratio, at(tree.shifts(), s.at), side},
                                        exact::sincos_degrees(90.0 * turn));
                        const double mass = i.weight * s.weight * (0.5 / turns) * ratio * ratio *
                                            ratio * below.mass;
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

GaussianBlob cluster_blob(const SphereChildren& children, const ClusterMoments& below) {
    // Relative to the first child, in its radii, so that neither places nor radii lose their digits; or to the largest
    // one, where the first is hardly there.
    const SphereNode* unit = children.begin();
    for (const SphereNode& node : children)
        if (unit->sphere.radius < 1e-6 * node.sphere.radius) unit = &node;
    const Sphere& first = unit->sphere;
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
