// The haze (air.h) in the march: looked up with the light, put over a tile's pixels at their end.
#pragma once

#include "core/draw/air.h"
#include "core/draw/march_rays.h"

namespace awan {

// Fills `air` and `lost` of points at distances first, first + step, ... from the eye, on the ray through pixel coordinates
// (x, y).
void air_along(const Air& air, double x, double y, double first, double step, int count,
               LightAt* out);

// Distance up to which rays `apart` (difference of directions) are near enough for linear interpolation of the haze between
// them: heights differ by no more than 0.3 scale heights, error < 0.5% of the transmittance.
double farthest_for_air(const Air& air, double apart);

// What of the haze is the same for a picture, in the march's floats.
struct AirTile {
    float up, down;  // Air's
    float sun[3], ambient[3];
    simd::Floats lost;  // of the whole rays
};
AirTile air_tile(const Air& air, double x, double y);  // pixel coordinates of the tile's corner

// What the march found in a tile: sums over samples of alpha weight * O and * L.
struct AirSeen {
    simd::Floats air, lost;
};

// As finish() of march_rays.h, through haze. `radiance` is dimmed already. Light that comes through the clouds' forward peak
// met the cloud undimmed: it is dimmed as the cloud's own light is in the mean.
AWAN_INLINE void finish_in_air(const SkyBehind& sky, const RestOfPhase& phase, const AirTile& tile,
                               const AirSeen& seen, const Chords& c, float scaled,
                               const simd::Floats& up, const simd::Floats& depth,
                               const simd::Floats radiance[3], float (*to)[4]) {
    const simd::Floats e = simd::exp(-depth), opaque = simd::one_minus(e, depth);
    const simd::Floats rise = simd::max(simd::abs(up), simd::all(1e-30f));
    const simd::Floats whole =
        (up < 0.0f ? simd::all(tile.down) : simd::all(tile.up)) / rise;  // may be infinite
    const simd::Floats whole_clear = simd::exp(-whole);
    const simd::Floats whole_air = simd::one_minus(whole_clear, simd::min(whole, simd::all(86.0f)));
    simd::Floats behind{};
    if (sky.behind) behind = e * whole_clear;
    if (sky.peak) {
        const simd::Floats rest = (1.0f - scaled) * depth;
        const simd::Floats clear =
            1.0f - simd::min(seen.air / simd::max(opaque, simd::all(1e-30f)), simd::all(1.0f));
        behind += simd::exp(-scaled * depth) * simd::one_minus(simd::exp(-rest), rest) * clear;
    }
    const simd::Floats air = seen.air + e * whole_air;
    const simd::Floats lit =
        rest_of_phase(phase, c) * simd::max(air - seen.lost - e * tile.lost, simd::Floats{});
    float share[simd::kLanes];  // of the zenith's colour
    std::memcpy(share, &up, sizeof share);
    for (float& one : share)
        one = shader::sky_radiance(one, shader::vec3(1.0f), shader::vec3(0.0f)).x;
    simd::Floats high;
    std::memcpy(&high, share, sizeof high);
    const simd::Floats alpha = 1.0f - e * whole_clear;
    for (int channel = 0; channel < 3; ++channel) {
        const simd::Floats sum =
            radiance[channel] + air * tile.ambient[channel] + lit * tile.sun[channel] +
            behind * (sky.horizon[channel] + (sky.zenith[channel] - sky.horizon[channel]) * high);
        for (int lane = 0; lane < simd::kLanes; ++lane) to[lane][channel] = sum[lane];
    }
    for (int lane = 0; lane < simd::kLanes; ++lane) to[lane][3] = sky.behind ? 1.0f : alpha[lane];
}

}  // namespace awan
