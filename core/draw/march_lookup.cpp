#include "core/draw/march_lookup.h"

#include <algorithm>
#include <cmath>

#include "core/draw/march_air.h"

namespace awan {
namespace {

// Largest change of depth towards the sun within a step, over the largest depth of a step towards the eye. 1 would
// halve what is left of the step error in a flat sheet under a low sun, and double the time of a cumulus.
constexpr float kRise = 2.5f;
constexpr float kDark = 7.0f;  // scaled depth towards the sun behind which the beam is not seen
// Rays that differ more (difference of directions) are too far apart at any distance.
constexpr double kMostApart = 0.2;

// The ray through a point of the picture (pixels), from a distance on.
LightRay ray_through(const MarchScene& scene, double x, double y, double distance) {
    const glm::dvec3 d = pixel_direction(scene, x, y);
    return light_ray(scene.light, scene.view.eye + distance * d, d);
}

// Light of samples first..last and one more at either end: out[0] is that before the first.
void look_up(const MarchScene& scene, double x, double y, const SampleRange& samples,
             LightAt* out) {
    const auto h = static_cast<float>(samples.step);
    light_along(scene.light, ray_through(scene, x, y, samples.base),
                (static_cast<float>(samples.first) - 0.5f) * h, h, samples.last - samples.first + 3,
                out);
}

void look_up_air(const MarchScene& scene, double x, double y, const SampleRange& samples,
                 LightAt* out) {
    const int count = samples.last - samples.first + 1;
    for (int k = 0; scene.measures && k < count; ++k)
        out[k + 1].air =
            static_cast<float>(samples.base + (samples.first + k + 0.5) * samples.step);
    if (scene.air == nullptr || scene.measures) return;
    air_along(*scene.air, x, y, samples.base + (samples.first + 0.5) * samples.step, samples.step,
              count, out + 1);
}

}  // namespace

bool has_matter(const Tile& tile, int count) {
    return tile.alive && tile.first <= std::min(tile.last, count - 1);
}

int choose_spacing(const MarchScene& scene, double distance, double apart) {
    for (int s = 0; s < kSpacingCount; ++s)
        if (distance <= farthest(scene, s, apart)) return s;
    return -1;
}

double farthest(const MarchScene& scene, int spacing, double apart) {
    if (spacing < 0) return 1e300;
    // Difference of directions in the middle of the picture, where it is the largest.
    const double angle = kSpacings[spacing] * 2 * scene.view.tan_half_fov / scene.height;
    if (!(angle <= kMostApart)) return 0;
    if (scene.air != nullptr) return std::min(apart / angle, farthest_for_air(*scene.air, angle));
    return apart / angle;
}

void look_up_corners(const MarchScene& scene, const PlacedBlock& block, const SampleRange& samples,
                     int spacing, BlockRoom& room) {
    bool needed[kMostCorners] = {};
    for (int t = 0; t < kTiles; ++t)
        if (has_matter(room.tiles[t], samples.count))
            for (const int c : room.bilinear[spacing][t].corner) needed[c] = true;
    const int apart = kSpacings[spacing], side = kBlockSide / apart + 1;
    for (int c = 0; c < side * side; ++c) {
        if (!needed[c]) continue;
        const double x = block.left + c % side * apart, y = block.top + c / side * apart;
        LightAt* const out = room.corners[c] + samples.first;
        look_up(scene, x, y, samples, out);
        look_up_air(scene, x, y, samples, out);
    }
}

void look_up_pixels(const MarchScene& scene, int tile, const SampleRange& samples,
                    BlockRoom& room) {
    LightAt at[kChunk + 2];
    TileLight& light = room.light;
    for (int lane = 0; lane < simd::kLanes; ++lane) {
        const double x = room.places[tile].ray_x(lane), y = room.places[tile].ray_y(lane);
        look_up(scene, x, y, samples, at);
        look_up_air(scene, x, y, samples, at);
        for (int k = samples.first; k <= samples.last + 2; ++k) {
            const LightAt& here = at[k - samples.first];
            light.depth[k][lane] = here.depth;
            light.air[k][lane] = here.air;
            light.lost[k][lane] = here.lost;
            for (int c = 0; c < 3; ++c) {
                light.source[c][k][lane] = here.source[c];
                light.albedo[c][k][lane] = here.albedo[c];
            }
        }
    }
}

int first_too_shaded(const MarchScene& scene, const PlacedBlock& block,
                     const SampleRange& samples) {
    if (samples.first > samples.last) return kChunk;
    LightAt at[kChunk + 2];
    look_up(scene, block.middle_x, block.middle_y, samples, at);
    const float allowed = kRise * scene.step_depth / scene.scaled;
    for (int k = samples.first; k <= samples.last; ++k) {
        const LightAt* const sample = at + (k - samples.first);
        if (sample[1].depth * scene.scaled > kDark) continue;
        if (0.5f * std::abs(sample[2].depth - sample[0].depth) > allowed) return k;
    }
    return kChunk;
}

}  // namespace awan
