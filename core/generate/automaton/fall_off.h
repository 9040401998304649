// How deep every cell lies in its ellipsoid, as bits: what document 001 keeps as three tables of probabilities. All
// three follow from the distance d from the centre, so that d alone is kept: 16 digits a cell, in words of 64 cells, as
// the comparison with random bits wants them (random_bits.h).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/automaton/grid.h"
#include "core/generate/automaton/random_bits.h"
#include "core/scene/automaton.h"

namespace awan {

struct FallOff {
    // A bit a cell: within an ellipsoid, not below the base.
    std::vector<std::uint64_t> inside;
    // Of word w of `inside`: kDistancePlanes words from w * kDistancePlanes, the digits of floor(d 2^16), highest
    // first. Only where word w is not 0.
    std::vector<std::uint64_t> distance;
    // Whether any cell of the row is.
    std::vector<std::uint8_t> row_inside;
};

// Over all rows; `into` may hold an older one.
Status make_fall_off(const AutomatonGrid& grid, const std::vector<AutomatonEllipsoid>& ellipsoids,
                     AutomatonOverlap overlap, double base, int threads, const Deadline& deadline,
                     FallOff& into);

}  // namespace awan
