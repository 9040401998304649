// Fills the bricks of a Matter (matter.h), column by column along the sun's light.
#pragma once

#include <vector>

#include "core/truth/lattice.h"
#include "core/truth/matter.h"

namespace awan::truth {

// What stands on the lattice; q.
struct OnLattice {
    std::vector<LatticeGaussian> gaussians;
    // As long as `gaussians`.
    std::vector<glm::vec3> colors;
};

// m: all but `brick`, `nodes`, `tints` is there. Bytes do not depend on threads. Errors: kOverDeadline, kCancelled.
Status fill_bricks(Matter& m, const OnLattice& matter, int threads, const Deadline& deadline);

}  // namespace awan::truth
