// Gaussians summed at the nodes of a dense lattice.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/deadline.h"

namespace awan::truth {

// Lengths in cells; node (i, j, k) stands at (i, j, k).
struct LatticeGaussian {
    glm::dvec3 center{0};
    double s = 1;
    // It is 0 farther than cut * s from its centre.
    double cut = 5;
    double peak = 1;
};

// The smallest s that a lattice can hold; narrower Gaussians are widened to it, their mass kept.
inline constexpr double kNarrowest = 0.9;
// From this s on a Gaussian is summed on a lattice of twice the cell: there it has half of it at least.
inline constexpr double kWide = 6;

// What is to stand at the nodes, so that interpolating between them gives the Gaussian back. That widens what it is
// given by 1/6 cell^2 in each axis's variance; the Gaussian is narrowed by as much, so that the interpolated field has
// its mass and its width. What is left is a ripple of the cells' period and mean 0, at most peak / (4 s^2).
LatticeGaussian narrowed(const LatticeGaussian& gaussian);

// The sums at all nodes, x fastest, then y, then z. Wide Gaussians are summed on lattices 2, 4, ... times coarser, and
// refined by cubic interpolation (error < 0.2% of their peak). Bytes do not depend on threads. Errors: kOverDeadline,
// kCancelled.
Result<std::vector<float>> sum_at_nodes(const glm::ivec3& nodes,
                                        std::span<const LatticeGaussian> gaussians, int threads,
                                        const Deadline& deadline);

// Values of `fine` nodes along a line out of those at every second of them: fine[i] of coarse nodes weight by weight.
// The four-point rule of Deslauriers & Dubuc, cubic through the nodes.
struct Refining {
    int first = 0, count = 1;
    float weight[4] = {1, 0, 0, 0};
};
// For fine node i: coarse nodes first..first + count - 1; those beyond the lattice's ends are 0.
Refining refining(int i);

// A whole row: fine[i], i in 0..count - 1, gets += what `coarse` (of `length` nodes) says.
void add_refined_row(const float* coarse, int length, float* fine, int count);

}  // namespace awan::truth
