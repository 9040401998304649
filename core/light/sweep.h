// One walk of the light through all cells in all directions: the operator of the transport solve.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/base/aligned_floats.h"
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
    std::size_t layer_size() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y);
    }
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

// What cells send out: of each the moments of its emission times the cell's shortest side,
//     weight[i] * scale[cell] * moments[cell][i],     and `even[cell]` more to the first.
struct SweepSource {
    std::span<const float> moments;  // `harmonics` floats a cell
    std::span<const float> scale{};  // of each cell; EMPTY: 1
    std::span<const float> even{};   // of each cell; EMPTY: 0
    std::array<float, kHarmonics> weight = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
};

// Where the moments of the radiance go, integral of psi Y_i: `harmonics` floats a cell.
struct SweepResult {
    std::span<float> to;
    // Not EMPTY: from these they are taken away, of which each cell's first is more by `addition` (EMPTY: 0).
    std::span<const float> from{}, addition{};
};

// Memory that sweeps of one grid reuse.
struct SweepSpace {
    // Of the octants of one sign along z; floats of a layer's cells, but for `row`, of a row's: 64 each.
    struct Side {
        AlignedFloats radiance, factors, layer, row;
    };
    std::array<Side, 2> sides;
};

// For given sources q solves
//     o . grad psi + sigma psi = q
// for the radiance psi in each of the directions o, and gives its moments. inflow: what enters; empty: nothing does.
// Between the faces of a cell psi changes by weighted diamond differences with the weight theta = (3 + tau) / (6 +
// tau), tau the depth of the cell along the direction. That is second order in thin cells, as the diamond scheme (theta
// = 1/2) is, but stays positive in thick ones, where that does not. It is linear, which GMRES needs. The same bytes for
// every number of threads: what each adds to a cell does not depend on which does it, and the sums of the two signs
// along z are added last. Most threads that have work: 8 where the light goes through a layer, else one a few hundred
// cells of it.
void sweep(const SweepGrid& grid, const Ordinates& ordinates, const SweepSource& source,
           const Inflow& inflow, int threads, SweepSpace& space, const SweepResult& result,
           const InflowFromBelow& from_below = {});

}  // namespace awan
