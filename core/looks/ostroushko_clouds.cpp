#include "core/looks/ostroushko_clouds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/extinction.h"

namespace awan::looks {
namespace {

using spheres::cluster_moments;
using spheres::ClusterMoments;
using spheres::extinction_of;
using spheres::SphereNode;

// 781 spheres. Their shadows are as soft as those of light that has been scattered on.
constexpr int kUpperLevels = 4;

// A ray meets 5 E(I_j^2) times as many spheres at each level. Where that runs away (large ratios), the levels that
// would make it more than this are not told apart: they are cloud everywhere.
constexpr double kMostHits = 1000;

int told_apart(const SphereTree& tree) {
    const Span ratios = tree.ratios();
    const double low = ratios.low, high = ratios.high;
    const double more = 5 * (low * low + low * high + high * high) / 3;
    int levels = 0;
    for (double hits = more; levels < tree.levels() && hits <= kMostHits; hits *= more) ++levels;
    return levels;
}

std::vector<Sphere> upper_spheres(const SphereTree& tree, int levels) {
    std::vector<SphereNode> nodes = {tree.root()};
    std::size_t first = 0;
    for (int level = 0; level < levels; ++level) {
        const std::size_t end = nodes.size();
        for (; first < end; ++first) {
            const auto children = tree.children(nodes[first], level);
            nodes.insert(nodes.end(), children.begin(), children.end());
        }
    }
    std::vector<Sphere> spheres;
    for (const SphereNode& node : nodes) spheres.push_back(node.sphere);
    return spheres;
}

LookCloud look_cloud(const Scene& scene, std::size_t k, const glm::dvec3& eye) {
    const Cloud& cloud = scene->clouds[k];
    const SpheresCloud& spheres = *cloud.spheres;
    const Motion motion = motion_of(cloud, clouds_time(*scene));
    LookCloud made{
        SphereTree(spheres, keyed(cloud.seed.value_or(scene->seed), k), k, clouds_time(*scene)),
        motion,
        motion.back(eye),
        extinction_of(spheres, cloud.density.value_or(scene->density.value_or(kDefaultDensity))),
        0,
        {},
        {},
        0};
    made.levels = told_apart(made.tree);
    // A cluster's mass over that of a sphere of its own extinction; the mean depth is in proportion.
    for (const ClusterMoments& moments : cluster_moments(made.tree))
        made.thinning.push_back(moments.mass);
    made.thinning.push_back(made.thinning.back() *
                            (made.thinning.size() > 1 ? made.thinning[1] : 1));
    made.upper_levels = std::min(made.tree.levels(), kUpperLevels);
    made.upper = upper_spheres(made.tree, made.upper_levels);
    return made;
}

// The share of light that is left after sphere `index` of `level` and what lies below it.
double through_upper(const LookCloud& cloud, std::size_t index, int level, const glm::dvec3& from,
                     const glm::dvec3& direction, double sigma) {
    constexpr double kDark = 1e-3;
    const Sphere& sphere = cloud.upper[index];
    SphereHit hit;
    if (!meets(sphere.center - from, sphere.radius, direction, hit)) return 1;
    if (level == cloud.upper_levels) {
        const auto below = static_cast<std::size_t>(cloud.tree.levels() - level);
        return through(hit, sphere.radius, sigma * cloud.thinning[below]);
    }
    double left = 1;
    for (std::size_t child = 5 * index + 1; child <= 5 * index + 5 && left > kDark; ++child)
        left *= through_upper(cloud, child, level + 1, from, direction, sigma);
    return left;
}

}  // namespace

double through(const SphereHit& hit, double radius, double sigma) {
    const double f = 1 - std::min(hit.middle / radius, 1.0);
    return exact::exp(-sigma * (hit.leave - hit.enter)) * f + 1 - f;
}

std::vector<LookCloud> look_clouds(const Scene& scene, const glm::dvec3& eye) {
    std::vector<LookCloud> clouds;
    clouds.reserve(scene->clouds.size());
    for (std::size_t k = 0; k < scene->clouds.size(); ++k)
        clouds.push_back(look_cloud(scene, k, eye));
    return clouds;
}

glm::dvec3 turned(const LookCloud& cloud, const glm::dvec3& v) {
    const exact::SinCos& turn = cloud.motion.turn;
    return {v.x * turn.cos + v.z * turn.sin, v.y, v.z * turn.cos - v.x * turn.sin};
}

glm::dvec3 turned_back(const LookCloud& cloud, const glm::dvec3& v) {
    const exact::SinCos& turn = cloud.motion.turn;
    return {v.x * turn.cos - v.z * turn.sin, v.y, v.z * turn.cos + v.x * turn.sin};
}

double light_through(const std::vector<LookCloud>& clouds, const glm::dvec3& point,
                     const glm::dvec3& towards, double softened) {
    double left = 1;
    for (const LookCloud& cloud : clouds) {
        const glm::dvec3 from = cloud.eye + turned_back(cloud, point) / cloud.motion.scale;
        left *= through_upper(cloud, 0, 0, from, turned_back(cloud, towards),
                              softened * cloud.sigma * cloud.motion.scale);
    }
    return left;
}

}  // namespace awan::looks
