// Matter in clumps smaller than a grid's cells: the cells see it spread out, which hides more than clumps do, and
// shines more. No two grids differ by what neither sees.
#pragma once

#include <array>
#include <cstddef>

#include "core/generate/particle_set.h"
#include "core/survey/islands.h"

namespace awan {

// What grids with 8, 16, 32 ... cells along the longest side of the matter (of each of its islands) leave out: the
// share of extinction that is hidden behind its own clump, 0..1, mean over the matter. A clump is what the extinction
// is more than the cells' mean; of one whose depth is t, 1 - (1 - exp(-t)) / t is hidden.
struct Clumps {
    static constexpr int kFewestCells = 8;
    static constexpr std::size_t kGrids = 6;
    std::array<double, kGrids> hidden{};

    // Between the grids by the logarithm of their cells, beyond them as the last one. cells: > 0.
    double at(double cells) const;
};

// From so many of the particles as make 2^17 pairs with all of them, 8 to 64: some ms, of a million particles 50. The
// same for every number of threads. Precondition: particles are not empty.
Clumps find_clumps(const ParticleSet& particles, const Islands& islands, int threads);

}  // namespace awan
