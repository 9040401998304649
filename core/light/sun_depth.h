#pragma once

#include "core/light/transport.h"

namespace awan {

// The lattice of transport.h for particles lit from `towards_sun` (unit), `cells` along its longest side, fewer where
// the work would pass kMaxSunWork. Depth at a node: mean extinctions of cells summed up from the sun's side.
SunDepth sun_depth(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                   int threads);

// Trilinear, as transport.h says.
double depth_at(const SunDepth& sun, const glm::dvec3& point);

inline constexpr double kMaxSunWork = 3e8;  // cell updates, about .3 s of one core

}  // namespace awan
