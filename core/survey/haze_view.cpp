#include "core/survey/haze_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/survey/haze_depth.h"
#include "core/survey/outside_light.h"
#include "core/survey/raster_ray.h"
#include "core/survey/relief_ray.h"
#include "core/survey/volume.h"

namespace awan {
namespace {

constexpr int kRaysAcross = 16, kRaysDown = 12, kPoints = 32;
constexpr int kSkySteps = 48;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Optical depth from which a ray meets clouds.
constexpr double kSeen = 0.01;

// Part of origin + t direction, t in from..to, inside of the volume.
bool clip(const DensityVolume& volume, const glm::dvec3& origin, const glm::dvec3& direction,
          double& from, double& to) {
    const glm::dvec3 size = glm::dvec3(volume.cells) * volume.cell;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = volume.origin[axis] - origin[axis], by = direction[axis];
        if (by == 0) {
            if (at > 0 || at + size[axis] < 0) return false;
            continue;
        }
        from = std::max(from, std::min(at / by, (at + size[axis]) / by));
        to = std::min(to, std::max(at / by, (at + size[axis]) / by));
    }
    return from < to;
}

double extinction_in(const DensityVolume& volume, const glm::dvec3& p) {
    return extinction_of_cell(volume, (p - volume.origin) / volume.cell);
}

// Optical depth of the clouds from p on, by steps of about a cell; stops where nothing is seen any more.
double depth_towards(const DensityVolume& volume, const glm::dvec3& p,
                     const glm::dvec3& direction) {
    double from = 0, to = kInfinity;
    if (!clip(volume, p, direction, from, to)) return 0;
    const int steps = std::clamp(static_cast<int>((to - from) / (1.5 * volume.cell)), 1, 48);
    const double step = (to - from) / steps;
    double depth = 0;
    for (int i = 0; i < steps && depth < 8; ++i)
        depth += step * extinction_in(volume, p + (from + (i + 0.5) * step) * direction);
    return depth;
}

// What lights the haze and, by a guess, the clouds in it. Luminances.
struct Lights {
    double sun;  // irradiance
    // Mean radiance from all directions.
    double ambient;
    double cloud;  // radiance of a lit cloud
    glm::dvec3 to_sun;
    SkyDome sky;
};

Lights lights_of(const Scene& scene) {
    const OutsideLight light = outside_light(scene, kSkySteps);
    // A ground keeps a sun below it from the haze.
    const bool under = scene->ground && light.outside.to_sun.y < 0;
    return {under ? 0 : luminance(light.outside.sun), light.sky, under ? light.sky : light.all(),
            light.outside.to_sun, light.outside.sky};
}

double henyey_greenstein(double g, double cosine) {
    const double base = std::max(1 + g * g - 2 * g * cosine, 1e-12);
    return (1 - g * g) / (4 * std::numbers::pi * base * std::sqrt(base));
}

// One ray: its pixel's luminance without shadows in the haze, and what these take from it.
struct RayFigures {
    double pixel = 0, taken = 0, to_clouds = 0, behind = 0;
};

// Where the haze ends on a ray.
double end_of(const Relief* relief, double ground, const View& view, const glm::dvec3& d) {
    if (!(view.eye.y > ground)) return kInfinity;
    if (relief != nullptr) return ground_ahead(*relief, view.eye, d);
    return d.y < 0 ? (view.eye.y - ground) / -d.y : kInfinity;
}

RayFigures look_along(const Haze& haze, double end, const Lights& lights, const Survey& survey,
                      const glm::dvec3& d) {
    const View& view = survey.view;
    const DensityVolume& volume = survey.volume;
    const HazeRay ray(haze, view.eye.y, d.y);
    const double p = henyey_greenstein(haze.g, glm::dot(d, lights.to_sun));
    const double albedo = luminance(haze.albedo);
    RayFigures figures;
    figures.behind = ray.depth(end);
    // Points even in the haze's opacity would crowd at the eye: even in distance instead, out to well behind the
    // clouds.
    const glm::dvec3 half = 0.5 * glm::dvec3(volume.cells) * volume.cell;
    const double reach =
        std::min(end, glm::length(volume.origin + half - view.eye) + 2 * glm::length(half));
    const double step = reach / kPoints;
    double clouds = 0, before = 0;
    const bool shines = lights.sun > 0 && haze.extinction > 0;
    for (int i = 0; i < kPoints; ++i) {
        const double t = (i + 0.5) * step;
        const glm::dvec3 at = view.eye + t * d;
        const double after = ray.opacity((i + 1) * step), middle = ray.opacity(t);
        const double through = exact::exp(-clouds);
        if (shines && through > 1e-3 && after > before) {
            const double lit = exact::exp(-depth_towards(volume, at, lights.to_sun));
            const double sun = through * (after - before) * albedo * lights.sun * p;
            figures.pixel += sun;
            figures.taken += sun * (1 - lit);
        }
        const glm::dvec3 off = (at - volume.origin) / volume.cell;
        const bool inside = std::min({off.x, off.y, off.z}) >= 0 && off.x < volume.cells.x &&
                            off.y < volume.cells.y && off.z < volume.cells.z;
        const double depth = inside ? extinction_in(volume, at) * step : 0;
        const double alpha = through * -exact::expm1(-depth);
        figures.pixel += alpha * (1 - middle) * lights.cloud;
        figures.pixel += through * (after - before) * albedo * lights.ambient;
        if (clouds <= kSeen && clouds + depth > kSeen) figures.to_clouds = ray.depth(t);
        clouds += depth;
        before = after;
    }
    figures.pixel += exact::exp(-clouds) * (1 - before) * luminance(sky_radiance(lights.sky, d));
    return figures;
}

}  // namespace

HazeFigures haze_figures(const Scene& scene, const Survey& survey) {
    HazeFigures figures;
    if (!scene->haze || !(scene->haze->extinction > 0)) return figures;
    const Lights lights = lights_of(scene);
    const double ground = scene->ground && survey.view.eye.y > scene->ground->height
                              ? scene->ground->height
                              : -kInfinity;
    const View& view = survey.view;
    const auto relief = relief_of(*scene, 1);
    double pixels = 0, taken = 0;
    const bool matter = !survey.volume.extinction.empty();
    for (int j = 0; j < kRaysDown; ++j)
        for (int i = 0; i < kRaysAcross; ++i) {
            const glm::dvec3 d = raster_ray(view, kRaysAcross, kRaysDown, i, j);
            const double end = end_of(relief.get(), ground, view, d);
            if (!matter) {
                figures.depth_behind = std::max(figures.depth_behind,
                                                HazeRay(*scene->haze, view.eye.y, d.y).depth(end));
                continue;
            }
            const RayFigures ray = look_along(*scene->haze, end, lights, survey, d);
            figures.depth_to_clouds = std::max(figures.depth_to_clouds, ray.to_clouds);
            figures.depth_behind = std::max(figures.depth_behind, ray.behind);
            pixels += ray.pixel;
            taken = std::max(taken, ray.taken);
        }
    figures.depth_behind = std::min(figures.depth_behind, kMostHazeDepth);
    figures.depth_to_clouds = std::min(figures.depth_to_clouds, kMostHazeDepth);
    if (pixels > 0) figures.shaded = taken * (kRaysAcross * kRaysDown) / pixels;
    return figures;
}

}  // namespace awan
