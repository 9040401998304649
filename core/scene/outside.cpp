#include "core/scene/outside.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "core/base/exact_math.h"

namespace awan {

double luminance(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

namespace {

Outside outside_under(const SceneDraft& scene, std::shared_ptr<const AirSky> air) {
    Outside outside;
    outside.to_sun = sun_direction(scene.sun);
    const Sky& sky = scene.sky;
    if (scene.sun.auto_color) {
        glm::dvec3 color =
            sunlight(exact::asin(std::clamp(outside.to_sun.y, -1.0, 1.0)), sky.turbidity);
        if (scene.effects[static_cast<int>(Effect::kSunColor)] == Switch::kOff)
            color = glm::dvec3(luminance(color));
        outside.sun = scene.sun.intensity * color;
    } else {
        outside.sun = scene.sun.intensity * scene.sun.color;
    }
    if (scene.ground && outside.to_sun.y < 0) outside.sun = glm::dvec3(0);
    SkyDome& dome = outside.sky;
    dome.physical = sky.physical;
    if (sky.none) return outside;
    if (sky.physical) {
        dome.clear = clear_sky(outside.to_sun, sky.turbidity);
        // The model's luminance is relative to the sun's.
        dome.intensity = sky.intensity * scene.sun.intensity * (air ? 1 : kPreethamShare);
        dome.shines = dome.intensity > 0 && (air ? air->shines : dome.clear.dimmed > 0);
        dome.air = std::move(air);
    } else {
        dome.zenith = sky.zenith * sky.intensity;
        dome.horizon = sky.horizon * sky.intensity;
        dome.shines = dome.zenith != glm::dvec3(0) || dome.horizon != glm::dvec3(0);
    }
    return outside;
}

}  // namespace

std::shared_ptr<const AirSky> air_of(const SceneDraft& scene) {
    const Sky& sky = scene.sky;
    if (sky.none || !sky.physical || sky.daylight != Daylight::kScattered) return nullptr;
    const glm::dvec3 to_sun = sun_direction(scene.sun);
    if (sky.air && sky.air->to_sun == to_sun && sky.air->turbidity == sky.turbidity) return sky.air;
    return std::make_shared<const AirSky>(air_sky(to_sun, sky.turbidity));
}

Outside outside_of(const SceneDraft& scene) {
    return outside_under(scene, air_of(scene));
}

Outside outside_of(const Scene& scene) {
    return outside_under(*scene, scene->sky.air);
}

glm::dvec3 physical_radiance(const SkyDome& sky, const glm::dvec3& direction) {
    return sky.intensity *
           (sky.air ? radiance(*sky.air, direction) : radiance(sky.clear, direction));
}

glm::dvec3 sky_radiance(const SkyDome& sky, const glm::dvec3& direction) {
    if (!sky.shines) return glm::dvec3(0);
    if (sky.physical) return physical_radiance(sky, direction);
    const double up = std::max(direction.y, 0.0);
    return glm::mix(sky.horizon, sky.zenith, 1.09 * up * up / (up * up + 0.09));
}

SkyMeans means_of(const SkyDome& sky, int steps) {
    SkyMeans means;
    if (!sky.shines) return means;
    const int around = 2 * steps;
    const double share = 1.0 / (steps * around);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < around; ++j) {
            const double up = (i + 0.5) / steps, side = std::sqrt(1 - up * up);
            const double turn = 2 * std::numbers::pi * (j + 0.5) / around;
            const glm::dvec3 d(side * exact::sin(turn), up, side * exact::cos(turn));
            const glm::dvec3 from_above = share * sky_radiance(sky, d);
            means.above += from_above;
            means.irradiance_up += 2 * std::numbers::pi * up * from_above;
            means.below += share * sky_radiance(sky, {d.x, -d.y, d.z});
        }
    return means;
}

}  // namespace awan
