#pragma once

#include "core/survey/survey.h"

namespace awan {

// The density volume of a set of particles: cubic cells, at most max_cells along its longest side,
// fewer when the work would pass kMaxVolumeWork cell updates. Empty (0 cells) for an empty set or
// one without mass.
DensityVolume density_volume(const ParticleSet& particles, int max_cells);

inline constexpr double kMaxVolumeWork = 1e7;  // about 10 ms

}  // namespace awan
