// Mean extinction in the cells of any box, turned as one likes: what the transport solve and the
// sun's depth are made from.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/generate/particle_set.h"

namespace awan {

// The shortest side of a cell. Where cells are not cubes, an optical depth "of a cell's side" is that of this side.
inline double shortest(const glm::dvec3& cell) {
    return std::min({cell.x, cell.y, cell.z});
}
inline double longest(const glm::dvec3& cell) {
    return std::max({cell.x, cell.y, cell.z});
}

// Cells along three orthonormal axes. Corner of cell (i, j, k): origin + i cell.x u + j cell.y v + k cell.z w.
struct Lattice {
    glm::dvec3 origin{0};  // scene units
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
    glm::dvec3 cell{0};  // sides, scene units
    glm::ivec3 cells{0};

    std::size_t size() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
    // Scene position of lattice coordinates (cells from the corner).
    glm::dvec3 at(const glm::dvec3& c) const {
        return origin + (cell.x * c.x) * u + (cell.y * c.y) * v + (cell.z * c.z) * w;
    }
};

// Where matter is, along three orthonormal axes.
struct MatterBox {
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
    glm::dvec3 corner{0}, size{0};  // scene units
    // The length over which extinction changes along each axis, scene units: the sum of extinction over that of the
    // magnitude of its derivative. A Gaussian has 1.25 s; what is even along an axis, half its width.
    glm::dvec3 length{0};
};

// The smallest box along the axes outside of which no line has more optical depth than `rest` (dimensionless), found on
// a coarse volume. Precondition: particles are not empty and have mass.
MatterBox box_around_matter(const ParticleSet& particles, const glm::dvec3& u, const glm::dvec3& v,
                            const glm::dvec3& w, double rest, int threads);

// The box divided into cubic cells, `count` of them along its longest side.
Lattice cubic_cells(const MatterBox& box, int count);

// The box divided into about as many cells as cubic_cells would make, but as flat as the matter is: each of their sides
// is in proportion to the length over which extinction changes along it. Cubic where those lengths are within a factor
// of 3/2.
Lattice fitted_cells(const MatterBox& box, int count);

// Cells along the longest side for as many cubic ones as `count` along it fill a compact box with: its sides as 1 to
// 1/2 to 1/2. A box that is flatter than that, or longer, gets finer ones, up to `most` times `count`: else the cells
// of wide, thin clouds would be few, and large beside what they are to show.
int spread_count(const glm::dvec3& size, int count, double most);

// Divides the box by one of these into `count` cells, or, where extinction_in would need more than `most_work` updates
// (lattice_work), into as few as 8.
using Division = Lattice (*)(const MatterBox& box, int count);
Lattice within_work(const ParticleSet& particles, const MatterBox& box, int count, double most_work,
                    Division division);

// The box around the matter in cubic cells, `count` of them along its longest side, or, where extinction_in would need
// more than `most_work` updates (lattice_work), as few as 8.
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
double lattice_work(const ParticleSet& particles, const glm::dvec3& cell, const glm::ivec3& cells);

}  // namespace awan
