// Light that is looked up at the corners of squares of pixels, interpolated to each pixel. Inlined into one function a
// target in march_targets.cpp.
#pragma once

#include "core/draw/march_light.h"
#include "core/draw/march_tile.h"

namespace awan {

using simd::Floats;

AWAN_INLINE Floats blend(const Bilinear& b, float c0, float c1, float c2, float c3) {
    return b.weight[0] * c0 + b.weight[1] * c1 + b.weight[2] * c2 + b.weight[3] * c3;
}

// Fills samples first..last of a tile's light, and one more at either end of what has slopes. corners[c][k + 1]: light
// of sample k at corner c. `albedo`, `air`: whether those are wanted.
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

}  // namespace awan
