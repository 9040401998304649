// Cubes filled in the shapes of clouds. Every centre lies in the cube, every radius in (0, cube.radius]; a particle
// does not depend on the others.
#pragma once

#include <array>
#include <cstdint>

#include "core/generate/cubes.h"

namespace awan {

// A cumulus: domes on a common flat base. One flat dome is as wide as the cube, the others, about as wide as they are
// high and the more the wider the cube, stand on it, the highest near the middle. Matter is even within each, so it is
// densest where they overlap. Particles stand above the base by half their radius: their lower sides are level.
void fill_cumulus(const Cube& cube, std::uint64_t key, std::uint64_t first, std::uint64_t last,
                  FilledParticle* out);

// A layer with round corners that thins out towards its rim. u: uniform in (0, 1), place and radius.
FilledParticle stratus_particle(const Cube& cube, const std::array<double, 4>& u);

}  // namespace awan
