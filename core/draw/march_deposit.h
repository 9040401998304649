// The matter of particles along the rays of a block: optical depth, sample by sample. Bodies are inlined into one
// function a target in march_targets.cpp.
//
// A particle is a Gaussian of extinction, n exp(-d^2 / (2 s^2)). Along a ray that passes its centre at distance b it is
//     sigma(t) = n exp(-(b^2 + (t - c)^2) / (2 s^2)),     c the ray's closest point to the centre.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/draw/march_simd.h"
#include "core/draw/march_tile.h"

namespace awan {

using simd::Floats;
using simd::Ints;

constexpr float kRootTwoPi = 2.50662827f;
// Least s, in steps, of a particle that is sampled at the samples' middles. Equally spaced samples of such a Gaussian
// sum to its mass within 1e-8. A narrower one has its mass in each sample, exactly.
constexpr float kLeastRecurrence = 1.0f;

// A ray's closest point to a particle's centre: the distance b squared, and how much farther along the ray it is than
// `along`, its place on the middle ray. For a ray of direction m + d (m the middle ray, both unit) it is computed from
// the small difference d alone: the difference of two large squares would lose its digits.
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

// Where a block's particle has matter in each tile. `ray`: the tiles' middle rays, as the directions of a Tile;
// `spread`: how far a pixel's ray may be from its tile's middle ray (difference of unit directions).
AWAN_INLINE void measure(const BlockParticles& p, const Floats ray[3], const Floats& spread,
                         ActiveParticle& a) {
    const std::size_t i = a.index;
    const float along = p.along[i], reach = p.reach[i];
    const float distance = std::sqrt(p.x[i] * p.x[i] + p.y[i] * p.y[i] + along * along);
    const Closest at = closest(p, i, ray[0], ray[1], ray[2]);
    const Floats b = simd::sqrt(at.b2);
    // At this distance a tile's rays are up to spread * distance from its middle ray. Their closest points lie within
    // `slack` of the middle ray's, to second order in the spread.
    const Floats least = simd::max(b - spread * distance, Floats{});
    const Floats chord2 = reach * reach - least * least;
    const Floats slack = spread * (b + 2.0f * spread * distance);
    // Two s more than the chord of the sphere: a ray that grazes its rim would lose half of what little it meets.
    const float more = 4.0f * p.s[i] * p.s[i];
    const Floats half = simd::sqrt(chord2 > 0.0f ? chord2 + more : Floats{});
    a.shift = at.shift;
    a.center = p.place[i] + at.shift;
    a.half = chord2 > 0.0f ? half + slack : simd::all(-1.0f);
    const Floats end = chord2 > 0.0f ? a.center + a.half : simd::all(-1e30f);
    a.end = simd::largest(end);
    a.direct = simd::largest(slack) > 0.15f * p.s[i];
}

// The samples of a chunk in which a particle has matter, a tile a lane.
struct SampleSpan {
    Floats center;         // of the particle, distance from the chunk's start
    Ints low_at, high_at;  // first and last, -1..count: -1 lies before the chunk, count beyond it
    Ints first, last;      // those within the chunk
};
AWAN_INLINE SampleSpan samples_of(const ActiveParticle& a, const Chunk& chunk) {
    SampleSpan span;
    const float per_step = 1.0f / chunk.step;
    span.center = a.center - chunk.from;
    const Floats most = simd::all(static_cast<float>(chunk.count + 1)), none = Floats{};
    const Floats low = simd::min(simd::max((span.center - a.half) * per_step + 1.0f, none), most);
    const Floats high = simd::min(simd::max((span.center + a.half) * per_step + 1.0f, none), most);
    span.low_at = __builtin_convertvector(low, Ints) - 1;
    span.high_at = __builtin_convertvector(high, Ints) - 1;
    const Ints end = Ints{} + (chunk.count - 1);
    span.first = span.low_at < 0 ? Ints{} : span.low_at;
    span.last = span.high_at > end ? end : span.high_at;
    return span;
}

// The tiles in which a particle has samples, and the range of those samples over all tiles.
struct TouchedTiles {
    int tile[kTiles];
    int count = 0;
    int least = kChunk, greatest = -1;
};
AWAN_INLINE TouchedTiles touch(const ActiveParticle& a, const SampleSpan& span, Tile* tiles) {
    TouchedTiles touched;
    for (int t = 0; t < kTiles; ++t) {
        const int first = span.first[t], last = span.last[t];
        if (!(a.half[t] > 0.0f) || first > last || !tiles[t].alive) continue;
        touched.tile[touched.count++] = t;
        touched.least = first < touched.least ? first : touched.least;
        touched.greatest = last > touched.greatest ? last : touched.greatest;
        Tile& tile = tiles[t];
        tile.first = first < tile.first ? first : tile.first;
        tile.last = last > tile.last ? last : tile.last;
    }
    return touched;
}

// A particle that is narrow beside a step: each sample gets the mass that lies within its step,
//     n s sqrt(2 pi) exp(-b^2 / (2 s^2)) (Phi((t1 - c) / s) - Phi((t0 - c) / s)),
// Phi the cumulative normal distribution. The shares of the mass are found once, for the tiles' middle rays.
AWAN_INLINE void deposit_masses(const BlockParticles& p, const ActiveParticle& a,
                                const Chunk& chunk, const SampleSpan& span,
                                const TouchedTiles& touched, Tile* tiles) {
    const std::size_t i = a.index;
    const float s = p.s[i], per_s = 1.0f / s, per_s2 = per_s * per_s;
    Floats share[kChunk];
    Floats below{};
    for (int k = touched.least; k <= touched.greatest + 1; ++k) {
        const Floats cdf =
            simd::normal_cdf((static_cast<float>(k) * chunk.step - span.center) * per_s);
        const Floats next =
            span.low_at >= k ? Floats{} : (span.high_at < k ? simd::all(1.0f) : cdf);
        if (k > touched.least) share[k - 1] = next - below;
        below = next;
    }
    const float whole = p.extinction[i] * s * kRootTwoPi;
    for (int n = 0; n < touched.count; ++n) {
        const int t = touched.tile[n];
        Tile& tile = tiles[t];
        const Closest at = closest(p, i, tile.x, tile.y, tile.z);
        const Floats mass = whole * simd::exp(at.b2 * (-0.5f * per_s2));
        for (int k = span.first[t]; k <= span.last[t]; ++k) tile.profile[k] += mass * share[k][t];
    }
}

// A particle that is wide beside a step: each sample is step * sigma in its middle. From sample to sample, at v = t -
// c,
//     sigma(v + h) / sigma(v) = exp(-(v h + h^2 / 2) / s^2),
// and this factor shrinks by exp(-(h / s)^2) a sample: two multiplications each instead of an exponential. The first
// factor is that of the tile's middle ray times exp(y) for each pixel, y small: its series to the third order. Where
// the closest points of a tile's pixels differ too much for that (a.direct), every sample has its exponential.
AWAN_INLINE void deposit_samples(const BlockParticles& p, const ActiveParticle& a,
                                 const Chunk& chunk, const SampleSpan& span,
                                 const TouchedTiles& touched, Tile* tiles) {
    const std::size_t i = a.index;
    const float step = chunk.step, per_s = 1.0f / p.s[i], per_s2 = per_s * per_s;
    const float amplitude = p.extinction[i] * step;
    const Floats u = (__builtin_convertvector(span.first, Floats) + 0.5f) * step - span.center;
    const Floats factors = simd::exp((u * step + 0.5f * step * step) * -per_s2);
    Floats value[kTiles], factor[kTiles];
    for (int n = 0; n < touched.count; ++n) {
        const int t = touched.tile[n];
        Tile& tile = tiles[t];
        const Closest at = closest(p, i, tile.x, tile.y, tile.z);
        const Floats off = at.shift - a.shift[t];
        const Floats v = u[t] - off;
        if (a.direct) {
            Floats w = v;
            for (int k = span.first[t]; k <= span.last[t]; ++k, w += step)
                tile.profile[k] += amplitude * simd::exp((at.b2 + w * w) * (-0.5f * per_s2));
            continue;
        }
        value[n] = amplitude * simd::exp((at.b2 + v * v) * (-0.5f * per_s2));
        const Floats y = off * (step * per_s2);
        factor[n] = factors[t] * (1.0f + y * (1.0f + y * (0.5f + y * (1.0f / 6))));
    }
    // The recurrences by themselves: short loops that nothing else takes registers from.
    const float ratio = a.ratio;
    for (int n = 0; n < touched.count && !a.direct; ++n) {
        const int t = touched.tile[n];
        Floats* const profile = tiles[t].profile;
        Floats v = value[n], f = factor[n];
        for (int k = span.first[t]; k <= span.last[t]; ++k) {
            profile[k] += v;
            v *= f;
            f *= ratio;
        }
    }
}

// The sum of samples at the middles of steps h misses the integral of what is smooth by terms of its two ends only
// (Euler & Maclaurin; [..]: the difference between the ends):
//     sum h sigma = integral - h^2 / 24 [sigma'] + 7 h^4 / 5760 [sigma''']
// Where the step changes from `before` to `after`, the terms of the two sides do not cancel. Their difference goes to
// the chunk's first sample.
AWAN_INLINE void join(float extinction, float s, float before, float after, const Floats& b2,
                      const Floats& center, Floats& sample) {
    const float h2 = before * before - after * after;
    const float h4 = before * before * before * before - after * after * after * after;
    const float per_s = 1.0f / s;
    const Floats v = -center * per_s;
    const Floats value = extinction * simd::exp((b2 * (per_s * per_s) + v * v) * -0.5f);
    const Floats slope = -v * value * per_s;
    const Floats third = (3.0f * v - v * v * v) * value * (per_s * per_s * per_s);
    sample += slope * (h2 * (1.0f / 24)) - third * (h4 * (7.0f / 5760));
}

// Mends the sum of a particle's samples where the chunk begins, if it has matter on both sides.
AWAN_INLINE void join_chunks(const BlockParticles& p, const ActiveParticle& a, const Chunk& chunk,
                             const SampleSpan& span, const TouchedTiles& touched, Tile* tiles) {
    const std::size_t i = a.index;
    const float s = p.s[i], per_s = 1.0f / s, per_s2 = per_s * per_s;
    const bool masses = s < kLeastRecurrence * chunk.step;
    const bool were_masses = chunk.before > 0.0f && s < kLeastRecurrence * chunk.before;
    for (int n = 0; n < touched.count; ++n) {
        const int t = touched.tile[n];
        if (span.low_at[t] >= 0) continue;
        const Closest at = closest(p, i, tiles[t].x, tiles[t].y, tiles[t].z);
        // Masses are divided at the same place for all pixels of a tile, samples (and the eye's end of a ray) at each
        // pixel's own. Where one turns into the other, what lies between the two places is missing or there twice.
        if (masses != were_masses) {
            const Floats missing =
                simd::normal_cdf(simd::all(-span.center[t] * per_s)) -
                simd::normal_cdf((a.shift[t] - span.center[t] - at.shift) * per_s);
            const Floats mass =
                (p.extinction[i] * s * kRootTwoPi) * simd::exp(at.b2 * (-0.5f * per_s2));
            tiles[t].profile[0] += (masses ? mass : -mass) * missing;
        }
        join(p.extinction[i], s, s < kLeastRecurrence * chunk.before ? 0.0f : chunk.before,
             masses ? 0.0f : chunk.step, at.b2, span.center[t] + (at.shift - a.shift[t]),
             tiles[t].profile[0]);
    }
}

// Adds one particle to the profiles of all tiles. What hardly differs between a tile's pixels is computed for its
// middle ray, for all tiles at once.
AWAN_INLINE void deposit(const BlockParticles& p, const ActiveParticle& a, const Chunk& chunk,
                         Tile* tiles) {
    const SampleSpan span = samples_of(a, chunk);
    const TouchedTiles touched = touch(a, span, tiles);
    if (touched.count == 0) return;
    if (p.s[a.index] < kLeastRecurrence * chunk.step)
        deposit_masses(p, a, chunk, span, touched, tiles);
    else
        deposit_samples(p, a, chunk, span, touched, tiles);
    if (chunk.joined) join_chunks(p, a, chunk, span, touched, tiles);
}

// A wide particle that is wide beside a step, too: samples first..last of the rays in between which tiles are.
AWAN_INLINE void deposit_between(const BlockParticles& p, const ActiveParticle& a,
                                 const Chunk& chunk, int first, int last, WideRays& wide) {
    const std::size_t i = a.index;
    const float step = chunk.step, per_s = 1.0f / p.s[i], per_s2 = per_s * per_s;
    const float amplitude = p.extinction[i] * step, ratio = a.ratio;
    const float u = (static_cast<float>(first) + 0.5f) * step - (p.place[i] - chunk.from);
    for (WideRays::Row& row : wide.rows) {
        const Closest at = closest(p, i, row.x, row.y, row.z);
        const Floats v = u - at.shift;
        Floats value = amplitude * simd::exp((at.b2 + v * v) * (-0.5f * per_s2));
        Floats factor = simd::exp((v * step + 0.5f * step * step) * -per_s2);
        for (int k = first; k <= last; ++k) {
            row.profile[k] += value;
            value *= factor;
            factor *= ratio;
        }
    }
}

// As join_chunks, of a wide particle that is sampled on both sides.
AWAN_INLINE void join_between(const BlockParticles& p, const ActiveParticle& a, const Chunk& chunk,
                              WideRays& wide) {
    const std::size_t i = a.index;
    for (WideRays::Row& row : wide.rows) {
        const Closest at = closest(p, i, row.x, row.y, row.z);
        join(p.extinction[i], p.s[i], chunk.before, chunk.step, at.b2,
             (p.place[i] - chunk.from) + at.shift, row.profile[0]);
    }
}

// Adds what lies between the rays to a tile's samples. b: for rays kWideApart apart.
AWAN_INLINE void add_between(const WideRays& wide, const Bilinear& b, Tile& tile) {
    const auto ray = [&](int corner, int k) {
        return wide.rows[b.corner[corner] / simd::kLanes]
            .profile[k][b.corner[corner] % simd::kLanes];
    };
    for (int k = tile.first; k <= tile.last; ++k)
        tile.profile[k] += b.weight[0] * ray(0, k) + b.weight[1] * ray(1, k) +
                           b.weight[2] * ray(2, k) + b.weight[3] * ray(3, k);
}

// First and last samples with matter of all tiles, a tile a lane, and which of those see anything.
struct TileSpans {
    Ints first, last, alive;
};
// Takes in a particle's; gives its samples over all tiles. first > last: it has none. before: whether it has matter
// before the chunk, too.
struct SpanOfAll {
    int first, last;
    bool before;
};
AWAN_INLINE SpanOfAll take_in(const ActiveParticle& a, const SampleSpan& span, TileSpans& tiles) {
    const Ints touched = (a.half > 0.0f) & (span.first <= span.last) & tiles.alive;
    const Ints first = touched ? span.first : Ints{} + kChunk,
               last = touched ? span.last : Ints{} - 1;
    tiles.first = first < tiles.first ? first : tiles.first;
    tiles.last = last > tiles.last ? last : tiles.last;
    return {static_cast<int>(simd::smallest(__builtin_convertvector(first, Floats))),
            static_cast<int>(simd::largest(__builtin_convertvector(last, Floats))),
            simd::any(touched & (span.low_at < 0))};
}

// Adds the particles to the profiles of all tiles, the wide ones by way of rays between which tiles are. between: those
// rays' weights of each tile; null: there is none that is worth it.
AWAN_INLINE void deposit_all(const BlockParticles& p, const std::vector<ActiveParticle>& active,
                             const Chunk& chunk, const Bilinear* between, WideRays& wide,
                             Tile* tiles) {
    TileSpans spans{Ints{} + kChunk, Ints{} - 1, Ints{}};
    for (int t = 0; t < kTiles; ++t) {
        for (auto& sample : tiles[t].profile) sample = Floats{};
        tiles[t].first = kChunk;
        tiles[t].last = -1;
        spans.alive[t] = tiles[t].alive ? -1 : 0;
    }
    if (between != nullptr)
        for (WideRays::Row& row : wide.rows)
            for (auto& sample : row.profile) sample = Floats{};
    for (const ActiveParticle& a : active) {
        if (between == nullptr || p.wide[a.index] == 0 ||
            p.s[a.index] < kLeastRecurrence * chunk.step) {
            deposit(p, a, chunk, tiles);
            continue;
        }
        const SampleSpan span = samples_of(a, chunk);
        const SpanOfAll all = take_in(a, span, spans);
        if (all.first > all.last) continue;
        deposit_between(p, a, chunk, all.first, all.last, wide);
        if (!chunk.joined || !all.before) continue;
        if (p.s[a.index] < kLeastRecurrence * chunk.before)
            join_chunks(p, a, chunk, span, touch(a, span, tiles), tiles);
        else
            join_between(p, a, chunk, wide);
    }
    if (between == nullptr) return;
    for (int t = 0; t < kTiles; ++t) {
        Tile& tile = tiles[t];
        if (!tile.alive) continue;
        tile.first = std::min<int>(tile.first, spans.first[t]);
        tile.last = std::max<int>(tile.last, spans.last[t]);
        add_between(wide, between[t], tile);
    }
}

// The first sample of a tile that is deeper than a step may be, or kChunk. `allowed`: scaled depth of a step that
// nothing hides; behind the scaled depth T it is (1 + T) times that, since less of an error there is seen.
AWAN_INLINE int first_too_deep(const Tile& tile, float scaled, float allowed) {
    // Mostly there is none: that is found without looking at each sample's lanes.
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

}  // namespace awan
