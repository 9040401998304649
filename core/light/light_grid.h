// The volume of pass 1: columns along the light, slabs across it. Geometry only, no GL.
#pragma once

#include <glm/vec3.hpp>

#include "core/generate/particle_set.h"

namespace awan {

struct LightGrid {
    glm::dvec3 origin{0};         // scene point at texel (0, 0), slab 0
    glm::dvec3 u{0}, v{0}, w{0};  // unit axes; w points away from the light
    double texel = 1;             // scene units, along u and v
    double slab = 1;              // scene units, along w
    glm::ivec3 cells{0};          // texels u, texels v, slabs; slabs is a multiple of 8

    // Where a scene point lies on the grid: texels along u and v, slabs along w.
    glm::dvec3 place(glm::dvec3 p) const;
};

inline constexpr int kMaxLightTexels = 256;  // a side: 256 x 256 x 64 x 8 bytes are 32 MiB
inline constexpr int kMinLightTexels = 16;
inline constexpr int kMaxLightSlabs = 64;
// Texels in the typical (root mean square) standard deviation of the particles: the finest of these with which the work
// stays below kMaxLightWork, else the coarsest. At 2 a Gaussian is interpolated within 3%, at 1 within 12%.
inline constexpr double kTexelsPerS[] = {2, 1.5, 1.2, 1};
// Light falls off more smoothly along its way than across: slabs may be deeper than texels are wide.
inline constexpr double kSlabsPerTexel = 0.67;
// Bricks of 8 x 8 x 8 cells, each once for every particle in it; about 15 ms of one llvmpipe core.
inline constexpr double kMaxLightWork = 30'000;

// Holds every particle out to 4 s. particles is not empty.
LightGrid light_grid(const ParticleSet& particles, glm::dvec3 to_light);

}  // namespace awan
