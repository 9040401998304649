// The light that a ray collects, sample by sample. Bodies are inlined into one function a target in march_targets.cpp.
//
// With sigma the extinction along the ray, tau its optical depth from the eye, t_s the optical depth from the sun, a
// the albedo, f the share of the forward peak and k = 1 - a f (core/light/delta_m.h), the eye gets
//     integral of sigma ( S exp(-k tau)                                  light of the grid
//                       + a E p1 exp(-k (t_s + tau))                     the sun's, scattered once, outside the peak
//                       + a E (F2(t_s) exp(-tau) + F2(tau) exp(-t_s)) / 2   and any number of times within the peak
//                       ) dt,
// S the source function of the grid, E the sun's irradiance, p1 and F2 as in march_phase.h.
#pragma once

#include "core/draw/march_simd.h"
#include "core/draw/march_tile.h"

namespace awan {

using simd::Bits;
using simd::Floats;
using simd::Ints;

constexpr float kUnseen = 1e-4f;    // scaled transmittance below which a ray has ended
constexpr float kMostDepth = 1e5f;  // of one sample; more looks the same
constexpr float kDeepStep = 8.0f;   // scaled depth of a step that hides its own middle

// What samples are shaded by, the same for all of a tile's.
struct Shade {
    float scaled;  // k
    // (before^2 / step^2 - 1) / 24 where a chunk begins whose step is not that of the samples before it, else 0.
    float seam;
    bool grid;           // whether there is light of a grid
    bool peak;           // whether there is a forward peak
    bool albedo;         // whether cells have their own albedo
    float beam[3];       // a E; E alone where cells have their own albedo
    const Floats* rows;  // of the peak table: a column each, a pixel a lane
    float last;          // of the peak table: its largest depth
};

// G of the peak table (march_phase.h) at optical depth t, linear between columns. Columns are even in the bits of the
// float 1 + t: 8 an octave. A tile's pixels mostly lie in one or two columns, so the pieces between the lowest and the
// highest are climbed for all pixels together, and nothing is gathered.
AWAN_INLINE Floats peak_value(const Floats* rows, float last, const Floats& t) {
    const auto column = [](float y) {
        std::uint32_t b;
        std::memcpy(&b, &y, sizeof b);
        return static_cast<int>((b - 0x3f800000u) >> 20);
    };
    const Floats y = 1.0f + simd::min(t, simd::all(last * 0.9999f));
    const Bits b = simd::bits(y) - 0x3f800000u;
    const Floats at =
        __builtin_convertvector(reinterpret_cast<const Ints&>(b), Floats) * (1.0f / 1048576);
    const int low = column(simd::smallest(y)), high = column(simd::largest(y));
    Floats value = rows[low];
    for (int k = low; k <= high; ++k)
        value += (rows[k + 1] - rows[k]) *
                 simd::min(simd::max(at - static_cast<float>(k), Floats{}), simd::all(1.0f));
    return value;
}

//     exp(-x / 2) sinh(z) / z,     half = exp(-x / 2), z2 = z^2 (where it is negative: sin(|z|) / |z|),
// by the series of sinh and no more than 1. For z = x / 2 it is the mean of exp(-x u) over u = 0..1.
AWAN_INLINE Floats mean_decay(const Floats& half, const Floats& z2) {
    const Floats zz = simd::max(simd::min(z2, simd::all(16.0f)), simd::all(-4.0f));
    return simd::min(
        half * (1.0f + zz * ((1.0f / 6) +
                             zz * ((1.0f / 120) + zz * ((1.0f / 5040) + zz * (1.0f / 362880))))),
        simd::all(1.0f));
}

// Euler & Maclaurin's first term where the step changes, for light that dims by exp(-rise) within a step: the factor
// 1 - seam * rise, for a rise that is not too large.
AWAN_INLINE Floats at_seam(float seam, const Floats& rise) {
    return 1.0f - seam * simd::min(simd::max(rise, simd::all(-0.5f)), simd::all(0.5f));
}

// One step of a tile's rays.
struct Step {
    Floats depth;   // optical
    Floats x;       // k * depth
    Floats half;    // exp(-x / 2)
    Floats passed;  // exp(-x)
    Floats taken;   // (1 - exp(-x)) / k: depth times its mean scaled transmittance
};
AWAN_INLINE Step step_of(const Floats& profile, float scaled, float per_scaled) {
    Step step;
    step.depth = simd::min(simd::max(profile, Floats{}), simd::all(kMostDepth));
    step.x = step.depth * scaled;
    step.half = simd::exp(step.x * -0.5f);
    step.passed = step.half * step.half;
    step.taken = simd::one_minus(step.passed, step.x) * per_scaled;
    return step;
}

// Where in a step its light is read, in steps from the middle; x: the step's scaled depth.
//
// A step's weight exp(-k tau) (1 - exp(-x)) / k is exact for light that is even in the step. Where the light has a
// slope S' along the ray, reading it in the middle would be wrong in every step. But what counts is the sum: the errors
// of samples that are evenly spaced cancel in it, except for what the weight itself adds, which is step^2 / 24 sigma^2
// S' exp(-k tau) a unit of length. Reading the light x / 24 of a step before the middle undoes that. (One step alone
// would ask for twice as much.) Of a deep step only the front is seen, 1 / x of a step deep. The quotient goes from the
// one to the other.
AWAN_INLINE Floats reading_place(const Floats& x) {
    return -0.5f * x * (1.0f + x) / (12.0f + x * (3.0f + x));
}

// The grid's light in sample k: at `off` steps from its middle, by its slope there.
template <bool kHaze>
AWAN_INLINE void add_grid_light(const TileLight& light, int k, const Step& step, const Floats& off,
                                Tile& tile) {
    Floats weight = tile.scaled_left * step.taken;
    if constexpr (kHaze) weight *= 1.0f - light.air[k + 1];
    const Floats* const r = light.source[0] + k;
    const Floats* const g = light.source[1] + k;
    const Floats* const b = light.source[2] + k;
    const Floats lean = 0.5f * off;
    tile.red += weight * simd::max(r[1] + lean * (r[2] - r[0]), Floats{});
    tile.green += weight * simd::max(g[1] + lean * (g[2] - g[0]), Floats{});
    tile.blue += weight * simd::max(b[1] + lean * (b[2] - b[0]), Floats{});
}

// The sun's beam in a sample.
struct SunHere {
    Floats rise;  // of t_s within the step
    Ints deep;    // steps of which only the front is seen
    Floats
        from_sun;  // t_s where the light is read: in the middle, of a deep step at the reading place
    Floats lit;    // exp(-k t_s)
};
AWAN_INLINE SunHere sun_here(const TileLight& light, int k, const Step& step, const Floats& off,
                             float scaled) {
    SunHere sun;
    sun.rise = 0.5f * (light.depth[k + 2] - light.depth[k]);
    sun.deep = step.x > kDeepStep;
    sun.from_sun = simd::max(light.depth[k + 1] + (sun.deep ? off * sun.rise : Floats{}), Floats{});
    sun.lit = simd::exp(sun.from_sun * -scaled);
    return sun;
}

// The weight of a step that is not deep, for light that dims by exp(-x u) towards the eye and by exp(-rise u) towards
// the sun, u = 0..1 along the step: its depth times the mean of exp(-x / 2) exp(-(x + rise) (u - 1/2)). Of this step
// alone the mean would be mean_decay with z^2 = (x + rise)^2 / 4. The sum over evenly spaced samples needs only half of
// the product of x and rise in it, and nothing of rise^2, for the reason given at reading_place.
AWAN_INLINE Floats thin_weight(const Floats& half, const Floats& x, const Floats& depth,
                               const Floats& rise, float seam) {
    return mean_decay(half, 0.25f * x * (x + rise)) * depth * at_seam(seam, rise);
}

// (F2(t_s) exp(-tau) + F2(tau) exp(-t_s)) / 2 with F2(t) = G(t) exp(-k t): sunlight that only the peak has scattered,
// on its way into the cloud or on its way out. The mean of the two is what full paths come closest to.
AWAN_INLINE Floats peak_light(const Shade& shade, const Step& step, const SunHere& sun, float seam,
                              const Floats& half_whole, const Tile& tile) {
    const Floats lit_whole = simd::exp(-sun.from_sun);
    const Floats on_way_in =
        peak_value(shade.rows, shade.last, sun.from_sun) * sun.lit * tile.left *
        (sun.deep ? simd::one_minus(half_whole * half_whole, step.depth)
                  : thin_weight(half_whole, step.depth, step.depth, shade.scaled * sun.rise, seam));
    const Floats on_way_out =
        peak_value(shade.rows, shade.last, tile.depth + 0.5f * step.depth) * lit_whole *
        tile.scaled_left *
        (sun.deep ? step.taken : thin_weight(step.half, step.x, step.depth, sun.rise, seam));
    return 0.5f * (on_way_in + on_way_out);
}

AWAN_INLINE void add_beam(const Shade& shade, const TileLight& light, int k, const Floats& beam,
                          Tile& tile) {
    if (shade.albedo) {
        tile.red += beam * (shade.beam[0] * light.albedo[0][k + 1]);
        tile.green += beam * (shade.beam[1] * light.albedo[1][k + 1]);
        tile.blue += beam * (shade.beam[2] * light.albedo[2][k + 1]);
    } else {
        tile.red += beam * shade.beam[0];
        tile.green += beam * shade.beam[1];
        tile.blue += beam * shade.beam[2];
    }
}

// Takes samples 0..count-1 of a tile, front to back.
template <bool kHaze>
AWAN_INLINE void march_tile(const Shade& shade, const TileLight& light, int count, Tile& tile) {
    const float scaled = shade.scaled, per_scaled = 1.0f / shade.scaled;
    const int end = tile.last < count - 1 ? tile.last : count - 1;
    for (int k = tile.first; k <= end; ++k) {
        const Step step = step_of(tile.profile[k], scaled, per_scaled);
        const float seam = k == 0 ? shade.seam : 0.0f;
        const Floats off = reading_place(step.x) + seam;
        if (shade.grid) add_grid_light<kHaze>(light, k, step, off, tile);

        const SunHere sun = sun_here(light, k, step, off, scaled);
        const Floats even = thin_weight(step.half, step.x, step.depth, scaled * sun.rise, seam);
        Floats beam = tile.rest_phase * tile.scaled_left * sun.lit * (sun.deep ? step.taken : even);
        if (shade.peak) {
            const Floats half_whole = simd::exp(step.depth * -0.5f);
            beam += peak_light(shade, step, sun, seam, half_whole, tile);
            if constexpr (!kHaze) tile.left *= half_whole * half_whole;
        }
        beam = simd::max(beam, Floats{});
        if constexpr (kHaze) {
            beam *= 1.0f - light.air[k + 1];
            const Floats through = simd::exp(-step.depth);
            const Floats alpha = tile.left * simd::one_minus(through, step.depth);
            tile.seen_air += alpha * light.air[k + 1];
            tile.seen_lost += alpha * light.lost[k + 1];
            tile.left *= through;
        }
        add_beam(shade, light, k, beam, tile);
        tile.depth += step.depth;
        tile.scaled_left *= step.passed;
        if ((k & 3) == 3 && simd::largest(tile.scaled_left) < kUnseen) break;
    }
    tile.alive = simd::largest(tile.scaled_left) >= kUnseen;
}

}  // namespace awan
