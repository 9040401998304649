#include "core/draw/march_fineness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/base/exact_math.h"
#include "core/survey/lattice.h"

namespace awan {
namespace {

// The longest step is never less than this, in cells of the light grid. It follows the particles, since matter that is
// smaller than a step is uneven within it: steps of whole cells had three times the error, which was seen as edges
// between blocks that step differently, and saved no time.
constexpr double kLeastStepCells = 0.7;

// Widest gap between looked up rays, in cells of the light grid and of the sun's depth: between the rays light is
// interpolated linearly. With 1.5 cells of the sun's depth the error was four times as large, 0.5% of a backlit
// picture, and edges were seen where the gap changes.
constexpr double kLightApart = 0.75, kSunApart = 0.75;
// Where there is light on fine cells, the sun's lattice is as much finer, for the sake of the light that enters there.
constexpr double kSunApartInDetail = 1.5;

// The side of a cube as large as a cell.
double typical(const glm::dvec3& cell) {
    return shortest(cell) == longest(cell) ? cell.x : exact::cbrt(cell.x * cell.y * cell.z);
}

// The distance between two layers of nodes along each axis.
glm::dvec3 layers_apart(const SunDepth& sun) {
    const glm::dmat3 rows = glm::transpose(to_nodes(sun));
    return 1.0 / glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
}

}  // namespace

double longest_step(const TransportLight& light, double mean_s, double least_s) {
    if (light.has_grid()) {
        const double side = typical(light.cell);
        return std::clamp(mean_s, kLeastStepCells * side, side);
    }
    if (!light.sun.depth.empty()) return longest(light.sun.cell * glm::dvec3(light.sun.nodes)) / 32;
    return least_s;
}

double most_apart(const TransportLight& light) {
    double most = light.has_grid() ? kLightApart * typical(light.cell) : 1e300;
    if (!light.fine.bands.empty()) most = kLightApart * typical(light.fine.cell);
    const double sun_apart = light.fine.bands.empty() ? kSunApart : kSunApartInDetail;
    if (light.sun.cell.x > 0) most = std::min(most, sun_apart * shortest(layers_apart(light.sun)));
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
