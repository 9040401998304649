// The density of an automaton's cells as Gaussians.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/automaton/density_planes.h"
#include "core/generate/models.h"

namespace awan::automaton {

// One Gaussian a cell: a metaball of the cell's density whose integral is that of one cell (metaball.h), as the
// Gaussian of the same mass and second moment. Where that makes more than `most`, one Gaussian a block of 2x2x2
// cells, of 4x4x4, ...: mass and centre of mass stay, the trace of the second moment too. `error` says what the
// blocks cost; `block` is the side of one, in cells.
struct CellParticles {
    ReadyParticles particles;
    double error = 0;
    std::size_t block = 1;
};
Result<CellParticles> cells_to_particles(const AutomatonCloud& cloud, const CellDensity& density,
                                         std::uint64_t most, int threads, const Deadline& deadline);

}  // namespace awan::automaton
