// Mean extinction in the cells of any box, turned as one likes: what the transport solve and the
// sun's depth are made from.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/generate/particle_set.h"

namespace awan {

// Cubic cells along three orthonormal axes. Corner of cell (i, j, k): origin + cell (i u + j v + k w).
struct Lattice {
    glm::dvec3 origin{0};  // scene units
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
    double cell = 0;  // scene units
    glm::ivec3 cells{0};

    std::size_t size() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
    // Scene position of lattice coordinates (cells from the corner).
    glm::dvec3 at(const glm::dvec3& c) const {
        return origin + (cell * c.x) * u + (cell * c.y) * v + (cell * c.z) * w;
    }
};

// The smallest box along the axes outside of which no line has more optical depth than `rest`
// (dimensionless), found on a coarse volume; then divided so that `count` cells lie along its longest side, or, where
// extinction_in would need more than `most_work` updates (lattice_work), as few as 8.
// Precondition: particles are not empty and have mass.
Lattice lattice_around_matter(const ParticleSet& particles, const glm::dvec3& u,
                              const glm::dvec3& v, const glm::dvec3& w, double rest, int count,
                              int threads,
                              double most_work = std::numeric_limits<double>::infinity());

// Mean extinction (1/unit) of each cell, u fastest, then v, then w. Gaussians are cut at 4 s, what lies
// beyond is folded back; mass outside of the box is left out. The same bytes for every number of threads.
std::vector<float> extinction_in(const ParticleSet& particles, const Lattice& lattice, int threads);

// The same, each particle's extinction times channel 0, 1 or 2 of its colour. Precondition: it has colours.
std::vector<float> colored_extinction_in(const ParticleSet& particles, const Lattice& lattice,
                                         int channel, int threads);

// Cell updates that extinction_in does; about 1e9 a second and thread.
double lattice_work(const ParticleSet& particles, double cell, const glm::ivec3& cells);

}  // namespace awan
