// Light that the matter scatters exactly once, told apart from all the rest: for layers of pictures.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/light/transport_light.h"
#include "core/plan/transport_settings.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Of a solved light the sun's alone, as rung `single` has it: the sun's depth, and the colours of matter.
TransportLight sun_once(const TransportLight& light);

// The sky's: one walk through the grid of light that has met nothing yet, then scattered by the phase function's orders
// 0 to 3. One grid holds all, whatever islands the scene has. settings: those of the picture's light; without cells or
// sky the answer is dark. Errors: kOverDeadline, kCancelled.
Result<TransportLight> sky_once(const Scene& scene, const ParticleSet& particles,
                                const Survey& survey, TransportSettings settings, int threads,
                                const Deadline& deadline);

}  // namespace awan
