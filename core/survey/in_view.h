#pragma once

#include <cstddef>

#include "core/generate/particle_set.h"
#include "core/survey/survey.h"

namespace awan {

// How many particles of a set the picture shows some of: those whose ball of 4 s around the centre reaches into the
// pyramid of the view.
std::size_t particles_in_view(const ParticleSet& particles, const View& view);

}  // namespace awan
