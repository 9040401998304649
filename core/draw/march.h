// Pass 2 of the transport rungs: exact optical depth along every pixel's ray, light from the grid. No GL.
#pragma once

#include "core/base/image.h"
#include "core/light/transport.h"
#include "core/plan/effect_times.h"
#include "core/plan/eye_effects.h"

namespace awan {

struct MarchSettings {
    double step_error = 0.01;  // about the share of a pixel's radiance that the steps may cost
    EyeEffects eye_effects;
};

// Threads do not show in the result. times: what it took is added to them; may be null. Errors: kOverDeadline, kCancelled.
Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
