#include "core/survey/ground_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/scene/outside.h"
#include "core/survey/gauss.h"
#include "core/survey/raster_ray.h"
#include "core/survey/relief_ray.h"
#include "core/survey/volume.h"

namespace awan {
namespace {

constexpr int kAcross = 24, kDown = 18;

// Optical depth along a line through the volume, in steps of half a cell.
double depth_through(const DensityVolume& volume, const glm::dvec3& from, const glm::dvec3& d) {
    if (!(volume.cell > 0)) return 0;
    const glm::dvec3 p = (from - volume.origin) / volume.cell;
    double enter = 0, leave = 1e300;
    for (int a = 0; a < 3; ++a) {
        const double by = std::abs(d[a]) < 1e-12 ? 1e-12 : d[a];
        const double t0 = -p[a] / by, t1 = (volume.cells[a] - p[a]) / by;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    if (!(enter < leave)) return 0;
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * (leave - enter))));
    const double step = (leave - enter) / steps;
    double depth = 0;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 at = p + (enter + (i + 0.5) * step) * d;
        depth += extinction_of_cell(volume, at) * step * volume.cell;
    }
    return depth;
}

}  // namespace

bool reaches_below(const ParticleSet& particles, double height) {
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles.center[i].y - kGaussianCut * gaussian_s(particles, i) < height) return true;
    return false;
}

GroundView ground_view(const Scene& scene, const ParticleSet& particles, const Survey& survey,
                       int threads) {
    GroundView ground;
    if (!scene->ground || !(survey.bounds.max.y > scene->ground->height)) return ground;
    const double height = scene->ground->height;
    ground.matter_below = reaches_below(particles, height);

    const Outside outside = outside_of(scene);
    const SkyMeans sky = means_of(outside.sky);
    const double direct = luminance(outside.sun) * std::max(outside.to_sun.y, 0.0);
    const double open = luminance(sky.irradiance_up);
    const double incoming = luminance(outside.sun) + 2 * std::numbers::pi * luminance(sky.above);
    // Radiance albedo / pi * irradiance, from a hemisphere.
    if (incoming > 0)
        ground.light = 2 * luminance(scene->ground->albedo) * (direct + open) / incoming;

    const View& view = survey.view;
    if (!(view.eye.y > height)) return ground;
    const bool by_sun = direct > 0;
    const glm::dvec3 towards = by_sun ? outside.to_sun : glm::dvec3(0, 1, 0);
    const double share = direct + open > 0 ? (by_sun ? direct / (direct + open) : 1.0) : 0.0;
    const auto relief = relief_of(*scene, threads);
    int met = 0, hills = 0;
    for (int j = 0; j < kDown; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const glm::dvec3 d = raster_ray(view, kAcross, kDown, i, j);
            const double t = relief    ? ground_ahead(*relief, view.eye, d)
                             : d.y < 0 ? (height - view.eye.y) / d.y
                                       : std::numeric_limits<double>::infinity();
            if (std::isinf(t)) continue;
            ++met;
            if (relief && view.eye.y + t * d.y > height + 1e-3 * relief->highest) ++hills;
            const glm::dvec3 p = view.eye + t * d;
            const double depth = depth_through(survey.volume, p, towards);
            ground.shade = std::max(ground.shade, share * -exact::expm1(-depth));
        }
    ground.seen = static_cast<double>(met) / (kAcross * kDown);
    ground.hills = static_cast<double>(hills) / (kAcross * kDown);
    return ground;
}

}  // namespace awan
