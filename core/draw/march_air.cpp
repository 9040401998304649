#include "core/draw/march_air.h"

#include <glm/geometric.hpp>

namespace awan {
namespace {

// Most difference of heights between rays that the haze is interpolated between, in scale heights.
constexpr double kApart = 0.3;

}  // namespace

void air_along(const Air& air, double x, double y, double first, double step, int count,
               LightAt* out) {
    const PictureRays& picture = air.picture;
    const glm::dvec3 d = glm::normalize(picture.corner + x * picture.per_x + y * picture.per_y);
    const HazeRay ray(air.haze, picture.eye.y, d.y);
    double opacity[kChunk];
    ray.opacities(first, step, count, opacity);
    const bool shaded = air.shadows.spacing > 0;
    for (int k = 0; k < count; ++k) {
        out[k].air = static_cast<float>(opacity[k]);
        const double lost =
            shaded ? opacity[k] * lost_at(air.shadows, x, y, first + k * step, opacity[k]) : 0;
        out[k].lost = static_cast<float>(lost);
    }
}

double farthest_for_air(const Air& air, double apart) {
    return kApart * air.haze.scale_height / apart;
}

AirTile air_tile(const Air& air, const TilePlace& place) {
    AirTile tile{};
    tile.up = static_cast<float>(air.up);
    tile.down = static_cast<float>(air.down);
    for (int c = 0; c < 3; ++c) {
        tile.sun[c] = static_cast<float>(air.sun[c]);
        tile.ambient[c] = static_cast<float>(air.ambient[c]);
    }
    if (air.shadows.spacing > 0)
        for (int lane = 0; lane < simd::kLanes; ++lane)
            tile.lost[lane] =
                static_cast<float>(whole_lost(air.shadows, place.ray_x(lane), place.ray_y(lane)));
    return tile;
}

}  // namespace awan
