#include "core/generate/automaton/coarse.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/generate/automaton/parcels.h"
#include "core/scene/automaton.h"

namespace awan::automaton {

Result<ModelParticles> coarse_automaton(const AutomatonCloud& cloud, std::uint64_t key,
                                        std::uint64_t steps, const Deadline& deadline) {
    const std::vector<AutomatonEllipsoid> first = first_ellipsoids(cloud, key);
    std::vector<AutomatonEllipsoid> ellipsoids = first;
    // Ellipsoids times steps that take some 50 ms. Above that they are left where they began.
    constexpr double kMostMoves = 1e7;
    const double moves = static_cast<double>(steps) * static_cast<double>(first.size()) *
                         static_cast<double>(cloud.wind.ellipsoids.size());
    if (moves > 0 && moves <= kMostMoves)
        for (std::uint64_t step = 0; step < steps; ++step)
            move_ellipsoids(cloud, first, key, step, ellipsoids);
    if (auto late = deadline.over()) return *late;

    const glm::dvec3 low(0, std::clamp(cloud.base, 0.0, cloud.cells.y), 0);
    const glm::dvec3 corner(cloud.cells.x / 2, 0, cloud.cells.z / 2);
    ModelParticles made;
    const auto add = [&](const glm::dvec3& at, double radius) {
        const glm::dvec3 inside = glm::clamp(at, low, cloud.cells);
        made.particles.positions.push_back(cloud.cell * (inside - corner));
        made.particles.radii.push_back(static_cast<float>(cloud.cell * radius));
        made.particles.densities.push_back(0.25F);
    };
    for (const AutomatonEllipsoid& one : ellipsoids) {
        const glm::dvec3 radii = glm::min(one.radii, cloud.cells);
        // Never larger than the middle of the grid allows, so that bounds stay the grid's.
        const double radius = std::max(0.4 * std::min({radii.x, radii.y, radii.z}), 0.5);
        add(one.center, radius);
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-0.6, 0.6}) {
                glm::dvec3 at = one.center;
                at[axis] += side * one.radii[axis];
                add(at, radius);
            }
    }
    return made;
}

}  // namespace awan::automaton
