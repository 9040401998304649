// Light of several grids of one cloud, from coarse to fine.
//
// On smooth matter the error of a grid is smooth, and falls with the size of its cells to a power between 1 and 2
// (core/README.md, "How far grids are off"). So the solution of a coarser grid is a good first guess for a finer one,
// what two grids differ by shows where both go, and the difference of two such forecasts says how far off they are.
#pragma once

#include <vector>

#include "core/light/transport_light.h"

namespace awan {

// The moments of one band of `from` at the centres of the cells of `to`, trilinear; those of the nearest cell outside.
// Both have grids; `band` is one of from's.
std::vector<std::array<float, kHarmonics>> moments_between(const TransportLight& from,
                                                           std::size_t band,
                                                           const TransportLight& to, int threads);

// Adds to the bands of `fine`, which was just solved, what they would gain with ever smaller cells, by how they differ
// from those of `coarse` as solved: L. F. Richardson's extrapolation (1911), for an error that falls with the square of
// a cell's side. A cell's moments change by at most half of its mean radiance. The bands as solved go to fine.solved.
// Where both have the same grid, fine takes the bands of coarse; where they have other bands, nothing changes.
void extrapolate(const TransportLight& coarse, TransportLight& fine, int threads);

}  // namespace awan
