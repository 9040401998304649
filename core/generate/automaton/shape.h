// The functions by which an automaton's probabilities and weights fall off (core/scene/automaton_shape.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/automaton.h"

namespace awan::automaton {

// F(u), u from 0 to 1. table: of kTable, two values at least.
double fall_off_at(AutomatonShape shape, const std::vector<float>& table, double u);

// What stands for each distance in the tables of probabilities: element floor(d 2^16) is floor((1 - F(d)) 2^16), at
// most 2^16 - 1. EMPTY: the distance itself, of kLinear.
std::vector<std::uint16_t> fall_off_digits(const AutomatonCloud& cloud);

// By how much cells count in smoothing that lie 0, 1, 2, ... cells away along x, y and z; each as long as smooth
// reaches. EMPTY, all three: all count alike.
std::array<std::vector<float>, 3> smooth_weights(const AutomatonCloud& cloud);

}  // namespace awan::automaton
