// Matter of ellipsoids and of the sky plane on cubic cells, and Gaussians made of it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/deadline.h"
#include "core/generate/ellipsoids/formations.h"
#include "core/generate/ellipsoids/texture.h"
#include "core/generate/models.h"

namespace awan {

// Opacity 0..1 of every cell, at its middle; x fastest, then z, then y: a layer is level.
struct OpacityLattice {
    glm::dvec3 origin{0};  // corner of cell 0, the cloud's units
    double cell = 1;       // side
    double layer = 1;      // height of a layer, <= cell
    glm::ivec3 cells{0};   // along x, y, z
    std::vector<float> values;

    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.z) +
                static_cast<std::size_t>(z)) *
                   static_cast<std::size_t>(cells.x) +
               static_cast<std::size_t>(x);
    }
    glm::dvec3 middle(int x, int y, int z) const {
        return origin + glm::dvec3((x + 0.5) * cell, (y + 0.5) * layer, (z + 0.5) * cell);
    }
};

// Where ellipsoids overlap the most opaque one counts: they are joined, not stacked.
OpacityLattice lattice_of(const std::vector<PlacedEllipsoid>& ellipsoids, std::uint64_t resolution,
                          const TextureFunction& texture, int threads, const Deadline& deadline);

// A slab around the plane. At its middle height it is as opaque as the source's plane, so that on a vertical line the largest opacity
// is the source's; towards its faces the threshold rises by `range`, which makes the sheet thin where its texture is. Fades out
// over the outer tenth of the square.
OpacityLattice lattice_of(const SkyPlane& plane, const TextureFunction& texture, int threads,
                          const Deadline& deadline);

// One Gaussian a cell, s = .65 cells: a constant comes back within .05%. `density` is the extinction where opaque. Cells of
// less than kLeastOpacity are left out.
inline constexpr double kLeastOpacity = 1e-3;
void add_particles(const OpacityLattice& lattice, double density, ReadyParticles& particles);

// What cells and Gaussians lose: rms error of the optical depths of vertical lines (8 x 8 of them over the lattice) against
// the ellipsoids themselves, over the rms depth. 0 where there is nothing.
double sampling_error(const OpacityLattice& lattice, const std::vector<PlacedEllipsoid>& ellipsoids,
                      const TextureFunction& texture, int threads, const Deadline& deadline);

}  // namespace awan
