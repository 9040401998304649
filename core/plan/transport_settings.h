#pragma once

#include <vector>

#include "core/scene/rungs.h"

namespace awan {

// Of one island (core/survey/islands.h).
struct IslandCells {
    // As TransportSettings::cells; 0: no grid.
    int cells = 0;
    // 0: it is not seen and has no light of its own.
    int sun_cells = 0;
};

// How finely the transport rungs (core/light/transport.h) solve.
struct TransportSettings {
    // Along the longest side of the matter; 0: no grid, the sun's depth only.
    int cells = 32;
    // Of SunDepth, along its longest side.
    int sun_cells = 96;
    // Of the solve, relative to its source.
    double tolerance = 1e-3;
    // Of a band; each is one walk through all cells and directions.
    int max_sweeps = 40;
    // Whether the sky's light is wanted.
    bool sky = true;
    // Whether the ground's light goes into the cloud.
    bool ground = false;
    // Whether the cloud shades the ground and sends it light of its own.
    bool ground_shadow = false;
    // The sky's light alone, and of that only what the matter scatters exactly once.
    bool sky_once = false;
    // Whether no finer grid goes on from this one.
    bool last = false;
    // One for each of Survey::islands; EMPTY: one grid holds all.
    std::vector<IslandCells> islands;
};

// How many times finer than the rung's name says, at most, the lattices of clouds that are flat or long are
// (spread_count of core/survey/lattice.h): the solve's grid and that of the sun's depth, which costs little and decides
// how sharp the edges are that the sun shines through.
inline constexpr double kMostGridSpread = 1.5, kMostSunSpread = 4;

// Cells along the longest side of the grids on the way to one with `cells`, coarsest first, `cells` itself last; from
// one to the next they grow by 1.25 to 2 times. cells >= 1.
std::vector<int> nested_cells(int cells);

// Nodes along the longest side of the sun's depth, for a grid with so many cells.
int sun_cells_for(int cells);

// The most fine cells on which the sun's light is solved once more where there is detail (core/light/fine_band.h):
// about 1 GB while it is solved, and 60 MB to keep.
inline constexpr int kMostFineCells = 900'000;

// Fine cells along the side of one of a grid's, where nothing asks for fewer.
inline int fine_cells_a_side(int cells) {
    return cells <= 32 ? 3 : 2;
}

// Of a rung of Method::kMarch.
TransportSettings transport_settings(const Rung& rung);

}  // namespace awan
