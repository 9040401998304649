// The inner loops of the march. Bodies are inlined into one function a target in march_targets.cpp.
#pragma once

#include <cmath>
#include <vector>

#include "core/draw/march_block.h"

namespace awan {

using simd::Bits;
using simd::Floats;
using simd::Ints;
using simd::kLanes;

// Particles of a block, relative to its middle ray: `across` it by (x, y), `along` it from the eye.
struct BlockParticles {
    std::vector<float> x, y, along;
    std::vector<float> place;  // along, less the block's reference distance
    std::vector<float> near;   // no matter closer than this, less the reference
    std::vector<float> s, extinction, reach;

    void resize(std::size_t n) {
        for (auto member : {&BlockParticles::x, &BlockParticles::y, &BlockParticles::along,
                            &BlockParticles::place, &BlockParticles::near, &BlockParticles::s,
                            &BlockParticles::extinction, &BlockParticles::reach})
            (this->*member).resize(n);
    }
};

// Where a particle has matter in each tile (a tile a lane): `half` before and behind `center`, which is relative to the
// block's reference distance; half < 0: none.
struct alignas(64) ActiveParticle {
    Floats center, half;
    Floats shift;  // center less `place`
    std::uint32_t index;
    float end;    // no matter beyond
    float ratio;  // exp(-(step / s)^2)
    bool direct;  // too spread over a tile for a recurrence
};

// Samples k = 0..count-1 at from + (k + 1/2) step, relative to the block's reference distance.
struct Chunk {
    float from, step;
    float
        before;  // the step of the chunk that ended at `from`; 0: exact up to there, or nothing (the eye)
    int count;    // <= kChunk
    bool joined;  // whether the samples before `from` were stepped differently, or cut off there
};

// Light on the samples of one tile; [k + 1] is sample k's: one more at either end, for slopes.
struct TileLight {
    Floats depth[kChunk + 2];
    Floats source[3][kChunk + 2];
    Floats albedo[3][kChunk + 2];              // only if cells have their own
    Floats air[kChunk + 2], lost[kChunk + 2];  // only in haze
};

struct alignas(64) Tile {
    Floats x, y, z;          // of the lanes' directions, less the block's middle ray, in its frame
    Floats profile[kChunk];  // optical depth of each sample
    int first, last;         // samples with matter
    bool alive;
    bool started;              // rest_phase and rows are set
    Floats depth;              // optical, so far
    Floats left, scaled_left;  // exp(-depth), exp(-scaled depth)
    Floats red, green, blue;
    Floats rest_phase;           // p1
    Floats seen_air, seen_lost;  // in haze: sums of alpha weight * O and * L (air.h)
};

constexpr float kRootTwoPi = 2.50662827f;
constexpr float kLeastRecurrence =
    1.0f;  // of s in steps; equally spaced samples sum to the mass within 1e-8
constexpr float kUnseen = 1e-4f;    // scaled transmittance below which a ray has ended
constexpr float kMostDepth = 1e5f;  // of one sample; more looks the same

// The ray's closest point to a particle's centre: b^2, and how much farther than `along` it is.
struct Closest {
    Floats b2, shift;
};
AWAN_INLINE Closest closest(const BlockParticles& p, std::size_t i, const Floats& x,
                            const Floats& y, const Floats& z) {
    const float along = p.along[i];
    const Floats wx = p.x[i] - along * x, wy = p.y[i] - along * y, wz = -along * z;
    const Floats shift = wx * x + wy * y + wz * (1.0f + z);
    return {simd::max(wx * wx + wy * wy + wz * wz - shift * shift, Floats{}), shift};
}

// Sums of midpoints miss the integral where the spacing changes: Euler & Maclaurin's first two terms there.
AWAN_INLINE void join(float extinction, float s, float before, float after, const Floats& b2,
                      const Floats& center, Tile& tile) {
    const float h2 = before * before - after * after;
    const float h4 = before * before * before * before - after * after * after * after;
    const float per_s = 1.0f / s;
    const Floats v = -center * per_s;
    const Floats value = extinction * simd::exp((b2 * (per_s * per_s) + v * v) * -0.5f);
    const Floats slope = -v * value * per_s;
    const Floats third = (3.0f * v - v * v * v) * value * (per_s * per_s * per_s);
    tile.profile[0] += slope * (h2 * (1.0f / 24)) - third * (h4 * (7.0f / 5760));
}

// Adds one particle to the profiles of all tiles. What is the same for a tile's pixels is found for all tiles at once; the
// closest points of a tile's pixels differ by little, which only moves mass between neighbouring samples or enters a
// short series.
AWAN_INLINE void deposit(const BlockParticles& p, const ActiveParticle& a, const Chunk& chunk,
                         Tile* tiles) {
    const std::size_t i = a.index;
    const float step = chunk.step, s = p.s[i], per_step = 1.0f / step, per_s = 1.0f / s;
    const float per_s2 = per_s * per_s;
    const Floats center = a.center - chunk.from;
    // First and last sample, kept in -1..count.
    const Floats most = simd::all(static_cast<float>(chunk.count + 1)), none = Floats{};
    const Floats low = simd::min(simd::max((center - a.half) * per_step + 1.0f, none), most);
    const Floats high = simd::min(simd::max((center + a.half) * per_step + 1.0f, none), most);
    const Ints low_at = __builtin_convertvector(low, Ints) - 1;
    const Ints high_at = __builtin_convertvector(high, Ints) - 1;
    const Ints first = low_at < 0 ? Ints{} : low_at;
    const Ints end = Ints{} + (chunk.count - 1);
    const Ints last = high_at > end ? end : high_at;
    int touched[kTiles], count = 0, least = kChunk, greatest = -1;
    for (int t = 0; t < kTiles; ++t) {
        if (!(a.half[t] > 0.0f) || first[t] > last[t] || !tiles[t].alive) continue;
        touched[count++] = t;
        least = first[t] < least ? first[t] : least;
        greatest = last[t] > greatest ? last[t] : greatest;
        Tile& tile = tiles[t];
        tile.first = first[t] < tile.first ? first[t] : tile.first;
        tile.last = last[t] > tile.last ? last[t] : tile.last;
    }
    if (count == 0) return;
    const bool masses = s < kLeastRecurrence * step;
    if (masses) {
        Floats share[kChunk];  // of the mass, in each sample and tile
        Floats below{};
        for (int k = least; k <= greatest + 1; ++k) {
            const Floats cdf = simd::normal_cdf((static_cast<float>(k) * step - center) * per_s);
            const Floats next = low_at >= k ? Floats{} : (high_at < k ? simd::all(1.0f) : cdf);
            if (k > least) share[k - 1] = next - below;
            below = next;
        }
        const float whole = p.extinction[i] * s * kRootTwoPi;
        for (int n = 0; n < count; ++n) {
            const int t = touched[n];
            Tile& tile = tiles[t];
            const Closest at = closest(p, i, tile.x, tile.y, tile.z);
            const Floats mass = whole * simd::exp(at.b2 * (-0.5f * per_s2));
            for (int k = first[t]; k <= last[t]; ++k) tile.profile[k] += mass * share[k][t];
        }
    } else {
        const float amplitude = p.extinction[i] * step;
        const Floats u = (__builtin_convertvector(first, Floats) + 0.5f) * step - center;
        const Floats factors = simd::exp((u * step + 0.5f * step * step) * -per_s2);
        Floats value[kTiles], factor[kTiles];
        for (int n = 0; n < count; ++n) {
            const int t = touched[n];
            Tile& tile = tiles[t];
            const Closest at = closest(p, i, tile.x, tile.y, tile.z);
            const Floats off = at.shift - a.shift[t];
            const Floats v = u[t] - off;
            if (a.direct) {
                Floats w = v;
                for (int k = first[t]; k <= last[t]; ++k, w += step)
                    tile.profile[k] += amplitude * simd::exp((at.b2 + w * w) * (-0.5f * per_s2));
                continue;
            }
            value[n] = amplitude * simd::exp((at.b2 + v * v) * (-0.5f * per_s2));
            const Floats y = off * (step * per_s2);
            factor[n] = factors[t] * (1.0f + y * (1.0f + y * (0.5f + y * (1.0f / 6))));
        }
        const float ratio = a.ratio;
        for (int n = 0; n < count && !a.direct; ++n) {
            const int t = touched[n];
            Floats* const profile = tiles[t].profile;
            Floats v = value[n], f = factor[n];
            for (int k = first[t]; k <= last[t]; ++k) {
                profile[k] += v;
                v *= f;
                f *= ratio;
            }
        }
    }
    if (!chunk.joined) return;
    for (int n = 0; n < count; ++n) {
        const int t = touched[n];
        if (low_at[t] >= 0) continue;
        const Closest at = closest(p, i, tiles[t].x, tiles[t].y, tiles[t].z);
        // Masses are cut at the tile's middle, recurrences (and the eye's end of a ray) at each pixel's own place.
        const bool were_masses = chunk.before > 0.0f && s < kLeastRecurrence * chunk.before;
        if (masses != were_masses) {
            const Floats missing = simd::normal_cdf(simd::all(-center[t] * per_s)) -
                                   simd::normal_cdf((a.shift[t] - center[t] - at.shift) * per_s);
            const Floats mass =
                (p.extinction[i] * s * kRootTwoPi) * simd::exp(at.b2 * (-0.5f * per_s2));
            tiles[t].profile[0] += (masses ? mass : -mass) * missing;
        }
        join(p.extinction[i], s, s < kLeastRecurrence * chunk.before ? 0.0f : chunk.before,
             masses ? 0.0f : step, at.b2, center[t] + (at.shift - a.shift[t]), tiles[t]);
    }
}

// The first sample of a tile that is longer than a step may be where it is seen, or kChunk.
AWAN_INLINE int first_too_deep(const Tile& tile, float scaled, float allowed) {
    Floats seen = tile.depth * scaled, worst = Floats{};
    for (int k = tile.first; k <= tile.last; ++k) {
        const Floats x = tile.profile[k] * scaled;
        worst = simd::max(worst, x - allowed * (1.0f + seen));
        seen += x;
    }
    if (!(simd::largest(worst) > 0.0f)) return kChunk;
    seen = tile.depth * scaled;
    for (int k = tile.first; k <= tile.last; ++k) {
        const Floats x = tile.profile[k] * scaled;
        if (simd::largest(x - allowed * (1.0f + seen)) > 0.0f) return k;
        seen += x;
    }
    return kChunk;
}

// Light at four corners, to a tile's pixels.
struct Bilinear {
    int corner[4];
    Floats weight[4];
};
AWAN_INLINE Floats blend(const Bilinear& b, float c0, float c1, float c2, float c3) {
    return b.weight[0] * c0 + b.weight[1] * c1 + b.weight[2] * c2 + b.weight[3] * c3;
}
AWAN_INLINE void spread_light(const Bilinear& b, const LightAt (*corners)[kChunk + 2], int first,
                              int last, bool albedo, bool air, TileLight& light) {
    const LightAt *c0 = corners[b.corner[0]], *c1 = corners[b.corner[1]],
                  *c2 = corners[b.corner[2]], *c3 = corners[b.corner[3]];
    for (int k = first; k <= last + 2; ++k) {
        light.depth[k] = blend(b, c0[k].depth, c1[k].depth, c2[k].depth, c3[k].depth);
        for (int c = 0; c < 3; ++c)
            light.source[c][k] =
                blend(b, c0[k].source[c], c1[k].source[c], c2[k].source[c], c3[k].source[c]);
        if (albedo)
            for (int c = 0; c < 3; ++c)
                light.albedo[c][k] =
                    blend(b, c0[k].albedo[c], c1[k].albedo[c], c2[k].albedo[c], c3[k].albedo[c]);
    }
    if (!air) return;
    for (int k = first + 1; k <= last + 1; ++k) {
        light.air[k] = blend(b, c0[k].air, c1[k].air, c2[k].air, c3[k].air);
        light.lost[k] = blend(b, c0[k].lost, c1[k].lost, c2[k].lost, c3[k].lost);
    }
}

// G of the peak table at optical depth t. A tile's pixels mostly meet in one or two of its columns: no gathering.
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

struct Shade {
    float scaled;  // 1 - a f
    float
        seam;  // (before^2 / step^2 - 1) / 24 where a chunk begins whose step is not the one's before; 0: it is
    bool grid, peak, albedo;
    float beam[3];       // albedo * irradiance; irradiance alone if cells have their own albedo
    const Floats* rows;  // of the peak table: a column each, a pixel a lane
    float last;
};

// The mean of exp over a step in which its argument goes from z to -z, times exp(-x / 2) = half: stays below 1.
AWAN_INLINE Floats mean_decay(const Floats& half, const Floats& z2) {
    const Floats zz = simd::max(simd::min(z2, simd::all(16.0f)), simd::all(-4.0f));
    return simd::min(
        half * (1.0f + zz * ((1.0f / 6) +
                             zz * ((1.0f / 120) + zz * ((1.0f / 5040) + zz * (1.0f / 362880))))),
        simd::all(1.0f));
}

// What light that goes with exp(-rise) a step is multiplied by at a seam.
AWAN_INLINE Floats at_seam(float seam, const Floats& rise) {
    return 1.0f - seam * simd::min(simd::max(rise, simd::all(-0.5f)), simd::all(0.5f));
}

// Samples 0..count-1 of a tile. Radiance is the sum over samples of extinction x light x transmittance, and sums over even
// samples of what is smooth are far better than each of them (Euler & Maclaurin). But the transmittance that depths of
// whole steps give, exact for even light, is off by step^2 in each: where light has the slope S' along the ray, by
// step^2 / 24 sigma^2 S' T in all. That is what the light is leant by, half of what light linear within a step of even
// extinction would ask for; a deep step goes over into that. Where the step changes, Euler & Maclaurin's first term.
template <bool kHaze>
AWAN_INLINE void march_tile(const Shade& shade, const TileLight& light, int count, Tile& tile) {
    const float scaled = shade.scaled, per_scaled = 1.0f / shade.scaled;
    const int end = tile.last < count - 1 ? tile.last : count - 1;
    for (int k = tile.first; k <= end; ++k) {
        const Floats depth = simd::min(simd::max(tile.profile[k], Floats{}), simd::all(kMostDepth));
        const Floats x = depth * scaled;
        const Floats half = simd::exp(x * -0.5f);
        const Floats passed = half * half;
        const Floats taken = simd::one_minus(passed, x) * per_scaled;
        const float seam = k == 0 ? shade.seam : 0.0f;
        // How far before the step's middle light is looked up: x/24 - ... ; 1/2 - 1/x, all of it from the front.
        const Floats off = -0.5f * x * (1.0f + x) / (12.0f + x * (3.0f + x)) + seam;
        if (shade.grid) {
            Floats weight = tile.scaled_left * taken;
            if constexpr (kHaze) weight *= 1.0f - light.air[k + 1];
            const Floats* const r = light.source[0] + k;
            const Floats* const g = light.source[1] + k;
            const Floats* const b = light.source[2] + k;
            const Floats lean = 0.5f * off;
            tile.red += weight * simd::max(r[1] + lean * (r[2] - r[0]), Floats{});
            tile.green += weight * simd::max(g[1] + lean * (g[2] - g[0]), Floats{});
            tile.blue += weight * simd::max(b[1] + lean * (b[2] - b[0]), Floats{});
        }
        const Floats rise = 0.5f * (light.depth[k + 2] - light.depth[k]);
        const Ints deep = x > 8.0f;
        const Floats from_sun =
            simd::max(light.depth[k + 1] + (deep ? off * rise : Floats{}), Floats{});
        const Floats lit = simd::exp(from_sun * -scaled);
        // As with the grid's light: the slope of the beam counts once with the eye's, not twice.
        const Floats seam_scaled = at_seam(seam, scaled * rise);
        const Floats even = mean_decay(half, 0.25f * x * (x + scaled * rise)) * depth * seam_scaled;
        Floats beam = tile.rest_phase * tile.scaled_left * lit * (deep ? taken : even);
        if (shade.peak) {
            const Floats half_whole = simd::exp(depth * -0.5f);
            const Floats lit_whole = simd::exp(-from_sun);
            const Floats before =
                peak_value(shade.rows, shade.last, from_sun) * lit * tile.left *
                (deep ? simd::one_minus(half_whole * half_whole, depth)
                      : mean_decay(half_whole, 0.25f * depth * (depth + scaled * rise)) * depth *
                            seam_scaled);
            const Floats after =
                peak_value(shade.rows, shade.last, tile.depth + 0.5f * depth) * lit_whole *
                tile.scaled_left *
                (deep ? taken
                      : mean_decay(half, 0.25f * x * (x + rise)) * depth * at_seam(seam, rise));
            beam += 0.5f * (before + after);
            if constexpr (!kHaze) tile.left *= half_whole * half_whole;
        }
        beam = simd::max(beam, Floats{});
        if constexpr (kHaze) {
            beam *= 1.0f - light.air[k + 1];
            const Floats through = simd::exp(-depth);
            const Floats alpha = tile.left * simd::one_minus(through, depth);
            tile.seen_air += alpha * light.air[k + 1];
            tile.seen_lost += alpha * light.lost[k + 1];
            tile.left *= through;
        }
        if (shade.albedo) {
            tile.red += beam * (shade.beam[0] * light.albedo[0][k + 1]);
            tile.green += beam * (shade.beam[1] * light.albedo[1][k + 1]);
            tile.blue += beam * (shade.beam[2] * light.albedo[2][k + 1]);
        } else {
            tile.red += beam * shade.beam[0];
            tile.green += beam * shade.beam[1];
            tile.blue += beam * shade.beam[2];
        }
        tile.depth += depth;
        tile.scaled_left *= passed;
        if ((k & 3) == 3 && simd::largest(tile.scaled_left) < kUnseen) break;
    }
    tile.alive = simd::largest(tile.scaled_left) >= kUnseen;
}

// Where a block's particle has matter in each tile: `ray` the tiles' middle rays, `spread` how far a pixel's ray may be
// from them (difference of unit directions).
AWAN_INLINE void measure(const BlockParticles& p, const Floats ray[3], const Floats& spread,
                         ActiveParticle& a) {
    const std::size_t i = a.index;
    const float along = p.along[i], reach = p.reach[i];
    const float distance = std::sqrt(p.x[i] * p.x[i] + p.y[i] * p.y[i] + along * along);
    const Closest at = closest(p, i, ray[0], ray[1], ray[2]);
    const Floats b = simd::sqrt(at.b2);
    // A point of a tile's rays is off its middle ray by at most spread * distance; the closest points, to second order.
    const Floats least = simd::max(b - spread * distance, Floats{});
    const Floats chord2 = reach * reach - least * least;
    const Floats slack = spread * (b + 2.0f * spread * distance);
    // Two s more than the sphere: at its rim the ray would lose half of what little it meets.
    const float more = 4.0f * p.s[i] * p.s[i];
    const Floats half = simd::sqrt(chord2 > 0.0f ? chord2 + more : Floats{});
    a.shift = at.shift;
    a.center = p.place[i] + at.shift;
    a.half = chord2 > 0.0f ? half + slack : simd::all(-1.0f);
    const Floats end = chord2 > 0.0f ? a.center + a.half : simd::all(-1e30f);
    a.end = simd::largest(end);
    a.direct = simd::largest(slack) > 0.15f * p.s[i];
}

}  // namespace awan
