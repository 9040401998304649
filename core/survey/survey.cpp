#include "core/survey/survey.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/survey/ground_view.h"
#include "core/survey/haze_view.h"
#include "core/survey/merge.h"
#include "core/survey/narrow.h"
#include "core/survey/optical_depth.h"
#include "core/survey/volume.h"

namespace awan {
namespace {

constexpr int kVolumeCells = 48;  // along the longest side
constexpr double kInsideReach = 4;

void measure_projection(const ParticleSet& particles, int image_height, Survey& survey) {
    const View& view = survey.view;
    const double px_per_slope = image_height / (2 * view.tan_half_fov);
    survey.min_projected_px = std::numeric_limits<double>::infinity();
    double area = 0, narrow = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i);
        const double distance = glm::length(particles.center[i] - view.eye);
        if (distance <= kInsideReach * s) survey.eye_inside = true;
        const double px =
            distance > s ? s / distance * px_per_slope : std::numeric_limits<double>::infinity();
        survey.min_projected_px = std::min(survey.min_projected_px, px);
        survey.max_projected_px = std::max(survey.max_projected_px, px);
        // Roughly what it covers: ln(1 + tau) instead of Ein.
        const double depth = central_depth(particles, i);
        const double covered = s * s * exact::log1p(depth);
        area += covered;
        if (px < least_width(depth)) narrow += covered;
    }
    if (area > 0) survey.sub_pixel = std::min(narrow / area, 1.0);
}

void measure_picture(const ParticleSet& particles, Survey& survey) {
    const EyeDepth eye = eye_optical_depth(particles, survey.view);
    survey.optical_depth_eye = eye.largest;
    survey.mean_depth_eye = eye.mean;
    survey.covered = eye.covered;
    survey.particles_per_pixel = eye.particles_per_pixel;
}

double sun_cosine(const Scene& scene, const Survey& survey) {
    const glm::dvec3 to_eye = survey.view.eye - 0.5 * (survey.bounds.min + survey.bounds.max);
    const double distance = glm::length(to_eye);
    return distance > 0 ? -glm::dot(sun_direction(scene->sun), to_eye) / distance : 0;
}

// The mean radius, by mass.
double typical_radius(const ParticleSet& particles) {
    double radii = 0, mass = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double own = gaussian_mass(particles, i);
        radii += own * static_cast<double>(particles.radius[i]);
        mass += own;
    }
    return mass > 0 ? radii / mass : 0;
}

void measure_matter(const ParticleSet& particles, Survey& survey) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
        survey.max_sigma_s =
            std::max(survey.max_sigma_s,
                     static_cast<double>(particles.density[i]) * gaussian_s(particles, i));
        survey.total_mass += gaussian_mass(particles, i);
        double power = 1;
        for (double& sum : survey.s_sums) {
            sum += power;
            power *= gaussian_s(particles, i);
        }
    }
    survey.detail.radius = typical_radius(unmerged(particles));
    survey.detail.origin = 0.5 * (survey.bounds.min + survey.bounds.max);
}

// By mass: what a point in the matter has around it.
double typical_extinction(const DensityVolume& volume) {
    double sum = 0, squares = 0;
    for (const float cell : volume.extinction) {
        sum += static_cast<double>(cell);
        squares += static_cast<double>(cell) * static_cast<double>(cell);
    }
    return sum > 0 ? squares / sum : 0;
}

}  // namespace

Result<Survey> survey(const Scene& scene, const ParticleSet& particles, int threads,
                      const Deadline& deadline) {
    Survey survey;
    survey.particles = unmerged(particles).size();
    survey.drawn = particles.size();
    survey.cloud_density = particles.cloud_density;
    survey.model_error = particles.error;
    survey.bounds = bounds_of(unmerged(particles));
    survey.view = resolve_view(scene->camera, scene->image, survey.bounds);
    survey.sun_cosine = sun_cosine(scene, survey);
    // On all threads, before anybody asks for it on one.
    relief_of(*scene, threads);
    if (particles.size() == 0) {
        survey.haze = haze_figures(scene, survey);
        return survey;
    }

    // Each figure is one thread's work from start to end, so the result does not depend on their
    // number.
    parallel_for(threads, 6, [&](std::size_t task) {
        switch (task) {
            case 0:
                survey.volume = density_volume(particles, kVolumeCells, kMaxVolumeWork, deadline);
                break;
            case 1:
                measure_picture(particles, survey);
                break;
            case 2:
                survey.optical_depth_sun =
                    parallel_optical_depth(particles, sun_direction(scene->sun));
                break;
            case 3:
                survey.optical_depth_zenith = parallel_optical_depth(particles, {0, 1, 0});
                break;
            case 4:
                survey.islands = find_islands(particles);
                break;
            default:
                measure_matter(particles, survey);
                measure_projection(particles, scene->image.height, survey);
        }
    });
    if (auto error = deadline.over()) return *error;
    for (const float cell : survey.volume.extinction)
        survey.max_extinction = std::max(survey.max_extinction, static_cast<double>(cell));
    survey.detail.extinction = typical_extinction(survey.volume);
    survey.clumps = find_clumps(particles, survey.islands, threads);
    survey.haze = haze_figures(scene, survey);
    survey.ground = ground_view(scene, particles, survey, threads);
    if (auto error = deadline.over()) return *error;
    return survey;
}

}  // namespace awan
