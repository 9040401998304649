// Detail (core/generate/detail.h) in a tile's depth profile, sixteen pixels at a time. Bodies are inlined into one
// function a target in march_targets.cpp.
#pragma once

#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>

#include "core/draw/march_simd.h"
#include "core/draw/march_tile.h"
#include "core/generate/detail.h"

namespace awan {

using simd::Floats;
using simd::Ints;
using simd::kLanes;

// A block's rays in the tile of noise that detail repeats over space, in voxels. The block's axes are right, up and
// middle (its middle ray). At distance t from the eye the ray of direction middle + x right + y up + z middle is at
//     start + (t - reference) middle + t (x right + y up + z middle).
struct DetailRays {
    const DetailField* field = nullptr;  // null: there is no detail
    float start[3] = {};                 // of the middle ray at the reference, 0..kDetailSide
    float right[3] = {}, up[3] = {}, middle[3] = {};  // voxels per scene unit
    float reference = 0;                              // distance from the eye, scene units
    float far = 1e30f;  // distance from the eye at which the largest bumps are as wide as the closest rays are apart
};

// The noise n at places p (voxels), trilinear. A word of the tile holds four neighbours, a byte each: those at (x, y),
// (x + 1, y), (x, y + 1) and (x + 1, y + 1).
AWAN_INLINE Floats bumps_at(const std::uint32_t* words, const Floats p[3]) {
    constexpr auto side = static_cast<float>(kDetailSide);
    Ints low[3];
    Floats part[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Floats turns = p[axis] * (1 / side);
        Ints whole = __builtin_convertvector(turns, Ints);
        // Rounded towards 0, whole is one too many where turns < 0; the mask of a true comparison is -1.
        whole += turns < __builtin_convertvector(whole, Floats);
        const Floats in = p[axis] - __builtin_convertvector(whole, Floats) * side;
        const Floats kept = simd::min(simd::max(in, Floats{}), simd::all(side * 0.9999999f));
        low[axis] = __builtin_convertvector(kept, Ints);
        part[axis] = kept - __builtin_convertvector(low[axis], Floats);
    }
    const Ints at = (low[2] * kDetailSide + low[1]) * kDetailSide + low[0];
    std::int32_t index[kLanes];
    std::uint32_t near[kLanes], far[kLanes];
    std::memcpy(index, &at, sizeof index);
    for (int lane = 0; lane < kLanes; ++lane) {
        near[lane] = words[index[lane]];
        far[lane] = words[index[lane] + kDetailSide * kDetailSide];
    }
    const auto layer = [&](const std::uint32_t* from) __attribute__((always_inline)) {
        Ints w;
        std::memcpy(&w, from, sizeof w);
        const Floats a = __builtin_convertvector(w & 255, Floats);
        const Floats b = __builtin_convertvector(w >> 8 & 255, Floats);
        const Floats c = __builtin_convertvector(w >> 16 & 255, Floats);
        const Floats d = __builtin_convertvector(w >> 24 & 255, Floats);
        const Floats low_y = a + part[0] * (b - a), high_y = c + part[0] * (d - c);
        return low_y + part[1] * (high_y - low_y);
    };
    const Floats a = layer(near), b = layer(far);
    return (a + part[2] * (b - a) + 0.5f) * (1.0f / 256);
}

// detailed() of core/generate/detail.h, divided by keep * edge, for u in 0..1: min(u / E(v), kMostGathered) * ramp(n;
// v). With w the softness and a = 1 - v (1 + w) the noise at which the ramp begins, E(v) is the mean of the ramp over n
// in 0..1:
//     (1 - a)^2 / (2 w)              where a >= 1 - w: the ramp is cut off at its upper end,
//     (1 - a) - w / 2                where 0 <= a < 1 - w,
//     1 - (a + w)^2 / (2 w)          where a < 0: it is cut off at its lower end.
AWAN_INLINE Floats lumps(const Floats& u, const Floats& n) {
    constexpr float w = kSoftness;
    const Floats v = 2.0f * u / (1.0f + u);
    const Floats ramp =
        simd::min(simd::max((n - 1.0f + v * (1 + w)) * (1 / w), Floats{}), simd::all(1.0f));
    const Floats a = 1.0f - v * (1 + w);
    const Floats rest = 1.0f - a;
    const Floats early = rest * rest * (1 / (2 * w)), middle = rest - 0.5f * w;
    const Floats late = 1.0f - (a + w) * (a + w) * (1 / (2 * w));
    const Floats share = a >= 1 - w ? early : (a >= 0.0f ? middle : late);
    const Floats lump =
        simd::min(u / simd::max(share, simd::all(1e-20f)), simd::all(kMostGathered));
    return lump * ramp;
}

// Turns the smooth depth of each sample of the tile into the detailed one.
AWAN_INLINE void add_detail(const DetailRays& rays, const Chunk& chunk, Tile& tile) {
    const DetailField& field = *rays.field;
    // Depth of a sample whose smooth extinction is `edge`.
    const float whole = field.edge * chunk.step;
    const float per_whole = 1 / whole;
    Floats slope[3], start[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Floats aside =
            tile.x * rays.right[axis] + tile.y * rays.up[axis] + tile.z * rays.middle[axis];
        slope[axis] = aside + rays.middle[axis];
        start[axis] = rays.start[axis] + rays.reference * aside;
    }
    for (int k = tile.first; k <= tile.last; ++k) {
        const Floats u = tile.profile[k] * per_whole;
        const Ints thin = static_cast<Ints>(u < 1.0f) & static_cast<Ints>(1e-6f < u);
        const float t = chunk.from + (static_cast<float>(k) + 0.5f) * chunk.step;
        // Bumps that lie between rays would be seen as noise: as they shrink from two gaps to one, smooth matter takes
        // over.
        const float seen = rays.far / (rays.reference + t) - 1.0f;
        const float sharp = seen < 0.0f ? 0.0f : seen > 1.0f ? 1.0f : seen;
        const float keep = 1.0f + sharp * (field.keep - 1.0f);
        Floats detailed = tile.profile[k] * keep;
        if (simd::any(thin)) {
            const Floats p[3] = {start[0] + t * slope[0], start[1] + t * slope[1],
                                 start[2] + t * slope[2]};
            const Floats lump = lumps(simd::max(u, Floats{}), bumps_at(field.tile->data(), p));
            const Floats gathered = (whole * keep) * lump;
            detailed = u < 1.0f ? detailed + sharp * (gathered - detailed) : detailed;
        }
        tile.profile[k] = detailed;
    }
}

}  // namespace awan
