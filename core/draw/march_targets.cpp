#include "core/draw/march_targets.h"

#include <algorithm>

#include "core/base/instruction_sets.h"
#include "core/draw/march_deposit.h"
#include "core/draw/march_finish.h"
#include "core/draw/march_spread.h"

namespace awan {
namespace {

AWAN_INLINE void measure_body(const BlockParticles& p, const Floats* ray, const Floats& spread,
                              ActiveParticle& a) {
    measure(p, ray, spread, a);
}
AWAN_INLINE void detail_body(const DetailRays& rays, const Chunk& chunk, Tile* tiles) {
    for (int t = 0; t < kTiles; ++t)
        if (tiles[t].alive) add_detail(rays, chunk, tiles[t]);
}
AWAN_INLINE void ratio_body(const BlockParticles& p, float step,
                            std::vector<ActiveParticle>& active) {
    for (std::size_t first = 0; first < active.size(); first += kLanes) {
        const std::size_t count = std::min<std::size_t>(kLanes, active.size() - first);
        Floats x{};
        for (std::size_t i = 0; i < count; ++i) {
            const float h = step / p.s[active[first + i].index];
            x[static_cast<int>(i)] = -h * h;
        }
        x = simd::exp(x);
        for (std::size_t i = 0; i < count; ++i) active[first + i].ratio = x[static_cast<int>(i)];
    }
}

// The phase functions towards sixteen pixels.
AWAN_INLINE void phases_body(const MarchScene& scene, const SunInBlock& sun, Tile& tile,
                             Floats* rows) {
    const Floats ray[3] = {tile.x, tile.y, tile.z};
    const Chords c = chords(sun, ray);
    tile.rest_phase = rest_of_phase(scene.rest, c);
    if (scene.table.columns > 0) rows_of(scene.table, c, rows);
}
AWAN_INLINE void rays_body(const BlockFrame& frame, const float* x, const float* y, Floats* to) {
    directions(frame, x, y, to);
}
// `up`: components of the block's axes along the scene's y.
AWAN_INLINE BehindTile behind_tile(const float* up, const BehindPixels& behind, const Tile& tile) {
    return {behind, up[0] * tile.x + up[1] * tile.y + up[2] * (1.0f + tile.z)};
}
AWAN_INLINE void finish_body(const MarchScene& scene, const float* up, const BehindPixels& behind,
                             const Tile& tile, float (*to)[4]) {
    finish(scene, behind_tile(up, behind, tile), tile, to);
}
AWAN_INLINE void finish_air_body(const MarchScene& scene, const AirTile& air, const SunInBlock& sun,
                                 const float* up, const BehindPixels& behind, const Tile& tile,
                                 float (*to)[4]) {
    const Floats ray[3] = {tile.x, tile.y, tile.z};
    finish_in_air(scene, air, chords(sun, ray), behind_tile(up, behind, tile), tile, to);
}

#define AWAN_KERNELS(name, attribute)                                                            \
    attribute void rays_##name(const BlockFrame& frame, const float* x, const float* y,          \
                               Floats* to) {                                                     \
        rays_body(frame, x, y, to);                                                              \
    }                                                                                            \
    attribute void phases_##name(const MarchScene& scene, const SunInBlock& sun, Tile& tile,     \
                                 Floats* rows) {                                                 \
        phases_body(scene, sun, tile, rows);                                                     \
    }                                                                                            \
    attribute void finish_##name(const MarchScene& scene, const float* up,                       \
                                 const BehindPixels& behind, const Tile& tile, float(*to)[4]) {  \
        finish_body(scene, up, behind, tile, to);                                                \
    }                                                                                            \
    attribute void finish_air_##name(                                                            \
        const MarchScene& scene, const AirTile& air, const SunInBlock& sun, const float* up,     \
        const BehindPixels& behind, const Tile& tile, float(*to)[4]) {                           \
        finish_air_body(scene, air, sun, up, behind, tile, to);                                  \
    }                                                                                            \
    attribute void measure_##name(const BlockParticles& p, const Floats* ray,                    \
                                  const Floats& spread, ActiveParticle& a) {                     \
        measure_body(p, ray, spread, a);                                                         \
    }                                                                                            \
    attribute void ratio_##name(const BlockParticles& p, float step,                             \
                                std::vector<ActiveParticle>& active) {                           \
        ratio_body(p, step, active);                                                             \
    }                                                                                            \
    attribute void deposit_##name(const BlockParticles& p,                                       \
                                  const std::vector<ActiveParticle>& active, const Chunk& chunk, \
                                  const Bilinear* between, WideRays& wide, Tile* tiles) {        \
        deposit_all(p, active, chunk, between, wide, tiles);                                     \
    }                                                                                            \
    attribute void detail_##name(const DetailRays& rays, const Chunk& chunk, Tile* tiles) {      \
        detail_body(rays, chunk, tiles);                                                         \
    }                                                                                            \
    attribute int too_deep_##name(const Tile& tile, float scaled, float allowed) {               \
        return first_too_deep(tile, scaled, allowed);                                            \
    }                                                                                            \
    attribute void spread_##name(const Bilinear& b, const LightAt(*corners)[kChunk + 2],         \
                                 int first, int last, bool albedo, bool air, TileLight& light) { \
        spread_light(b, corners, first, last, albedo, air, light);                               \
    }                                                                                            \
    attribute void march_##name(const Shade& shade, const TileLight& light, int count,           \
                                Tile& tile) {                                                    \
        march_tile<false>(shade, light, count, tile);                                            \
    }                                                                                            \
    attribute void march_haze_##name(const Shade& shade, const TileLight& light, int count,      \
                                     Tile& tile) {                                               \
        march_tile<true>(shade, light, count, tile);                                             \
    }                                                                                            \
    constexpr MarchKernels kKernels_##name{rays_##name,       phases_##name,  finish_##name,     \
                                           finish_air_##name, measure_##name, ratio_##name,      \
                                           deposit_##name,    detail_##name,  too_deep_##name,   \
                                           spread_##name,     march_##name,   march_haze_##name};

AWAN_KERNELS(plain, )
#if defined(__x86_64__)
AWAN_KERNELS(avx2, [[gnu::target("avx2")]])
AWAN_KERNELS(avx512, [[gnu::target("avx512f")]])
#endif
#undef AWAN_KERNELS

}  // namespace

const MarchKernels& march_kernels() {
#if defined(__x86_64__)
    switch (instruction_set()) {
        case InstructionSet::kAvx512:
            return kKernels_avx512;
        case InstructionSet::kAvx2:
            return kKernels_avx2;
        case InstructionSet::kPlain:
            break;
    }
#endif
    return kKernels_plain;
}

}  // namespace awan
