#pragma once

#include "core/light/transport.h"

namespace awan {

// The sun's axes as SunDepth has them, and the box of the lattice that sun_depth would make around `own`.
struct SunPrism {
    glm::dvec3 u, v, w, origin;
    double cell = 0;
    glm::ivec3 cells{0};
};
SunPrism sun_prism(const ParticleSet& own, const glm::dvec3& towards_sun, int cells);

// Whether matter of a ball, all within `reach` of `center`, shades the prism or lies in it.
bool shades(const SunPrism& prism, const glm::dvec3& center, double reach);

// SunDepth on the prism. Depth starts, on the face towards the sun, with that of all of `all` that lies before it (its
// Gaussians cut there, as finely as the columns); `all` holds every particle that shades the prism.
SunDepth sun_depth_in(const SunPrism& prism, const ParticleSet& all);

}  // namespace awan
