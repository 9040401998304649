#include "core/draw/march_fineness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace awan {
namespace {

// Least of the longest steps, in cells of the light. Matter that is smaller than a step is uneven within it: whole cells
// took three times the error and were seen as edges between blocks that step differently, at no gain in time.
constexpr double kLeastStepCells = 0.7;

// Most distance of looked up rays, in cells of the light and of the sun's depth: linear interpolation between them. 1.5 of the
// sun's made 4 times the error, .5% of a backlit picture, and edges where the spacing changes.
constexpr double kLightApart = 0.75, kSunApart = 0.75;

}  // namespace

double longest_step(const TransportLight& light, double mean_s, double least_s) {
    if (light.cell > 0) return std::clamp(mean_s, kLeastStepCells * light.cell, light.cell);
    const glm::ivec3 n = light.sun.nodes;
    if (light.sun.cell > 0 && !light.sun.depth.empty())
        return light.sun.cell * std::max({n.x, n.y, n.z, 1}) / 32;
    return least_s;
}

double most_apart(const TransportLight& light) {
    double most = light.cell > 0 ? kLightApart * light.cell : 1e300;
    if (light.sun.cell > 0) most = std::min(most, kSunApart * light.sun.cell);
    return most;
}

void fineness_in_cone(const std::vector<SeenIsland>& islands, const glm::dvec3& axis, double slope,
                      const Allowed& otherwise, std::vector<FineInterval>& intervals) {
    constexpr double kEver = std::numeric_limits<double>::infinity();
    intervals.assign(1, {-kEver, kEver, otherwise.apart, otherwise.step});
    for (const SeenIsland& island : islands) {
        const double along = glm::dot(island.center, axis);
        if (along + island.radius < 0) continue;
        const double off = glm::length(island.center - along * axis);
        if (off > island.radius + slope * (along + island.radius)) continue;
        intervals.push_back(
            {along - island.radius, along + island.radius, island.apart, island.step});
    }
}

Fineness fineness_at(const std::vector<FineInterval>& intervals, double distance) {
    Fineness found{1e300, std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
    for (const FineInterval& one : intervals) {
        if (one.from > distance) {
            found.until = std::min(found.until, one.from);
        } else if (one.to > distance) {
            found.until = std::min(found.until, one.to);
            found.apart = std::min(found.apart, one.apart);
            found.step = std::min(found.step, one.step);
        }
    }
    return found;
}

double finest_step(const std::vector<FineInterval>& intervals) {
    double step = intervals.front().step;
    for (const FineInterval& one : intervals) step = std::min(step, one.step);
    return step;
}

}  // namespace awan
