#include "core/draw/sun_disc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/scene/outside.h"
#include "core/survey/haze_depth.h"
#include "core/survey/projection.h"
#include "core/survey/relief_ray.h"

namespace awan {
namespace {

using std::numbers::pi;

// Radians.
constexpr double kRadius = 0.2665 * pi / 180;
// The limb's radiance is 1 - kDarkening of the middle's; in between it falls with the cosine of the angle at which
// light leaves the sun (in the middle of the visible, Cox 2000).
constexpr double kDarkening = 0.6;
// Particles end there, in s.
constexpr double kReach = 4.5;
// Lines from the eye across the disc: about one a pixel, within these.
constexpr int kLeastLines = 9, kMostLines = 33;
// Along a line through detail: steps a bump, and at most.
constexpr double kStepsPerBump = 16;
constexpr int kMostSteps = 4096;
// Of a pixel, along a side.
constexpr int kSubPixels = 4, kMostSubPixels = 64;
// Of those, at least so many along the disc's radius.
constexpr double kPerRadius = 8;
// The share of its light that a lens scatters, and how: as (1 + (angle / kGlareWidth)^2)^-kGlareFall (Moffat 1969).
constexpr double kGlareShare = 0.01, kGlareWidth = 1.0 * pi / 180, kGlareFall = 1.6;
// Beyond the picture's edge, radians, a sun has no glare in it.
constexpr double kGlareReach = 0.35;

// The sun's place and the plane at distance 1 beside it; (x, y) there is in radii of the disc.
struct Disc {
    glm::dvec3 to_sun, u, v;
    glm::dvec3 direction(double x, double y) const {
        return glm::normalize(to_sun + exact::tan(kRadius) * (x * u + y * v));
    }
};

// Those that stand before the disc.
std::vector<std::size_t> before_disc(const ParticleSet& particles, const glm::dvec3& eye,
                                     const glm::dvec3& to_sun) {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 v = particles.center[i] - eye;
        const double along = glm::dot(v, to_sun), reach = kReach * gaussian_s(particles, i);
        if (along < -reach) continue;
        const double aside = glm::length(v - along * to_sun);
        if (aside <= reach + 1.1 * kRadius * std::max(along, 0.0)) near.push_back(i);
    }
    return near;
}

// Optical depth of the smooth matter along the half line.
double smooth_depth(const ParticleSet& particles, const std::vector<std::size_t>& near,
                    const glm::dvec3& eye, const glm::dvec3& d) {
    double depth = 0;
    for (const std::size_t i : near) {
        const glm::dvec3 v = particles.center[i] - eye;
        const double along = glm::dot(v, d), s = gaussian_s(particles, i);
        const double aside = glm::length(v - along * d) / s;
        depth += central_depth(particles, i) * exact::exp(-0.5 * aside * aside) * 0.5 *
                 exact::erfc(-along / s / std::numbers::sqrt2);
    }
    return depth;
}

// With its lumps, by the midpoint rule.
double detailed_depth(const ParticleSet& particles, const std::vector<std::size_t>& near,
                      const glm::dvec3& eye, const glm::dvec3& d) {
    const DetailField& field = *particles.detail;
    double from = std::numeric_limits<double>::infinity(), to = 0, narrowest = from;
    for (const std::size_t i : near) {
        const double along = glm::dot(particles.center[i] - eye, d), s = gaussian_s(particles, i);
        from = std::min(from, along - kReach * s);
        to = std::max(to, along + kReach * s);
        narrowest = std::min(narrowest, s);
    }
    from = std::max(from, 0.0);
    if (!(to > from)) return 0;
    const double wanted = (to - from) / std::min(field.bump / kStepsPerBump, narrowest / 2);
    const int steps = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, double{kMostSteps}));
    const double step = (to - from) / steps;
    std::vector<double> smooth(static_cast<std::size_t>(steps), 0.0);
    for (const std::size_t i : near) {
        const glm::dvec3 v = particles.center[i] - eye;
        const double along = glm::dot(v, d), s = gaussian_s(particles, i);
        const double aside = glm::length(v - along * d) / s;
        const double peak =
            static_cast<double>(particles.density[i]) * exact::exp(-0.5 * aside * aside);
        const auto place = [&](double t) {
            return static_cast<int>(std::clamp((t - from) / step, 0.0, double(steps)));
        };
        const int last = place(along + kReach * s);
        for (int k = place(along - kReach * s); k < last; ++k) {
            const double t = (from + (k + 0.5) * step - along) / s;
            smooth[static_cast<std::size_t>(k)] += peak * exact::exp(-0.5 * t * t);
        }
    }
    double depth = 0;
    for (int k = 0; k < steps; ++k) {
        const auto extinction = static_cast<float>(smooth[static_cast<std::size_t>(k)]);
        if (!(extinction > 0)) continue;
        const float n =
            extinction < field.edge ? bumps_at(field, eye + (from + (k + 0.5) * step) * d) : 1;
        depth += step * static_cast<double>(detailed(field, extinction, n));
    }
    return depth;
}

// What comes through, on a grid of lines over the square about the disc.
struct Passing {
    int side = 0;
    std::vector<double> share;
    // x, y: -1..1.
    double at(double x, double y) const {
        const auto place = [&](double p) {
            const double at = std::clamp((p + 1) / 2 * (side - 1), 0.0, side - 1.0);
            const int low = std::min(static_cast<int>(at), side - 2);
            return std::pair(low, at - low);
        };
        const auto [i, s] = place(x);
        const auto [j, t] = place(y);
        const double* const row = share.data() + j * side + i;
        const double* const next = row + side;
        return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
    }
};

Passing passing_through(const Scene& scene, const View& view, const ParticleSet& particles,
                        const Disc& disc, bool haze, double radius_px, int threads) {
    Passing passing;
    passing.side =
        std::clamp(static_cast<int>(std::ceil(2 * radius_px)) + 1, kLeastLines, kMostLines);
    const auto side = static_cast<std::size_t>(passing.side);
    passing.share.resize(side * side);
    const std::vector<std::size_t> near = before_disc(particles, view.eye, disc.to_sun);
    parallel_for(threads, passing.share.size(), [&](std::size_t i) {
        const auto place = [&](std::size_t k) {
            return 2.0 * static_cast<double>(k) / static_cast<double>(side - 1) - 1;
        };
        const glm::dvec3 d = disc.direction(place(i % side), place(i / side));
        double depth = particles.detail ? detailed_depth(particles, near, view.eye, d)
                                        : smooth_depth(particles, near, view.eye, d);
        if (haze && scene->haze)
            depth += HazeRay(*scene->haze, view.eye.y, d.y)
                         .depth(std::numeric_limits<double>::infinity());
        passing.share[i] = exact::exp(-depth);
    });
    return passing;
}

// The disc's radiance over its mean, in radii from its middle.
double profile(double x, double y) {
    const double r2 = x * x + y * y;
    return r2 < 1 ? (1 - kDarkening * (1 - std::sqrt(1 - r2))) / (1 - kDarkening / 3) : 0;
}

// From pixels to directions.
struct Pixels {
    const View& view;
    int width, height;
    glm::dvec3 direction(double x, double y) const {
        const double u = (x / width * 2 - 1) * view.tan_half_fov * view.aspect;
        const double v = (1 - y / height * 2) * view.tan_half_fov;
        return glm::normalize(view.forward + u * view.right + v * view.up);
    }
    // Of a direction in front of the eye.
    glm::dvec2 place(const glm::dvec3& d) const {
        const double ahead = glm::dot(d, view.forward);
        return {
            (glm::dot(d, view.right) / ahead / (view.tan_half_fov * view.aspect) + 1) / 2 * width,
            (1 - glm::dot(d, view.up) / ahead / view.tan_half_fov) / 2 * height};
    }
};

void add(Image& image, int x, int y, const glm::dvec3& radiance) {
    float* const pixel = image.pixels.data() +
                         4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
    for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(radiance[c]);
}

// The mean share of the disc's light that comes through.
template <typename Hidden>
double mean_passing(const Passing& passing, const Disc& disc, const Hidden& hidden) {
    constexpr int kSide = 64;
    double sum = 0, all = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = 2 * (i % kSide + 0.5) / kSide - 1, y = 2 * (i / kSide + 0.5) / kSide - 1;
        const double light = profile(x, y);
        all += light;
        if (light > 0 && !hidden(disc.direction(x, y))) sum += light * passing.at(x, y);
    }
    return sum / all;
}

void add_glare(const Pixels& pixels, const Disc& disc, const glm::dvec3& irradiance, int threads,
               Image& image) {
    const double most = kGlareShare * (kGlareFall - 1) / (pi * kGlareWidth * kGlareWidth);
    parallel_for(threads, static_cast<std::size_t>(image.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 d = pixels.direction(x + 0.5, y + 0.5);
            const double turn = glm::length(d - disc.to_sun) / kGlareWidth;
            add(image, x, y, most * exact::pow(1 + turn * turn, -kGlareFall) * irradiance);
        }
    });
}

}  // namespace

bool shows_sun_disc(const SceneDraft& scene) {
    if (scene.image.background != Background::kSky || scene.look != Look::kPhysical) return false;
    if (scene.sun.disc != SunDisc::kAutomatic) return scene.sun.disc == SunDisc::kShown;
    return !scene.sky.none && scene.image.format != ImageFormat::kExr;
}

void add_sun_disc(const Scene& scene, const View& view, const ParticleSet& particles, bool haze,
                  double most, int threads, Image& image) {
    const Outside outside = outside_of(scene);
    if (!image.opaque || outside.sun == glm::dvec3(0)) return;
    const SideAxes side = side_axes(outside.to_sun);
    const Disc disc{outside.to_sun, side.u, side.v};
    const double ahead = glm::dot(disc.to_sun, view.forward);
    if (!(ahead > 0.05)) return;
    const Pixels pixels{view, image.width, image.height};
    const glm::dvec2 middle = pixels.place(disc.to_sun);
    const glm::dvec3 nearest = pixels.direction(std::clamp(middle.x, 0.0, double(image.width)),
                                                std::clamp(middle.y, 0.0, double(image.height)));
    if (glm::length(nearest - disc.to_sun) > kGlareReach) return;

    // The picture's scale grows away from its middle, along the radius the most.
    const double per_radian = image.height / (2 * view.tan_half_fov) / (ahead * ahead);
    const double radius_px = kRadius * per_radian;
    const bool grounded = scene->ground && view.eye.y > scene->ground->height;
    const auto relief = grounded ? relief_of(*scene, threads) : nullptr;
    // By the ground or by hills on it.
    const auto hidden = [&](const glm::dvec3& d) {
        return (grounded && d.y < 0) ||
               (relief && std::isfinite(hills_ahead(*relief, view.eye, d)));
    };
    const Passing passing = passing_through(scene, view, particles, disc, haze, radius_px, threads);
    const bool glare = scene->image.format != ImageFormat::kExr;
    const glm::dvec3 radiance = (glare ? 1 - kGlareShare : 1.0) /
                                (pi * exact::sin(kRadius) * exact::sin(kRadius)) * outside.sun;
    const int sub = static_cast<int>(
        std::clamp(std::ceil(kPerRadius / radius_px), double{kSubPixels}, double{kMostSubPixels}));
    const double brightest = std::max({radiance.x, radiance.y, radiance.z});
    const double reach = 1.1 * radius_px + 1, per_radius = 1 / exact::tan(kRadius);
    const auto within = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    for (int y = within(middle.y - reach, image.height);
         y < within(middle.y + reach + 1, image.height); ++y)
        for (int x = within(middle.x - reach, image.width);
             x < within(middle.x + reach + 1, image.width); ++x) {
            double sum = 0;
            for (int i = 0; i < sub * sub; ++i) {
                const glm::dvec3 d =
                    pixels.direction(x + (i % sub + 0.5) / sub, y + (i / sub + 0.5) / sub);
                if (hidden(d)) continue;
                const double u = glm::dot(d, disc.u) * per_radius,
                             v = glm::dot(d, disc.v) * per_radius;
                const double light = profile(u, v);
                if (light > 0) sum += std::min(light * passing.at(u, v), most / brightest);
            }
            if (sum > 0) add(image, x, y, sum / (sub * sub) * radiance);
        }
    if (!glare) return;
    const double through = mean_passing(passing, disc, hidden);
    if (through > 0) add_glare(pixels, disc, through * outside.sun, threads, image);
}

}  // namespace awan
