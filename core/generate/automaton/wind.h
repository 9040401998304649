// Where the wind over an automaton blows to at a height, and how it moves the layers of cells
// (core/scene/automaton_wind.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/generate/automaton/grid.h"
#include "core/scene/automaton_wind.h"

namespace awan::automaton {

// Cells a step along x and z, at height y (cells).
glm::dvec2 wind_on_layers(const AutomatonWind& wind, double y);
glm::dvec2 wind_on_ellipsoids(const AutomatonWind& wind, double y);

// Moves the bits of all layers as in step `step`, by whole cells; what is left over is saved up for later steps. Along
// x the bits of a row move, along z whole rows, so neither looks at single cells. row_lives: of each row, whether it
// may have any bit set; moved with them.
void shift_layers(const AutomatonWind& wind, std::uint64_t step, const AutomatonGrid& grid,
                  const std::array<std::vector<std::uint64_t>*, 3>& fields,
                  std::vector<std::uint8_t>& row_lives);

}  // namespace awan::automaton
