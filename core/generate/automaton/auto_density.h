// The density of an automaton that is given none.
#pragma once

#include <cstdint>

#include "core/scene/automaton.h"

namespace awan::automaton {

// What makes the clouds of its ellipsoids `depth` deep in the mean, along vertical lines, within a factor of two: the
// extinction of a cell full of cloud, 1/unit. By its description alone, so that it is the same at every step. 0: no cloud
// grows in any of them.
//
// In the long run as many cells of an ellipsoid become clouds as vanish. Vapour comes with probability p F(d) a step and
// soon condenses, clouds vanish with e (1 - F(d)): so p F / (p F + e (1 - F)) of the cells at distance d are clouds.
double density_for_depth(const AutomatonCloud& cloud, std::uint64_t key, double depth);

}  // namespace awan::automaton
