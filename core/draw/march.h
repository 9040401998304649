// Pass 2 of the transport rungs: exact optical depth along every pixel's ray, light from the grid. No GL.
#pragma once

#include "core/draw/image.h"
#include "core/light/transport.h"
#include "core/plan/effect_times.h"

namespace awan {

struct MarchSettings {
    double step_error = 0.01;  // about the share of a pixel's radiance that the steps may cost
    bool aerial_perspective = true;  // the scene's haze, if it has any
    bool light_shafts = true;        // and the clouds' shadows in it
};

// Threads do not show in the result. times: what it took is added to them; may be null. Errors: kOverDeadline, kCancelled.
Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
