// The truth to measure against: a path tracer, unbiased but for the errors stated here. Slow, and shares no lighting or
// sampling code with core/light and core/draw.
//
// Free flights, phase functions, sky and ground are sampled exactly, and the optical depth to the sun is the integral
// of the very extinction that flights meet. Errors that more samples do not take away: that extinction has the
// particles' mass and widths, but ripples about their sum by 1 / (4 s^2) of a particle's own, s in cells
// (truth/matter.h); and paths end after kMaxOrders scatterings, which matters for albedo > .9999 in optical depths (1 -
// g) tau > 300 only: they then lose what so long a path would still have brought, below 2% of a pixel.
//
// The ground (Scene's `ground`) is an infinite Lambertian plane, seen and felt from above only: from below it is not
// there. Its light from the sun comes from all of the sun's disc (angular radius .2665 degrees, even): shadows have a
// penumbra. Everywhere else the sun is a point.
#pragma once

#include <cstdint>

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/base/progress.h"
#include "core/generate/particle_set.h"
#include "core/plan/eye_effects.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

enum class SkySampling {
    // Paths that leave the cloud bring the sky's radiance from where they go.
    kEscape,
    // The sky is looked for at every scattering, escaping paths bring nothing.
    kNextEvent,
};

// Scatterings a path may ever have.
inline constexpr std::uint32_t kMaxOrders = 100'000;

struct TruthOptions {
    // Paths a pixel, both halves together; even, >= 2.
    std::uint32_t samples = 64;
    // Scatterings a path may have; 0 = no end but the albedo's and the limit kMaxOrders.
    std::uint32_t max_orders = 0;
    SkySampling sky = SkySampling::kEscape;
    EyeEffects eye_effects{};
    // Pixels show the mean over their area, as all pictures do; else what the ray through their middle does, for which
    // there are closed forms.
    bool whole_pixels = false;
    std::uint64_t seed = 1;
    int threads = 1;
};

// Two independent pictures of half the samples each: their difference is the noise, and (x - a)(x -
// b) is an estimate of the squared error of x that noise does not inflate.
struct TruthImage {
    Image half_a, half_b;
    // A path that met the cloud has so many, on average.
    double scatterings = 0;

    // What is known of the noise of mean_of(this): its root mean square over the cloud's pixels (alpha at least 5% of
    // the largest), relative to their mean radiance, from the halves' difference. Unbiased in its square.
    double noise() const;
};

// Linear radiance as core/draw gives it: premultiplied, alpha = 1 - transmittance of clouds and haze (exact on
// every ray, by line_optical_depth), over the sky and the ground or over nothing as the scene's background says.
// A picture depends on scene, samples and seed, not on threads. Errors: kOverDeadline, kCancelled.
Result<TruthImage> trace_truth(const Scene& scene, const ParticleSet& particles, const View& view,
                               const TruthOptions& options, const Progress& progress,
                               const Deadline& deadline);

// (a + b) / 2: what is shown.
Image mean_of(const TruthImage& truth);

}  // namespace awan
