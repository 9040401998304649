#pragma once

#include <vector>

#include "core/generate/particle_set.h"
#include "core/survey/lattice.h"

namespace awan {

// From the smooth extinctions of cells (extinction_in) to those with the particles' detail, looked up in the middle
// of each cell. Cells that are larger than the largest bumps keep their means, which are right as they are. Without
// detail: nothing.
void add_detail(const ParticleSet& particles, const Lattice& lattice, int threads,
                std::vector<float>& extinction);

}  // namespace awan
