// How a tile's pixels end: the light that the march found, and what stands behind the cloud. Bodies are inlined into
// one function a target in march_targets.cpp.
#pragma once

#include <cstring>

#include "core/draw/march_air.h"
#include "core/draw/march_rays.h"
#include "core/draw/march_scene.h"
#include "core/shaders/shared.h"

namespace awan {

// What stands behind a tile's pixels.
struct BehindTile {
    BehindPixels pixels;
    simd::Floats up;  // of the rays' directions, along the scene's y
};

// The zenith's share in the colour of the sky's gradient, 0..1.
AWAN_INLINE simd::Floats zenith_share(const simd::Floats& up) {
    float share[simd::kLanes];
    std::memcpy(share, &up, sizeof share);
    for (float& one : share)
        one = shader::sky_radiance(one, shader::vec3(1.0f), shader::vec3(0.0f)).x;
    simd::Floats zenith;
    std::memcpy(&zenith, share, sizeof zenith);
    return zenith;
}

// The share of light from around there that the peak has scattered, and that reaches the eye as if it had gone straight
// on:
//     exp(-k tau) - exp(-tau) = exp(-k tau) (1 - exp(-(1 - k) tau)),     k = `scaled` < 1,
// written so that nothing cancels.
AWAN_INLINE simd::Floats through_peak(float scaled, const simd::Floats& depth) {
    const simd::Floats rest = (1.0f - scaled) * depth;
    return simd::exp(-scaled * depth) * simd::one_minus(simd::exp(-rest), rest);
}

// One channel of the radiance behind. `zenith`: zenith_share, where there is no backdrop.
AWAN_INLINE simd::Floats radiance_behind(const SkyBehind& sky, const BehindTile& tile, int channel,
                                         const simd::Floats& zenith) {
    if (tile.pixels.backdrop != nullptr) return tile.pixels.backdrop[channel];
    return sky.horizon[channel] + (sky.zenith[channel] - sky.horizon[channel]) * zenith;
}

// How much of the difference between matter where the most of the peak's light comes through and thin matter is there
// at this depth of the cloud, 0..1.
AWAN_INLINE simd::Floats often_scattered(const MarchScene& scene, const simd::Floats& depth) {
    return simd::min((1.0f - scene.scaled) / scene.most_peak * depth, simd::all(1.0f));
}

// One channel of the light that the forward peak brings. through: the share of it that comes through.
AWAN_INLINE simd::Floats light_of_peak(const BehindTile& tile, const simd::Floats& through,
                                       const simd::Floats& often, int channel) {
    if (tile.pixels.once == nullptr) return simd::Floats{};
    const simd::Floats& once = tile.pixels.once[channel];
    return through * (once + often * (tile.pixels.often[channel] - once));
}

// From a channel a vector to a pixel a row: to[lane][channel].
AWAN_INLINE void to_pixels(const simd::Floats channels[4], float (*to)[4]) {
    float lanes[4][simd::kLanes];
    for (int channel = 0; channel < 4; ++channel)
        std::memcpy(lanes[channel], &channels[channel], sizeof lanes[channel]);
    for (int lane = 0; lane < simd::kLanes; ++lane)
        for (int channel = 0; channel < 4; ++channel) to[lane][channel] = lanes[channel][lane];
}

// With tau the cloud's depth along the ray, B what stands behind it and L what the cloud sends:
//     pixel = L + B exp(-tau) + B' through_peak,     alpha = 1 - exp(-tau), or 1 where B is drawn,
// B' the mean of what stands around there (behind_peak.h).
AWAN_INLINE void finish(const MarchScene& scene, const BehindTile& behind, const Tile& tile,
                        float (*to)[4]) {
    const SkyBehind& sky = scene.sky;
    const simd::Floats clear = simd::exp(-tile.depth);
    simd::Floats passes{}, through{};
    if (sky.behind) passes = clear;
    if (sky.peak) through = through_peak(scene.scaled, tile.depth);
    const simd::Floats often = often_scattered(scene, tile.depth);
    simd::Floats zenith{};
    if (behind.pixels.backdrop == nullptr && sky.behind) zenith = zenith_share(behind.up);
    const simd::Floats radiance[3] = {tile.red, tile.green, tile.blue};
    simd::Floats channels[4];
    for (int c = 0; c < 3; ++c)
        channels[c] = radiance[c] + passes * radiance_behind(sky, behind, c, zenith) +
                      light_of_peak(behind, through, often, c);
    channels[3] = sky.behind ? simd::all(1.0f) : simd::one_minus(clear, tile.depth);
    to_pixels(channels, to);
}

// The same through haze (air.h), with O and L of the whole ray, and those that the march has seen: sums over its
// samples of alpha weight * O and * L. What the haze sends is
//     ambient A + sun p (A - shaded),     A = seen O + exp(-tau) O,     shaded = seen L + exp(-tau) L.
// The cloud's own radiance is dimmed already. Light that comes through the forward peak met the cloud before the haze
// dimmed it: it is dimmed as the cloud's own light is in the mean, by 1 - seen O / (1 - exp(-tau)).
AWAN_INLINE void finish_in_air(const MarchScene& scene, const AirTile& air, const Chords& chords,
                               const BehindTile& behind, const Tile& tile, float (*to)[4]) {
    const SkyBehind& sky = scene.sky;
    const simd::Floats clear = simd::exp(-tile.depth);
    const simd::Floats opaque = simd::one_minus(clear, tile.depth);
    // The haze's depth along the whole ray; infinite along a level one.
    const simd::Floats slope = simd::max(simd::abs(behind.up), simd::all(1e-30f));
    const simd::Floats whole = (behind.up < 0.0f ? simd::all(air.down) : simd::all(air.up)) / slope;
    simd::Floats whole_clear = simd::exp(-whole);
    simd::Floats whole_air = simd::one_minus(whole_clear, simd::min(whole, simd::all(86.0f)));
    simd::Floats lost = air.lost, passes{}, through{};
    if (sky.behind) passes = clear * whole_clear;
    if (behind.pixels.opacity != nullptr) {
        // Hills end it.
        whole_air = *behind.pixels.opacity;
        whole_clear = 1.0f - whole_air;
        lost = *behind.pixels.lost;
        if (sky.behind) passes = clear;
    }
    if (sky.peak) {
        const simd::Floats dimmed =
            1.0f - simd::min(tile.seen_air / simd::max(opaque, simd::all(1e-30f)), simd::all(1.0f));
        through = through_peak(scene.scaled, tile.depth) * dimmed;
    }
    if (scene.alone) whole_air = lost = simd::Floats{};
    const simd::Floats haze = tile.seen_air + clear * whole_air;
    const simd::Floats lit = rest_of_phase(scene.air->phase, chords) *
                             simd::max(haze - tile.seen_lost - clear * lost, simd::Floats{});
    const simd::Floats often = often_scattered(scene, tile.depth);
    simd::Floats zenith{};
    if (behind.pixels.backdrop == nullptr && sky.behind) zenith = zenith_share(behind.up);
    const simd::Floats radiance[3] = {tile.red, tile.green, tile.blue};
    simd::Floats channels[4];
    for (int c = 0; c < 3; ++c)
        channels[c] = radiance[c] + haze * air.ambient[c] + lit * air.sun[c] +
                      passes * radiance_behind(sky, behind, c, zenith) +
                      light_of_peak(behind, through, often, c);
    channels[3] = simd::all(1.0f);
    if (scene.alone)
        channels[3] = opaque;
    else if (!sky.behind)
        channels[3] -= clear * whole_clear;
    to_pixels(channels, to);
}

}  // namespace awan
