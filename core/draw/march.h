// Pass 2 of the transport rungs: every pixel's ray is marched through the particles, with their exact optical depth,
// the light of the grid, and the sun's beam. No GL.
#pragma once

#include "core/base/image.h"
#include "core/light/transport.h"
#include "core/plan/effect_times.h"
#include "core/plan/eye_effects.h"

namespace awan {

struct MarchSettings {
    // About how much the steps may cost, as a share of a pixel's radiance.
    double step_error = 0.01;
    EyeEffects eye_effects{};
};

// The same picture for every number of threads. times: what it took is added to them; may be null.
// Errors: kOverDeadline, kCancelled.
Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
