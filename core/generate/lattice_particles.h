// From a field sampled on a cubic lattice to Gaussians whose sum is that field: one a cell, all of one size.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace awan {

// Samples at origin + cell * (i, j, k), each the mean over the cell around it; outside, the field is 0. Sample (i, j,
// k) is values[(k * ny + j) * nx + i].
struct LatticeField {
    // Where sample (0, 0, 0) lies, units.
    glm::dvec3 origin{0};
    // The side of a cell, units, > 0.
    double cell = 1;
    int nx = 0, ny = 0, nz = 0;
    // nx * ny * nz values, finite, >= 0.
    std::vector<float> values;

    std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(ny) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(nx) +
               static_cast<std::size_t>(i);
    }
};

// The s of a particle, in cells. If it were wider, the field would blur; if narrower, the lattice would show. The sum
// over a constant field is constant within 2 exp(-2 pi^2 s^2) an axis: 4.8e-4 at .65, 3.9e-3 at .55.
inline constexpr double kLatticeS = 0.65;

// How cells become particles.
struct LatticeOptions {
    // Cells at or below this are left out. What they had is shared by the others in proportion, so that the mass
    // stays.
    float threshold = 0;
    // A sum of Gaussians is the field blurred by s. This takes most of the blur back: f - (s^2 / 2) laplace(f) in the
    // place of f, at least 0. A wave of 4 cells then keeps 84% of its height instead of 59%, one of 8 cells 98%
    // instead of 88%.
    bool sharpen = false;
};

// f - (s^2 / 2) laplace(f) at a cell, which may be < 0; s in cells.
double sharpened_at(const LatticeField& field, int i, int j, int k);

// Particles in the order of the samples, one for each cell that stays; their radii are 2 s = 1.3 cells, as float32.
// The integral of the Gaussians is that of the field, lattice_mass(), but for the rounding of floats (relative 1e-7),
// unless every cell is left out. The same for every number of threads (>= 1).
ReadyParticles lattice_particles(const LatticeField& field, const LatticeOptions& options,
                                 int threads);

// The integral of the field over space: the sum of its values times cell^3.
double lattice_mass(const LatticeField& field);

}  // namespace awan
