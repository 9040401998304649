#pragma once

#include <vector>

#include "core/plan/transport_settings.h"
#include "core/survey/survey.h"

namespace awan {

// Cells for each of the survey's islands: what `settings` mean for an island that fills the picture, and fewer for
// smaller ones, with the square root of their projected size, in steps of sqrt 2 (so that a camera that moves a little
// keeps its light); at least kLeastIslandCells. Islands out of the picture get none. Where the survey has further
// views, each island has what the one needs that shows it largest. EMPTY: one grid for all.
std::vector<IslandCells> island_cells(const TransportSettings& settings, const Survey& survey);

// Of the whole scene, beside its islands: coarse light for what is out of the picture, and for what islands see of
// each other. Its grid is the same on the way to all others, so that it is solved once.
TransportSettings whole_settings(const TransportSettings& settings);

// The same, of a grid with `cells` on the way to that of `settings`.
TransportSettings settings_on_the_way(const TransportSettings& settings, int cells,
                                      const Survey& survey);

inline constexpr int kWholeCells = 24;
inline constexpr int kWholeSunCells = 192;  // at most
inline constexpr int kLeastIslandCells = 8, kLeastIslandSunCells = 24;

}  // namespace awan
