#include "core/plan/forecast_figures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/plan/transport_settings.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

double longest_side(const Survey& survey) {
    const glm::dvec3 size = survey.bounds.max - survey.bounds.min;
    return std::max({size.x, size.y, size.z, 1e-12});
}

double mean_s(const Survey& survey) {
    return survey.s_sums[2] > 0 ? survey.s_sums[3] / survey.s_sums[2] : 1;
}

// Of the light that reaches a cloud from all sides.
double sun_share(const Scene& scene) {
    const auto grey = [](const glm::dvec3& c) { return (c.x + c.y + c.z) / 3; };
    const Outside outside = outside_of(scene);
    const SkyDome& dome = outside.sky;
    const double sun = grey(outside.sun) / (4 * std::numbers::pi);
    double sky = grey(0.67 * dome.zenith + 1.33 * dome.horizon) / 2;
    if (dome.physical) {
        const SkyMeans means = means_of(dome, 8);
        sky = grey(means.above + means.below) / 2;
    }
    return sun + sky > 0 ? sun / (sun + sky) : 0;
}

// Cell updates of a lattice with `cells` along its longest side (survey/lattice.h), by the sums over all particles.
double updates(const Survey& survey, int cells) {
    if (cells == 0) return 0;
    const double h = longest_side(survey) / cells, side = 8 / h;
    const auto& sum = survey.s_sums;
    const double expanded =
        side * side * side * sum[3] + 3 * side * side * sum[2] + 3 * side * sum[1] + sum[0];
    return std::min(expanded, static_cast<double>(survey.particles) * std::pow(cells, 3));
}

}  // namespace

ErrorFigures error_figures(const Rung& rung, const Scene& scene, const Survey& survey) {
    const double g = scene->medium.g, f = g > 0 ? g * g * g * g : 0;
    const double depth = std::clamp(survey.optical_depth_eye, 1e-6, 1e6);
    double cell_depth = 0, coarseness = 0;
    if (rung.cells > 0) {
        const double cell = longest_side(survey) / rung.cells;
        cell_depth =
            std::clamp(survey.max_extinction * (1 - scene->medium.albedo * f) * cell, 0.0, 1e6);
        coarseness = std::clamp(std::log2(cell / mean_s(survey)), -4.0, 4.0);
    }
    const double into_sun = std::max(survey.sun_cosine, 0.0), backlit = into_sun * into_sun;
    const double thin = std::log(depth / (1 + depth)), thick = std::log1p(depth);
    const double cells = std::log1p(cell_depth), forward = std::abs(g);
    return {1,
            thin,
            thick,
            cells,
            forward,
            g * g,
            backlit,
            g * g * backlit,
            coarseness,
            survey.eye_inside ? 1.0 : 0.0,
            sun_share(scene),
            std::log10(std::clamp(1 - scene->medium.albedo, 1e-4, 1.0)) + 4,
            thin * forward,
            thick * forward,
            thick * backlit,
            thick * thick,
            cells * cells,
            thin * thin};
}

TimeFigures time_figures(const Rung& rung, const Scene& scene, const Survey& survey,
                         std::uint32_t samples) {
    const double pixels = static_cast<double>(scene->image.width) * scene->image.height;
    const double covered = pixels * survey.covered;
    const auto particles = static_cast<double>(survey.particles);
    TimeFigures figures{1,      covered, particles, pixels * survey.particles_per_pixel,
                        pixels, 0,       0,         0};
    if (rung.method == Method::kMarch) {
        const TransportSettings settings = transport_settings(rung);
        const glm::dvec3 share = (survey.bounds.max - survey.bounds.min) / longest_side(survey);
        const double cells = rung.cells == 0
                                 ? 0
                                 : std::pow(rung.cells, 3) * std::max(share.x, 1.0 / rung.cells) *
                                       std::max(share.y, 1.0 / rung.cells) *
                                       std::max(share.z, 1.0 / rung.cells);
        const double bands = (scene->sun.intensity > 0 ? 1 : 0) + (scene->sky.none ? 0
                                                                   : scene->sky.physical
                                                                       ? 3  // a colour channel each
                                                                       : 2);
        const double harmonics = scene->medium.g == 0 ? 0.5 : 1;  // of the cost of 16
        // Sweeps that the solve takes: few in thin matter, three times as many at depth 30.
        const double sweeps = 1 + 0.7 * std::log1p(std::min(survey.optical_depth_sun, 1e3));
        figures[5] = cells * bands * harmonics * sweeps;
        figures[6] = updates(survey, settings.sun_cells) + updates(survey, 3 * rung.cells);
    }
    if (rung.method == Method::kPaths) {
        // A path that meets thick matter scatters about as often as it is deep, and as the forward peak asks for.
        const double depth = std::clamp(survey.mean_depth_eye, 0.0, 1e4);
        const double absorbed = 1 - scene->medium.albedo;
        const double orders = depth / (1 + absorbed * depth * depth);
        figures[7] = covered * samples * (1 + orders);
    }
    return figures;
}

}  // namespace awan
