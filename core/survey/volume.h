#pragma once

#include "core/base/deadline.h"
#include "core/survey/survey.h"

namespace awan {

inline constexpr double kMaxVolumeWork = 1e7;  // about 10 ms

// The density volume of a set of particles: cubic cells, at most max_cells along its longest side,
// fewer when the work would pass most_work cell updates. Empty (0 cells) for an empty set or
// one without mass. Past the deadline it breaks off, and what it gives is of no use.
DensityVolume density_volume(const ParticleSet& particles, int max_cells,
                             double most_work = kMaxVolumeWork, const Deadline& deadline = {});

// Mean extinction (1/unit) of the cell at a place that is given in cells from the volume's origin; beside the volume,
// of the cell nearest to it. The volume is not empty.
double extinction_of_cell(const DensityVolume& volume, const glm::dvec3& place);

}  // namespace awan
