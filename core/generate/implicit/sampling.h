// An implicit cloud's density on a lattice.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/implicit/field.h"
#include "core/generate/lattice_particles.h"

namespace awan {

// The lattice of `resolution` cells along the longest side of box_of(field): the same at all times, so that a moving
// cloud moves through it and not with it. Values are not filled in; of an empty field it has no cells.
LatticeField lattice_over(const ImplicitField& field, std::uint64_t resolution);

// One with cells twice as large over the same place, each over eight of the other's.
LatticeField coarser(const LatticeField& lattice);

// Fills in the values. The same for every number of threads. Fails when the deadline is over.
Status sample(const ImplicitField& field, int threads, const Deadline& deadline,
              LatticeField& lattice);

// How far pictures of two lattices over one place are from each other, rms over rms; a cell of `coarse` is `group`^3 of
// `fine`. Along the three axes: of thin clouds, whose pictures are sums along lines, and of clouds that are kOpaque
// deep in their middle, whose pictures are opacities; the larger of the two.
inline constexpr double kOpaque = 20;
double picture_difference(const LatticeField& fine, const LatticeField& coarse, int group);

// What a picture of `lattice` is wrong by, rms over rms, from how far `half` (coarser(), sampled as coarsely) is from
// it and from the octaves that `field`, of which the lattice is, leaves out. Measured in implicit_particles_test.
double sampling_error(const LatticeField& lattice, const LatticeField& half,
                      const ImplicitField& field);

}  // namespace awan
