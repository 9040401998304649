#include "core/generate/automaton/parcels.h"

#include <algorithm>

#include "core/generate/automaton/wind.h"
#include "core/generate/keyed_random.h"

namespace awan::automaton {
namespace {

constexpr std::uint64_t kFirst = 0x70617263656c7331u, kAgain = 0x70617263656c7332u;

double uniform(std::uint64_t key, std::uint64_t number) {
    return unit_open(static_cast<std::uint32_t>(keyed(key, number) >> 32));
}

double between(double low, double high, double share) {
    return low + (high - low) * share;
}

// Where along an axis an ellipsoid of that radius may lie within 0..side, `share` of the way; the middle where it is
// too wide.
double place(double side, double radius, double share) {
    return side > 2 * radius ? between(radius, side - radius, share) : side / 2;
}

// Along which axis the wind has taken an ellipsoid out of the grid; -1: none. Where it takes it along, and no other
// way: one that was put beside the grid stays there.
int axis_of_leaving(const AutomatonCloud& cloud, const AutomatonEllipsoid& ellipsoid,
                    const glm::dvec2& speed) {
    for (const int axis : {0, 2}) {
        const double v = axis == 0 ? speed.x : speed.y;
        if (v > 0 && !(ellipsoid.center[axis] - ellipsoid.radii[axis] < cloud.cells[axis]))
            return axis;
        if (v < 0 && !(ellipsoid.center[axis] + ellipsoid.radii[axis] > 0)) return axis;
    }
    return -1;
}

}  // namespace

std::vector<AutomatonEllipsoid> first_ellipsoids(const AutomatonCloud& cloud, std::uint64_t key) {
    std::vector<AutomatonEllipsoid> ellipsoids = cloud.ellipsoids;
    const RandomEllipsoids random = random_ellipsoids_of(cloud);
    for (std::uint64_t n = 0; n < random.count; ++n) {
        const std::uint64_t own = keyed(keyed(key, kFirst), n);
        AutomatonEllipsoid ellipsoid;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::uint64_t>(axis);
            const double side = cloud.cells[axis];
            double& radius = ellipsoid.radii[axis];
            radius = between(random.smallest[axis], random.largest[axis], uniform(own, a));
            if (axis != 1 || !random.level) radius = std::min(radius, side / 2);
            ellipsoid.center[axis] = place(side, radius, uniform(own, 3 + a));
        }
        if (random.level) ellipsoid.center.y = *random.level;
        ellipsoids.push_back(ellipsoid);
    }
    return ellipsoids;
}

bool move_ellipsoids(const AutomatonCloud& cloud, const std::vector<AutomatonEllipsoid>& first,
                     std::uint64_t key, std::uint64_t step,
                     std::vector<AutomatonEllipsoid>& ellipsoids) {
    bool moved = false;
    const RandomEllipsoids random = random_ellipsoids_of(cloud);
    for (std::size_t n = 0; n < ellipsoids.size(); ++n) {
        AutomatonEllipsoid& ellipsoid = ellipsoids[n];
        const glm::dvec2 speed = wind_on_ellipsoids(cloud.wind, ellipsoid.center.y);
        if (speed == glm::dvec2(0)) continue;
        moved = true;
        ellipsoid.center.x += speed.x;
        ellipsoid.center.z += speed.y;
        const int left_along = axis_of_leaving(cloud, ellipsoid, speed);
        if (left_along < 0) continue;
        const std::uint64_t own = keyed(keyed(keyed(key, kAgain), n), step);
        const bool is_random = n >= cloud.ellipsoids.size();
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::uint64_t>(axis);
            const double change =
                between(-cloud.wind.mutation, cloud.wind.mutation, uniform(own, a));
            const double half = cloud.cells[axis] / 2;
            // Changed by chance, but never narrower than a quarter of a cell, so that it still has a middle.
            double& radius = ellipsoid.radii[axis];
            radius = std::max(first[n].radii[axis] * (1 + change), 0.25);
            if (axis != 1 || !random.level || !is_random) radius = std::min(radius, half);
            ellipsoid.center[axis] = place(2 * half, radius, uniform(own, 3 + a));
        }
        if (is_random && random.level) ellipsoid.center.y = *random.level;
        const double radius = ellipsoid.radii[left_along];
        ellipsoid.center[left_along] =
            (left_along == 0 ? speed.x : speed.y) > 0 ? radius : cloud.cells[left_along] - radius;
    }
    return moved;
}

}  // namespace awan::automaton
