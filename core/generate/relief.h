// The hills of a scene's ground (core/scene/terrain.h) as heights at the nodes of a raster. Between four nodes a height
// is bilinear: that surface is the terrain, for light, draw and truth alike. Its normals are those of the slopes at the
// nodes, bilinear too, so that it looks smooth.
//
// Hills by seed are a ridged multifractal (Ebert et al. 2003): octaves of 1 - |noise|, squared, each as strong as the
// one before it is high there, so that valleys are smooth and ridges rough; a broad noise says where massifs stand.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/scene/scene.h"

namespace awan {

// Cells along a relief's longer side. A power of two.
inline constexpr int kReliefSide = 1024;

struct Relief {
    // x and z of node (0, 0), and between nodes; scene units.
    glm::dvec2 low{0}, cell{1};
    // One less than nodes, 1..kReliefSide.
    glm::ivec2 cells{0};
    // y of the level ground.
    double base = 0;
    // Above that, scene units, x fastest, (cells.x + 1) * (cells.y + 1); 0 at the sides.
    std::vector<float> height;
    // Of them.
    double highest = 0;
    // Level k: the highest corner of blocks of 2^k cells a side, x fastest; each level half as wide as the one before,
    // rounded up, to a single block.
    struct Level {
        glm::ivec2 blocks{0};
        std::vector<float> highest;
    };
    std::vector<Level> levels;
    // What it is made of. Snow: from that height on; infinite: nowhere. Patches of a little more and less are so wide,
    // scene units.
    glm::dvec3 albedo{0}, rock{0}, mean_albedo{0};
    double snow = 0, mottle = 1;
    std::uint64_t key = 0;

    float node(int x, int z) const {
        return height[static_cast<std::size_t>(z) * static_cast<std::size_t>(cells.x + 1) +
                      static_cast<std::size_t>(x)];
    }
    glm::dvec2 high() const { return low + cell * glm::dvec2(cells); }
    std::size_t bytes() const;
};

// Of a scene that has_terrain; else null. Made when it is first asked for, by as many threads, in a third of a second
// of one core; the same for every number of threads.
std::shared_ptr<const Relief> relief_of(const SceneDraft& scene, int threads);

// Above the base at x, z; 0 beside it.
double height_at(const Relief& relief, double x, double z);

// Unit, upward.
glm::dvec3 normal_at(const Relief& relief, double x, double z);

// Of the surface there, where its normal is that: the ground's in patches of a little more and less; rock where it is
// steep; snow where it is high and not steep.
glm::dvec3 albedo_at(const Relief& relief, double x, double z, const glm::dvec3& normal);

}  // namespace awan
