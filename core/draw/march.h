// Pass 2 of the transport rungs: every pixel's ray is marched through the particles, with their exact optical depth,
// the light of the grid, and the sun's beam. No GL.
#pragma once

#include "core/draw/image.h"
#include "core/light/transport.h"
#include "core/plan/effect_times.h"

namespace awan {

struct MarchSettings {
    // About how much the steps may cost, as a share of a pixel's radiance.
    double step_error = 0.01;
    bool aerial_perspective = true;  // whether the scene's haze, if it has any, is drawn
    bool light_shafts = true;        // and whether the clouds' shadows are in it
};

// The same picture for every number of threads. times: what it took is added to them; may be null.
// Errors: kOverDeadline, kCancelled.
Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
