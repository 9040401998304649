#include "core/draw/air.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {

PictureRays picture_rays(const View& view, int width, int height) {
    const double tan = view.tan_half_fov, wide = tan * view.aspect;
    return {view.eye,
            view.forward - wide * view.right + tan * view.up,
            view.right * (2 * wide / width),
            view.up * (-2 * tan / height),
            width,
            height};
}

std::optional<Air> make_air(const Scene& scene, const View& view) {
    if (!scene->haze || !(scene->haze->extinction > 0)) return std::nullopt;
    Air air;
    air.haze = *scene->haze;
    air.picture = picture_rays(view, scene->image.width, scene->image.height);
    air.ground = -std::numeric_limits<double>::infinity();
    if (scene->ground && view.eye.y > scene->ground->height) air.ground = scene->ground->height;
    air.up = vertical_haze_depth(air.haze, view.eye.y, std::numeric_limits<double>::infinity());
    air.down = vertical_haze_depth(air.haze, air.ground, view.eye.y);
    const Outside outside = outside_of(scene);
    const SkyMeans sky = means_of(outside.sky);
    air.to_sun = outside.to_sun;
    glm::dvec3 sun = outside.sun, below = sky.below;
    if (scene->ground) {
        if (outside.to_sun.y < 0) sun = glm::dvec3(0);
        below = scene->ground->albedo / std::numbers::pi *
                (sun * std::max(outside.to_sun.y, 0.0) + sky.irradiance_up);
    }
    air.sun = air.haze.albedo * sun;
    air.ambient = air.haze.albedo * 0.5 * (sky.above + below);
    Medium medium;
    medium.g = air.haze.g;
    medium.phase = PhaseFunction::kHenyeyGreenstein;
    air.phase = {medium, {}};
    return air;
}

void shade_air(const SunDepth& sun, int threads, Air& air) {
    if (air.sun != glm::dvec3(0))
        air.shadows = air_shadows(air.picture, air.haze, air.ground, sun, threads);
}

AirBefore air_before(const Air& air, const HazeRay& ray, double x, double y, double t) {
    AirBefore before{ray.opacity(t), 0};
    if (air.shadows.spacing > 0)
        before.lost = before.opacity * lost_at(air.shadows, x, y, t, before.opacity);
    return before;
}

AirBefore whole_air(const Air& air, double slope, double x, double y) {
    const double through = slope < 0 ? air.down : air.up;
    AirBefore before{
        through > 0 ? -exact::expm1(-through / std::max(std::abs(slope), 1e-300)) : 0.0, 0};
    if (air.shadows.spacing > 0)
        before.lost = std::min(whole_lost(air.shadows, x, y), before.opacity);
    return before;
}

glm::dvec3 in_scattering(const Air& air, const glm::dvec3& direction, const AirBefore& before) {
    const double p = rest_of_phase(air.phase, glm::length(direction - air.to_sun),
                                   glm::length(direction + air.to_sun));
    return air.ambient * before.opacity + air.sun * (p * (before.opacity - before.lost));
}

}  // namespace awan
