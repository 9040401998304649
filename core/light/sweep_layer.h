// One layer of cells of a sweep, and the light of the four octants that cross it one way along z: the inner loops.
//
// A layer is taken in three steps. `expand_cells` turns each cell's moments into the source of every direction. What a
// harmonic is towards an octant is what it is towards the first, but for its sign; so sixteen products give the sources
// of four octants: the sums of harmonics that are even or odd in x, and in y, are added with the four combinations of
// signs (a Walsh-Hadamard transform). `walk_layer` takes the light through the cells; four octants go side by side,
// since each waits for the cell before it. `gather_cells` turns radiance into moments, by the same sums backwards. None
// of it depends on how cells and octants are split over threads.
#pragma once

#include <array>

#include "core/light/sweep.h"

namespace awan {

// The octants of one sign along z. An octant's index in it: 1 for light that goes down along x, plus 2 along y.
inline constexpr std::size_t kSide = 4;

// What enters through the faces of the grid, of one octant.
struct OctantInflow {
    alignas(64) std::array<float, kDirections> in{};
    // Instead of `in`: what enters each cell of the three faces that face the light, 16 floats each. EMPTY: `in`
    // everywhere. Across x: y fastest, then z; across y: x, then z; across z: x, then y.
    std::vector<float> x, y, z;
};

struct SideSweep {
    const SweepGrid& grid;
    const SweepSource& source;
    bool down_z = false;  // the light goes down along z
    // |cosines| of the 16 directions to the axes over the cell's sides; [harmonic][direction] of the first octant of
    // the side, times the source's weight; [harmonic][direction] times the direction's weight.
    alignas(64) std::array<std::array<float, kDirections>, 3> cosine{};
    alignas(64) std::array<std::array<float, kDirections>, kHarmonics> value{}, weighted{};
    alignas(64) std::array<
        float, kDirections> first{};  // of the first harmonic, without the source's weight
    std::array<OctantInflow, kSide> inflow{};
    SweepSpace::Side& space;
};

// Sources of the cells begin..end-1 of layer k, and what crossing them takes from the light.
void expand_cells(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end);

// The light of `count` octants from `octant` on, 1, 2 or 4, through all cells of layer k, after those before it.
void walk_layer(const SideSweep& side, std::size_t k, std::size_t octant, std::size_t count);

// Moments of the cells begin..end-1 of layer k. `result`: as of the sweep. second: to those that the other side left
// there.
void gather_cells(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end,
                  bool second, const SweepResult& result);

}  // namespace awan
