// How deep every cell lies in its ellipsoid, as bits. Upchurch 2009 keeps three tables of probabilities. All three
// follow from 1 - F(d), where d is the distance from the centre and F falls off with it (shape.h); of the linear F that
// is d. It alone is kept: 16 binary digits a cell, in words of 64 cells, as the comparison with random bits wants them
// (random_bits.h).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/automaton/grid.h"
#include "core/generate/automaton/random_bits.h"
#include "core/scene/automaton.h"

namespace awan::automaton {

// How deep every cell lies in its ellipsoid.
struct FallOff {
    // A bit a cell: whether it lies within an ellipsoid and not below the base.
    std::vector<std::uint64_t> inside;
    // The digits of floor((1 - F(d)) 2^16), highest first: word w of `inside` has kDistancePlanes words here, from w *
    // kDistancePlanes on. Set only where word w is not 0.
    std::vector<std::uint64_t> distance;
    // Of each row: whether any of its cells is inside.
    std::vector<std::uint8_t> row_inside;
    // fall_off_digits() of the cloud, which whoever fills the rest has set. EMPTY: F is linear.
    std::vector<std::uint16_t> shape{};
};

// Fills `into` for all rows; it may hold an older one, whose memory is used again.
Status make_fall_off(const AutomatonGrid& grid, const std::vector<AutomatonEllipsoid>& ellipsoids,
                     AutomatonOverlap overlap, double base, int threads, const Deadline& deadline,
                     FallOff& into);

}  // namespace awan::automaton
