#include "core/draw/air_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace awan {

float see_through_air(const Air& air, const View& view, const glm::dvec3& q, Splat& splat) {
    const double distance = glm::length(q);
    const glm::dvec3 d = distance > 0
                             ? (q.x * view.right + q.y * view.up + q.z * view.forward) / distance
                             : view.forward;
    // A splat behind the eye (its far side may be seen) is taken to be in the picture's middle.
    double x = 0.5 * air.picture.width, y = 0.5 * air.picture.height;
    if (q.z > 1e-9 * distance) {
        x *= 1 + q.x / (q.z * view.tan_half_fov * view.aspect);
        y *= 1 - q.y / (q.z * view.tan_half_fov);
    }
    const HazeRay ray(air.haze, air.picture.eye.y, d.y);
    const AirBefore before = air_before(air, ray, x, y, distance);
    const glm::dvec3 veil = in_scattering(air, d, before);
    const auto clear = static_cast<float>(1 - before.opacity);
    for (int c = 0; c < 3; ++c) {
        splat.matter[c] *= clear;
        splat.other[c] *= clear;
    }
    // A splat has one factor for all of `other`: the mean of its own and of 1, the veil's, weighted by their light.
    const float own = splat.other.x + splat.other.y + splat.other.z;
    const auto veiled = static_cast<float>(veil.x + veil.y + veil.z);
    if (!(veiled > 0)) return 0;
    const float share = own / (own + veiled);
    for (int c = 0; c < 3; ++c) splat.other[c] += static_cast<float>(veil[c]);
    splat.other.w = share * splat.other.w + (1 - share);
    return 1 - share;
    splat.change *= share;
    splat.change.w += 1 - share;
}

void put_air_behind(const Air& air, const Backdrop* backdrop, Image& image) {
    const PictureRays& picture = air.picture;
    float* pixel = image.pixels.data();
    for (int j = 0; j < image.height; ++j)
        for (int i = 0; i < image.width; ++i, pixel += 4) {
            const double x = i + 0.5, y = j + 0.5;
            const glm::dvec3 d =
                glm::normalize(picture.corner + x * picture.per_x + y * picture.per_y);
            AirBefore before = whole_air(air, d.y, x, y);
            double seen = 1 - before.opacity;
            if (backdrop != nullptr && !backdrop->opacity.empty()) {
                const std::size_t at =
                    static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(i);
                before = {static_cast<double>(backdrop->opacity[at]),
                          static_cast<double>(backdrop->lost[at])};
                seen = 1;
            }
            const double left = 1 - static_cast<double>(pixel[3]), clear = 1 - before.opacity;
            glm::dvec3 light = in_scattering(air, d, before);
            if (backdrop != nullptr && image.opaque) {
                const std::size_t at =
                    3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(i));
                const float* const rgb = backdrop->rgb.data() + at;
                for (int c = 0; c < 3; ++c) light[c] += seen * static_cast<double>(rgb[c]);
            }
            for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(left * light[c]);
            pixel[3] = image.opaque ? 1.0f : static_cast<float>(1 - left * clear);
        }
}

}  // namespace awan
