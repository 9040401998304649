#include "core/generate/automaton/parcels.h"

#include <algorithm>

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

// How far a wind moves what stands at height y, cells a step.
double speed_at(const AutomatonWind& wind, double y) {
    double speed = 0;
    for (const AutomatonWindBand& band : wind.ellipsoids)
        if (y >= band.from && y <= band.to)
            speed += band.speed.constant + band.speed.linear * y + band.speed.quadratic * y * y;
    return speed;
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
        const double speed = speed_at(cloud.wind, ellipsoid.center.y);
        if (speed == 0) continue;
        moved = true;
        ellipsoid.center.x += speed;
        const double left = ellipsoid.center.x + ellipsoid.radii.x;
        const double right = ellipsoid.center.x - ellipsoid.radii.x;
        if (speed > 0 ? right < cloud.cells.x : left > 0) continue;
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
        ellipsoid.center.x = speed > 0 ? ellipsoid.radii.x : cloud.cells.x - ellipsoid.radii.x;
    }
    return moved;
}

}  // namespace awan::automaton
