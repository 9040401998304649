// One walk of the light through all cells in all directions: the operator of the transport solve.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/light/ordinates.h"

namespace awan {

// What does not change from sweep to sweep.
struct SweepGrid {
    glm::ivec3 cells{0};
    int harmonics = 16;  // 1 (l = 0) or 16 (l <= 3): floats a cell in moments and sources
    // Sides of a cell, in units of the shortest.
    glm::vec3 sides{1};
    // Of each cell: scaled extinction (core/light/delta_m.h) x shortest side, 0..kMaxCellDepth; x fastest.
    std::vector<float> depth;
    // Whether cells without depth get no moments (0), which saves most of the time there. They must have no source.
    bool skip_empty = false;

    std::size_t size() const { return depth.size(); }
};

// A cell that is thicker than this looks the same: it reflects no more, and nothing that could be seen comes through
// either. Without the bound float32 would lose the small difference between what enters a cell and what it scatters,
// and the solve would no longer converge.
inline constexpr float kMaxCellDepth = 30;

// Radiance that enters the grid, travelling along `direction` (unit).
using Inflow = std::function<double(const glm::dvec3& direction)>;

// Radiance that enters along an upward direction (unit) at a place of the grid's faces (cells from its corner): light
// from a ground, which is not the same everywhere. It is added to Inflow.
using InflowFromBelow = std::function<double(const glm::dvec3& direction, const glm::dvec3& place)>;

// Memory that sweeps of one grid reuse.
struct SweepSpace {
    std::array<std::vector<float>, 4> sums, rows, layers;
};

// For given sources q solves
//     o . grad psi + sigma psi = q
// for the radiance psi in each of the directions o, and gives its moments: integral of psi Y_i. source: moments of q
// times the cell's shortest side, `harmonics` floats a cell; moments: as many. inflow: what enters; empty: nothing
// does. Between the faces of a cell psi changes by weighted diamond differences with the weight theta = (3 + tau) / (6
// + tau), tau the depth of the cell along the direction. That is second order in thin cells, as the diamond scheme
// (theta = 1/2) is, but stays positive in thick ones, where that does not. It is linear, which GMRES needs. The sums of
// four groups of octants are kept apart and added in a fixed order: the same bytes for every number of threads.
void sweep(const SweepGrid& grid, const Ordinates& ordinates, std::span<const float> source,
           const Inflow& inflow, int threads, SweepSpace& space, std::span<float> moments,
           const InflowFromBelow& from_below = {});

}  // namespace awan
