#pragma once

#include "core/light/transport.h"
#include "core/survey/lattice.h"

namespace awan {

// The lattice of transport.h for particles lit from `towards_sun` (unit), `cells` along its longest side, fewer where
// the work would pass kMaxSunWork. Depth at a node: mean extinctions of cells summed up from the sun's side.
SunDepth sun_depth(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                   int threads);

// Its lattice: w is the way the light goes.
Lattice sun_lattice(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                    int threads);

// On such a lattice, where `entry` is the depth before each of its columns (u fastest).
SunDepth sun_depth_on(const Lattice& lattice, const ParticleSet& particles,
                      std::vector<float> entry, int threads);

// Trilinear, as transport.h says.
double depth_at(const SunDepth& sun, const glm::dvec3& point);

inline constexpr double kMaxSunWork = 3e8;  // cell updates, about .3 s of one core

}  // namespace awan
