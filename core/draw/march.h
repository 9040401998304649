// Pass 2 of the transport rungs: every pixel's ray is marched through the particles, with their exact optical depth,
// the light of the grid, and the sun's beam. No GL.
#pragma once

#include <vector>

#include "core/base/image.h"
#include "core/light/transport.h"
#include "core/plan/effect_times.h"
#include "core/plan/eye_effects.h"

namespace awan {

struct BehindPeak;    // behind_peak.h
struct SeenParticle;  // march_bins.h

// How finely a picture is marched: its longest step and the widest gap between rays along which light is looked up,
// scene units; outside of islands first, then in each lit one. EMPTY: not settled.
struct MarchFineness {
    double step, apart;
};
using MarchFinenesses = std::vector<MarchFineness>;

struct MarchSettings {
    // About how much the steps may cost, as a share of a pixel's radiance.
    double step_error = 0.01;
    EyeEffects eye_effects{};
    // One ray a pixel, even where the picture is uneven: edges are jagged.
    bool one_ray = false;
    // Above 0: of the blocks of pixels that may see matter only so many are marched, spread evenly over them; all other
    // pixels stay empty. Which ones depends on the particles, the view and the picture's size alone.
    int sampled_blocks = 0;
    // What see_particles (march_bins.h) finds in this picture, for several of one view; null: it is found out.
    const std::vector<SeenParticle>* seen = nullptr;
    // What behind_through_peak (behind_peak.h) finds there; null: it is found out.
    const BehindPeak* through_peak = nullptr;
    // Instead of what the light's own grid asks for; EMPTY: that. Of pictures of different lights that are compared:
    // other steps meet other places in lumps, by which pictures differ more than by their lights.
    MarchFinenesses fineness{};
};

// The sun's light and the sky's, each as the matter scatters it exactly once (core/light/once_scattered.h).
struct LightsOnce {
    TransportLight sun, sky;
};

// What is found beside a picture, along its very rays. Over nothing: alpha = 1 - transmittance.
struct MarchedBeside {
    // What comes of LightsOnce, dimmed by clouds and haze. EMPTY where these were not given.
    Image sun, sky;
    // All light of the clouds alone, dimmed by haze. EMPTY without haze, and where LightsOnce were not given.
    Image all;
    // Red: the mean distance at which the clouds stop the ray's light, scene units, times alpha; haze does not count.
    Image distance;
    // What stands behind the clouds, dimmed by haze alone; black where the picture is over nothing.
    Image behind;
};

// The same picture for every number of threads. times: what it took is added to them; may be null.
// beside: filled, unless it is null; its light where `lights` is given. The picture stays the same.
// Errors: kOverDeadline, kCancelled.
Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times = nullptr,
                    MarchedBeside* beside = nullptr, const LightsOnce* lights = nullptr);

}  // namespace awan
