// An implicit cloud's density on a lattice.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/implicit/field.h"
#include "core/generate/lattice_particles.h"

namespace awan::implicit {

// An empty lattice of `resolution` cells along the longest side of box_of(field). It is the same at all times, so
// that a moving cloud moves through it and not with it. An empty field gives no cells.
LatticeField lattice_over(const ImplicitField& field, std::uint64_t resolution);

// The same place with cells twice as large, each the mean of eight.
LatticeField coarser(const LatticeField& lattice);

// Fills in the values. The same for every number of threads. Errors: kOverDeadline, kCancelled.
Status sample(const ImplicitField& field, int threads, const Deadline& deadline,
              LatticeField& lattice);

// How far pictures of two lattices over one place are from each other, root mean square over root mean square; a cell
// of `coarse` is `group`^3 of `fine`. Along the three axes: of thin clouds, whose pictures are sums along lines, and
// of clouds that are kOpaque deep in their middle, whose pictures are opacities. The larger of the two.
inline constexpr double kOpaque = 20;
double picture_difference(const LatticeField& fine, const LatticeField& coarse, int group);

// What a picture of `lattice` is wrong by, root mean square over root mean square. It is estimated from how far
// `half` (coarser(), sampled as coarsely) is from it, and from the octaves that `field`, of which the lattice is,
// leaves out. Measured in implicit_particles_test.
double sampling_error(const LatticeField& lattice, const LatticeField& half,
                      const ImplicitField& field);

}  // namespace awan::implicit
