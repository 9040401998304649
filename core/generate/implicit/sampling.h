// An implicit cloud's density on a lattice.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/implicit/field.h"
#include "core/generate/lattice_particles.h"

namespace awan::implicit {

// An empty lattice of `resolution` cells along the longest side of box_of(field), of fewer where there would be more
// than limits::kMaxImplicitCells in all. It is the same at all times, so that a moving cloud moves through it and not
// with it. An empty field gives no cells.
LatticeField lattice_over(const ImplicitField& field, std::uint64_t resolution);

// The same place with cells half as large, each an eighth of one.
LatticeField finer(const LatticeField& lattice);

// Fills in the values, by the field at the middles of cells. where: of which the lattice is finer(); what has no
// density there, nor near it, is left at 0 and not looked at. Null: all is. The same for every number of threads.
// Errors: kOverDeadline, kCancelled.
Status sample(const ImplicitField& field, int threads, const Deadline& deadline,
              LatticeField& lattice, const LatticeField* where = nullptr);

// Gives each cell of `lattice` the mean of its eight in `fine`, which is finer(lattice).
void take_means(const LatticeField& fine, int threads, LatticeField& lattice);

// What pictures of the Gaussians that lattice_particles() makes of `lattice`, sharpened, are wrong by, root mean square
// over mean, estimated from what they lose of `fine`. density: extinction of the value 1, 1/unit.
double sampling_error(const LatticeField& lattice, const LatticeField& fine, double density);

}  // namespace awan::implicit
