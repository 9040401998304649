#include "core/looks/ostroushko_shade.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/light/ground_light.h"

namespace awan::looks {
namespace {

// Waves of the relief on a sphere.
constexpr int kWaves = 3;
// Their largest frequency along each axis, radians over the radius.
constexpr double kSteepest = 4;

// 16 of the bits as a number in -1..1.
double part(std::uint64_t bits, int from) {
    return static_cast<double>(bits >> from & 0xffffu) / 0x8000 - 1;
}

}  // namespace

LookLight look_light(const Scene& scene) {
    LookLight light;
    const Outside outside = outside_of(scene);
    light.to_sun = outside.to_sun;
    light.sun = outside.sun / std::numbers::pi;
    const SkyMeans sky = means_of(outside.sky, 12);
    light.above = sky.above;
    light.below = sky.below;
    if (scene->ground)
        light.below = scene->ground->albedo * (light.sun * std::max(light.to_sun.y, 0.0) +
                                               sky.irradiance_up / std::numbers::pi);
    // Light that is scattered forward goes on. By similarity, the depth that counts is (1 - albedo g) of it.
    light.softened = 1 - scene->medium.albedo * std::max(asymmetry(scene->medium), 0.0);
    light.albedo = scene->medium.albedo;
    return light;
}

glm::dvec3 bumped(const glm::dvec3& normal, std::uint64_t key, double height) {
    glm::dvec3 slope(0);
    for (std::uint64_t i = 0; i < kWaves; ++i) {
        const std::uint64_t bits = keyed(key, i);
        const glm::dvec3 wave =
            kSteepest * glm::dvec3(part(bits, 0), part(bits, 16), part(bits, 32));
        const double phase = std::numbers::pi * part(bits, 48);
        slope += height * exact::seeded_sin(glm::dot(wave, normal) + phase) * wave;
    }
    slope -= glm::dot(slope, normal) * normal;
    return glm::normalize(normal - slope);
}

glm::dvec3 bumped(const LookCloud& cloud, const glm::dvec3& normal, std::uint64_t key) {
    const Relief& relief = cloud.relief;
    if (!relief.given()) return bumped(normal, key, relief.bump.height);
    const glm::dmat3& rotation = cloud.tree.rotation();
    const glm::dvec3 own = glm::transpose(rotation) * turned_back(cloud, normal);
    return turned(cloud, rotation * turned_normal(relief, own, key));
}

Reaching reaching(const std::vector<LookCloud>& clouds, const LookLight& light,
                  const glm::dvec3& point) {
    return {light_through(clouds, point, light.to_sun, light.softened),
            light_through(clouds, point, {0, 1, 0}, light.softened)};
}

glm::dvec3 shade(const LookLight& light, const Reaching& share, const glm::dvec3& normal) {
    // Light comes round a ball of cloud: half of it at its limb, none at its back.
    const double facing = (1 + glm::dot(normal, light.to_sun)) / 2;
    const double up = (1 + normal.y) / 2;
    return light.albedo *
           (share.sun * facing * light.sun + share.sky * up * light.above + (1 - up) * light.below);
}

}  // namespace awan::looks
