// Where a scene's matter falls apart: disjoint boxes, found by cutting through (nearly) empty space.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"

namespace awan {

// The particles whose centres lie in one region.
struct Island {
    // Holds them out to 4 s, scene units.
    glm::dvec3 low{0}, high{0};
    // 0: the region has only others' fringes.
    std::size_t particles = 0;
    // Over its particles, of s^0..s^3, unit^k.
    std::array<double, 4> s_sums{};
    // Optical depth of its longest line along an axis, of matter in whole cells.
    double depth = 0;
};

// A k-d tree over all of space: a point is in one region.
struct IslandNode {
    // -1: a region, and `below` is its index in Islands::list.
    int axis = -1;
    double cut = 0;
    int below = 0, above = 0;  // nodes
};
struct Islands {
    // The root first; EMPTY: all is one.
    std::vector<IslandNode> nodes;
    std::vector<Island> list;
};

// Cuts go through planes in which no line along the axes has more optical depth than kCutDepth, the widest gaps
// first, and only stay where the pieces' boxes together are smaller than the whole by kPays: a single cloud is one,
// and so is a field too dense to gain. At most kMostIslands. Time: linear in the particles (about 40 ns each) and up
// to 30 ms. The cells' extinction is a box's of each particle's mass and width: it finds gaps, and is for nothing
// else.
Islands find_islands(const ParticleSet& particles);

inline constexpr double kCutDepth = 0.3;
inline constexpr double kPays = 0.5;       // of the scene's box
inline constexpr double kPartPays = 0.95;  // of a part's
inline constexpr std::size_t kMostIslands = 512;

// The region of a point. Precondition: there are some.
int island_at(const Islands& islands, const glm::dvec3& point);

// The region of the ray's point at t, and the t > from where it leaves it, infinite if it does not.
struct IslandOnRay {
    int island;
    double until;
};
IslandOnRay island_on_ray(const Islands& islands, const glm::dvec3& start,
                          const glm::dvec3& direction, double t);

}  // namespace awan
