#include "core/survey/separate_clouds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"

namespace awan {
namespace {

// Optical depth that shows.
constexpr double kShows = 0.01;
constexpr double kLeastReach = 2, kMostReach = 4;  // s

void take(const glm::dvec3& center, double reach, bool first, Bounds& bounds) {
    const glm::dvec3 low = center - reach, high = center + reach;
    bounds.min = first ? low : glm::min(bounds.min, low);
    bounds.max = first ? high : glm::max(bounds.max, high);
}

void take(const ParticleSet& particles, std::uint32_t i, SeparateCloud& cloud) {
    const double s = gaussian_s(particles, i);
    const double deep = std::max(1.0, central_depth(particles, i) / kShows);
    const double reach = std::clamp(std::sqrt(2 * exact::log(deep)), kLeastReach, kMostReach);
    const bool first = cloud.particles.empty();
    take(particles.center[i], reach * s, first, cloud.shows);
    take(particles.center[i], kMostReach * s, first, cloud.all);
    cloud.particles.push_back(i);
}

// The islands below a node.
void regions_below(const std::vector<IslandNode>& nodes, int node, std::vector<int>& regions) {
    std::vector<int> open{node};
    while (!open.empty()) {
        const IslandNode& here = nodes[static_cast<std::size_t>(open.back())];
        open.pop_back();
        if (here.axis < 0) {
            regions.push_back(here.below);
            continue;
        }
        open.push_back(here.above);
        open.push_back(here.below);
    }
}

// Whether an island on one side of a node reaches into one on its other side.
bool interpenetrate(const std::vector<IslandNode>& nodes, const IslandNode& node,
                    const std::vector<SeparateCloud>& islands) {
    std::vector<int> below, above;
    regions_below(nodes, node.below, below);
    regions_below(nodes, node.above, above);
    const auto at = [&](int i) -> const SeparateCloud& {
        return islands[static_cast<std::size_t>(i)];
    };
    for (const int a : below) {
        if (at(a).particles.empty() || at(a).shows.max[node.axis] <= node.cut) continue;
        for (const int b : above)
            if (!at(b).particles.empty() && overlap(at(a).shows, at(b).shows)) return true;
    }
    // What reaches over the plane into nobody's box has its place on either side.
    return false;
}

SeparateCloud joined(std::vector<SeparateCloud>& islands, const std::vector<int>& regions) {
    SeparateCloud all;
    for (const int region : regions) {
        SeparateCloud& one = islands[static_cast<std::size_t>(region)];
        if (one.particles.empty()) continue;
        if (all.particles.empty()) {
            all = std::move(one);
            continue;
        }
        all.shows = {glm::min(all.shows.min, one.shows.min),
                     glm::max(all.shows.max, one.shows.max)};
        all.all = {glm::min(all.all.min, one.all.min), glm::max(all.all.max, one.all.max)};
        all.particles.insert(all.particles.end(), one.particles.begin(), one.particles.end());
    }
    std::sort(all.particles.begin(), all.particles.end());
    return all;
}

}  // namespace

bool overlap(const Bounds& a, const Bounds& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(a.min[axis] < b.max[axis] && b.min[axis] < a.max[axis])) return false;
    return true;
}

SeparateClouds separate_clouds(const ParticleSet& particles, const Islands& islands) {
    SeparateClouds clouds;
    const auto count = static_cast<std::uint32_t>(particles.size());
    std::vector<SeparateCloud> regions(std::max<std::size_t>(islands.list.size(), 1));
    for (std::uint32_t i = 0; i < count; ++i)
        take(particles, i,
             regions[islands.nodes.empty()
                         ? 0
                         : static_cast<std::size_t>(island_at(islands, particles.center[i]))]);
    clouds.nodes = islands.nodes;
    if (clouds.nodes.empty()) clouds.nodes.push_back({-1, 0, 0, 0});
    // From the root: a node whose sides reach into each other is one cloud.
    std::vector<int> open{0};
    while (!open.empty()) {
        IslandNode& node = clouds.nodes[static_cast<std::size_t>(open.back())];
        const int index = open.back();
        open.pop_back();
        if (node.axis >= 0 && !interpenetrate(clouds.nodes, node, regions)) {
            open.push_back(node.above);
            open.push_back(node.below);
            continue;
        }
        std::vector<int> below;
        regions_below(clouds.nodes, index, below);
        SeparateCloud cloud = joined(regions, below);
        node = {-1, 0, -1, 0};
        if (cloud.particles.empty()) continue;
        node.below = static_cast<int>(clouds.list.size());
        clouds.list.push_back(std::move(cloud));
    }
    return clouds;
}

std::vector<std::size_t> front_to_back(const SeparateClouds& clouds, const glm::dvec3& eye) {
    std::vector<std::size_t> order;
    std::vector<int> open{0};
    while (!open.empty()) {
        const IslandNode& node = clouds.nodes[static_cast<std::size_t>(open.back())];
        open.pop_back();
        if (node.axis < 0) {
            if (node.below >= 0) order.push_back(static_cast<std::size_t>(node.below));
            continue;
        }
        const bool below = eye[node.axis] < node.cut;
        open.push_back(below ? node.above : node.below);
        open.push_back(below ? node.below : node.above);
    }
    return order;
}

ParticleSet some_of(const ParticleSet& particles, const std::vector<std::uint32_t>& indices) {
    ParticleSet some;
    some.detail = particles.detail;
    some.error = particles.error;
    some.variant = particles.variant;
    for (const std::uint32_t i : indices) {
        some.center.push_back(particles.center[i]);
        some.radius.push_back(particles.radius[i]);
        some.density.push_back(particles.density[i]);
        if (!particles.color.empty()) some.color.push_back(particles.color[i]);
        if (!particles.paint.empty()) some.paint.push_back(particles.paint[i]);
    }
    return some;
}

}  // namespace awan
