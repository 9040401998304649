// The sun's light on one island of several (islands.h).
#pragma once

#include "core/generate/particle_set.h"
#include "core/light/sun_depth.h"
#include "core/survey/lattice.h"

namespace awan {

// Whether matter that lies within `reach` of `center` can shade a prism, or lie in it. prism: the box of a sun_lattice;
// w is the way the light goes.
bool shades(const Lattice& prism, const glm::dvec3& center, double reach);

// The sun's depth within the prism. `all` holds every particle that shades it. Matter before the prism is not on its
// lattice: where light enters a column, the depth begins with that of all Gaussians before it, each cut off at the face
// towards the sun.
SunDepth sun_depth_in(const Lattice& prism, const ParticleSet& all);

}  // namespace awan
