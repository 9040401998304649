// The sun's depth in matter that lies flat: in columns that lean with the light.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/generate/particle_set.h"
#include "core/light/sun_depth.h"

namespace awan {

// A lattice that faces a low sun sees a flat cloud from the side, and no axis of it is short: it can't be fine where
// the cloud is thin. Here layers lie in the cloud, as thin as they must be, and columns run along the light. The
// cloud's cells are filled upright, and each layer is then moved sideways to where the columns are. As many nodes as
// the lattice of sun_lattice would have, with `cells` along its longest side. None: the matter is not flat, has detail
// (whose bumps are as large along all axes), or the sun is too low over it.
std::optional<SunDepth> leaning_sun_depth(const ParticleSet& particles,
                                          const glm::dvec3& towards_sun, int cells, int threads);

}  // namespace awan
