#include "core/looks/ostroushko_relief.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/generate/own_textures.h"

namespace awan::looks {
namespace {

using std::numbers::pi;

// How near a pole u goes no faster, as the sine of the angle from it.
constexpr double kNearPole = 0.05;

// The texture's depth at x, y in its sides, which it repeats itself beyond: 0..1, between four points.
double depth_at(const Texture& texture, double x, double y) {
    const auto part = [](double at) { return (at - std::floor(at)) * kTextureSide - 0.5; };
    const double px = part(x), py = part(y);
    const double fx = px - std::floor(px), fy = py - std::floor(py);
    const auto point = [&](int dx, int dy) {
        const auto wrapped = [](double p, int d) {
            const int i = static_cast<int>(std::floor(p)) + d;
            return static_cast<std::size_t>((i + kTextureSide) % kTextureSide);
        };
        return static_cast<double>(
            texture
                .depth[wrapped(py, dy) * static_cast<std::size_t>(kTextureSide) + wrapped(px, dx)]);
    };
    return ((1 - fy) * ((1 - fx) * point(0, 0) + fx * point(1, 0)) +
            fy * ((1 - fx) * point(0, 1) + fx * point(1, 1))) /
           255;
}

double turns_of(const SpheresWave& wave, double u, double v) {
    return static_cast<double>(wave.around) * u + wave.down * v + wave.phase;
}

// How fast the height goes up along u and along v.
struct Slope {
    double u = 0, v = 0;
};

Slope slope_at(const Relief& relief, double u, double v) {
    Slope slope;
    for (const SpheresWave& wave : relief.bump.waves) {
        const double steep = relief.bump.height * wave.amplitude * 2 * pi *
                             exact::sincos_degrees(360 * turns_of(wave, u, v)).cos;
        slope.u += steep * static_cast<double>(wave.around);
        slope.v += steep * wave.down;
    }
    if (relief.texture == nullptr) return slope;
    // Over a point of the texture to either side.
    const double across = 1.0 / kTextureSide;
    const auto repeat = static_cast<double>(relief.bump.repeat);
    const double x = repeat * u, y = 0.5 * repeat * v;
    const Texture& texture = *relief.texture;
    const double by = relief.bump.height * repeat / (2 * across);
    slope.u += by * (depth_at(texture, x + across, y) - depth_at(texture, x - across, y));
    slope.v += 0.5 * by * (depth_at(texture, x, y + across) - depth_at(texture, x, y - across));
    return slope;
}

}  // namespace

Relief relief_of(const SceneDraft& scene, const SpheresCloud& cloud) {
    Relief relief;
    if (!cloud.bump) return relief;
    relief.bump = *cloud.bump;
    if (cloud.bump->texture)
        relief.texture = texture_of_hash(scene, find_texture(scene, *cloud.bump->texture));
    return relief;
}

double height_at(const Relief& relief, double u, double v) {
    double height = 0;
    for (const SpheresWave& wave : relief.bump.waves)
        height += wave.amplitude * exact::sincos_degrees(360 * turns_of(wave, u, v)).sin;
    if (relief.texture != nullptr) {
        const auto repeat = static_cast<double>(relief.bump.repeat);
        height += depth_at(*relief.texture, repeat * u, 0.5 * repeat * v);
    }
    return relief.bump.height * height;
}

glm::dvec3 turned_normal(const Relief& relief, const glm::dvec3& normal, std::uint64_t key) {
    const double y = std::clamp(normal.y, -1.0, 1.0);
    const double away = std::max(std::sqrt(1 - y * y), kNearPole);
    const double own = unit_open(static_cast<std::uint32_t>(keyed(key, 0) >> 32));
    const double u = exact::atan2(normal.z, normal.x) / (2 * pi) + own;
    const double v = exact::acos(y) / pi;
    const Slope slope = slope_at(relief, u, v);
    // Along the parallel and down the meridian, a unit of u or v is so long.
    const glm::dvec3 along = glm::dvec3(-normal.z, 0, normal.x) / away;
    const glm::dvec3 down = glm::dvec3(normal.x * y, y * y - 1, normal.z * y) / away;
    const glm::dvec3 gradient = slope.u / (2 * pi * away) * along + slope.v / pi * down;
    return glm::normalize(normal - gradient);
}

}  // namespace awan::looks
