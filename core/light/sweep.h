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
    std::vector<float>
        depth;  // of each cell: scaled extinction x side, 0..kMaxCellDepth; x fastest

    std::size_t size() const { return depth.size(); }
};

// A thicker cell reflects as much and lets nothing more through that could be seen; without this bound float32 would lose
// the small difference between what enters and what is scattered, and the solve its convergence.
inline constexpr float kMaxCellDepth = 30;

// Radiance that enters the grid, travelling along `direction` (unit).
using Inflow = std::function<double(const glm::dvec3& direction)>;

// Radiance that enters along an upward direction (unit) at a place of the grid's faces (cells from its corner). Beside
// Inflow, which it adds to: light from a ground, which is not the same everywhere.
using InflowFromBelow = std::function<double(const glm::dvec3& direction, const glm::dvec3& place)>;

// Memory that sweeps of one grid reuse.
struct SweepSpace {
    std::array<std::vector<float>, 4> sums, rows, layers;
};

// Solves direction . grad psi + sigma psi = source for given sources, and gives the moments of psi.
// source, moments: harmonics floats a cell, times the cell's side (dimensionless source: emission per unit length x side).
// inflow: empty for vacuum. Linear weighted diamond differences, theta = (3 + tau) / (6 + tau), tau the depth of the
// cell along the direction (positive where diamond is not, second order where cells are thin).
// Four octants' sums are kept apart and added in a fixed order: the same bytes for every number of threads.
void sweep(const SweepGrid& grid, const Ordinates& ordinates, std::span<const float> source,
           const Inflow& inflow, int threads, SweepSpace& space, std::span<float> moments,
           const InflowFromBelow& from_below = {});

}  // namespace awan
