// The scene's hills as the path tracer meets them: its own way from cell to cell and its own roots. Positions in scene
// units.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/generate/relief.h"
#include "core/truth/path_random.h"

namespace awan::truth {

// Cells along the side of a block whose highest place is kept, so that a ray above it need not look at its cells.
inline constexpr int kReliefBlock = 16;

struct ReliefWalk {
    std::shared_ptr<const Relief> relief;
    glm::ivec2 blocks{0};
    std::vector<double> tops;  // above the base, x fastest
};
// None where the scene has no hills.
std::optional<ReliefWalk> relief_walk_of(const Scene& scene, int threads);

// Distance at which o + t d (d unit, t > 0) comes from above the ground to below it: the hills, and the level ground
// beside them. Infinite: nowhere.
double ground_ahead(const ReliefWalk& walk, const glm::dvec3& o, const glm::dvec3& d);

// The same of hills alone, whether there are any.
bool hills_before(const ReliefWalk& walk, const glm::dvec3& o, const glm::dvec3& d);

// A place a little above the ground, for a place on it.
glm::dvec3 above_ground(const ReliefWalk& walk, const glm::dvec3& place);

// A direction by Lambert's cosine about a normal (unit), in the axes of that.
glm::dvec3 scattered_off(const glm::dvec3& normal, PathRandom& random);

}  // namespace awan::truth
