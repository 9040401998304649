// Where an automaton's cloud will lie, without growing it.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/models.h"

namespace awan::automaton {

// Seven Gaussians an ellipsoid, within the grid and not below the base; the ellipsoids as the wind has moved them after
// `steps` steps, or as they began where that is long to tell. Clouds outlast their ellipsoids by a few cells.
Result<ModelParticles> coarse_automaton(const AutomatonCloud& cloud, std::uint64_t key,
                                        std::uint64_t steps, const Deadline& deadline);

}  // namespace awan::automaton
