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

// The upper levels have so many spheres in the lowest of them, at most: four levels of five parts. Their shadows are
// as soft as those of light that has been scattered on.
constexpr double kUpperSpheres = 2500;
// And those that light is followed to: six levels of five parts.
constexpr double kLitSpheres = 17000;

// A ray meets parts * E(I_j^2) times as many spheres at each level. Where that runs away (large ratios), the levels
// that would make it more than this are not told apart: they are cloud everywhere.
constexpr double kMostHits = 1000;

int told_apart(const SphereTree& tree) {
    const double more = tree.met();
    int levels = 0;
    for (double hits = more; levels < tree.levels() && hits <= kMostHits; hits *= more) ++levels;
    return levels;
}

// How many levels have at most so many spheres.
int levels_within(const SphereTree& tree, double most) {
    int levels = 0;
    for (double count = tree.parts(); levels < tree.levels() && count <= most;
         count *= tree.parts())
        ++levels;
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
        0,
        0,
        relief_of(*scene, spheres)};
    made.levels = told_apart(made.tree);
    // A cluster's mass over that of a sphere of its own extinction; the mean depth is in proportion.
    for (const ClusterMoments& moments : cluster_moments(made.tree))
        made.thinning.push_back(moments.mass);
    made.thinning.push_back(made.thinning.back() *
                            (made.thinning.size() > 1 ? made.thinning[1] : 1));
    made.upper_levels = levels_within(made.tree, kUpperSpheres);
    made.lit_level = levels_within(made.tree, kLitSpheres);
    made.upper = upper_spheres(made.tree, made.upper_levels);
    return made;
}

// The share of light that is left after sphere `index` of `level` and what lies below it.
double through_upper(const LookCloud& cloud, std::size_t index, int level, const glm::dvec3& from,
                     const glm::dvec3& direction, double sigma) {
    constexpr double kDark = 1e-9;
    const Sphere& sphere = cloud.upper[index];
    SphereHit hit;
    if (!meets(sphere.center - from, sphere.radius, direction, hit)) return 1;
    if (level == cloud.upper_levels) {
        const auto below = static_cast<std::size_t>(cloud.tree.levels() - level);
        return through(hit, sphere.radius, sigma * cloud.thinning[below]);
    }
    double left = 1;
    const auto parts = static_cast<std::size_t>(cloud.tree.parts());
    for (std::size_t child = parts * index + 1; child <= parts * (index + 1) && left > kDark;
         ++child)
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
    // What is scattered again and again comes through by far more than what is not: 1 / (1 + 3/4 depth) of it, by two
    // streams (Chandrasekhar 1950).
    return 1 / (1 - 0.75 * exact::log(std::max(left, 1e-300)));
}

}  // namespace awan::looks
