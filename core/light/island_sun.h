#pragma once

#include "core/generate/particle_set.h"
#include "core/light/sun_depth.h"
#include "core/survey/lattice.h"

namespace awan {

// Whether matter of a ball, all within `reach` of `center`, shades a prism, the box of a sun_lattice, or lies in it.
bool shades(const Lattice& prism, const glm::dvec3& center, double reach);

// SunDepth on the prism. Depth starts, on the face towards the sun, with that of all of `all` that lies before it (its
// Gaussians cut there, as finely as the columns); `all` holds every particle that shades the prism.
SunDepth sun_depth_in(const Lattice& prism, const ParticleSet& all);

}  // namespace awan
