// The ellipsoids of an automaton (core/scene/automaton.h): those of the beginning, and how wind moves them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/automaton.h"

namespace awan::automaton {

// The listed ellipsoids, then the random ones. As far as their radii allow they lie within the grid; those too wide
// for it are narrowed to it.
std::vector<AutomatonEllipsoid> first_ellipsoids(const AutomatonCloud& cloud, std::uint64_t key);

// Moves them as in step `step` (0, 1, ...) by the cloud's wind bands. One that has left the grid comes back at the
// opposite side, touching it from within, with other radii: as many come in by each side as an even wind would bring.
// True when any moved. first: those of the beginning.
bool move_ellipsoids(const AutomatonCloud& cloud, const std::vector<AutomatonEllipsoid>& first,
                     std::uint64_t key, std::uint64_t step,
                     std::vector<AutomatonEllipsoid>& ellipsoids);

}  // namespace awan::automaton
