// The ellipsoids of an automaton (core/scene/automaton.h): those of the beginning, and how wind moves them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/automaton.h"

namespace awan {

// The listed ones, then the random ones: in the grid as far as their radii allow, those that are too wide are narrowed
// to it.
std::vector<AutomatonEllipsoid> first_ellipsoids(const AutomatonCloud& cloud, std::uint64_t key);

// Moves them as in step `step` (0, 1, ...) by the cloud's wind bands; one that has left the grid in x comes back at the
// upwind side, touching it from within. True when any moved. `first`: those of the beginning.
bool move_ellipsoids(const AutomatonCloud& cloud, const std::vector<AutomatonEllipsoid>& first,
                     std::uint64_t key, std::uint64_t step,
                     std::vector<AutomatonEllipsoid>& ellipsoids);

}  // namespace awan
