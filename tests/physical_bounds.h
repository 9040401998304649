// What holds for every picture of every rung: finite, alpha in 0..1, and no brighter than its lights allow.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "core/pipeline.h"
#include "core/scene/outside.h"
#include "core/truth/oracles.h"

namespace awan::test {

// What is scattered once stays below irradiance x the phase function's peak / 4 pi, and further orders only spread that
// peak; what has lost its direction stays below kDiffuse x irradiance / 4 pi (deep in a conservative half space it is 5
// x: Chandrasekhar 1950, section 23; a cloud that light can leave on all sides has less).
inline constexpr double kDiffuse = 6;
// By how much a rung may pass a bound: tables and steps of the march; where the discrete ordinates' light meets it is
// trilinear.
inline constexpr double kExceed = 0.02;

// The sky's largest radiance of each channel: of a gradient one of its colours; of a physical sky at the sun, or near
// the horizon, where a grid of 4 degrees misses no more than a tenth.
inline glm::dvec3 brightest(const SkyDome& sky) {
    if (!sky.shines) return glm::dvec3(0);
    if (!sky.physical) return glm::max(sky.zenith, sky.horizon);
    glm::dvec3 most = sky_radiance(sky, sky.clear.to_sun);
    constexpr int kUp = 45, kAround = 90;
    for (int i = 0; i < kUp; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double up = -1 + 2 * (i + 0.5) / kUp, side = std::sqrt(1 - up * up);
            const double turn = 2 * std::numbers::pi * j / kAround;
            most = glm::max(most,
                            sky_radiance(sky, {side * std::sin(turn), up, side * std::cos(turn)}));
        }
    return 1.1 * most;
}

// The most radiance in each channel, behind matter of alpha 1. Of the sky: nothing that it lights is brighter than it.
inline glm::dvec3 radiance_bound(const SceneDraft& draft) {
    const auto peak_of = [](const Medium& medium) {
        return std::max(phase_value(medium, 1), phase_value(medium, -1));
    };
    const Outside outside = outside_of(draft);
    const glm::dvec3 sky = brightest(outside.sky);
    glm::dvec3 most =
        outside.sun * (peak_of(draft.medium) + kDiffuse) / (4 * std::numbers::pi) + sky;
    // Light from the ground: Lambertian under the sun and what is overhead, be it sky or cloud. What goes to and fro
    // between ground and clouds is in kDiffuse: together they are no more than that conservative half space.
    if (draft.ground) most += draft.ground->albedo * (outside.sun / std::numbers::pi + most);
    // Haze scatters once what comes from all of these.
    if (draft.haze) {
        const Medium air{1, draft.haze->g, PhaseFunction::kHenyeyGreenstein};
        most += draft.haze->albedo *
                (outside.sun * peak_of(air) / (4 * std::numbers::pi) + glm::max(most, sky));
    }
    return most;
}

inline void expect_within_bounds(const SceneDraft& draft, const Rendered& rendered) {
    const Image& image = rendered.image;
    ASSERT_EQ(image.pixels.size(), 4 * static_cast<std::size_t>(draft.image.width) *
                                       static_cast<std::size_t>(draft.image.height));
    const Method method = rendered.plan.predicted.rung->method;
    const bool behind = draft.image.background == Background::kSky;
    const glm::dvec3 bounds = radiance_bound(draft);
    for (std::size_t p = 0; p < image.pixels.size(); p += 4) {
        const auto alpha = static_cast<double>(image.pixels[p + 3]);
        ASSERT_TRUE(std::isfinite(alpha)) << "pixel " << p / 4;
        ASSERT_GE(alpha, 0) << "pixel " << p / 4;
        ASSERT_LE(alpha, 1 + 1e-6) << "pixel " << p / 4;
        // float32 loses of a splat's alpha what it adds to 1.
        const double lost = method == Method::kSplats
                                ? 1e-7 * static_cast<double>(1 + rendered.survey.particles)
                                : 1e-30;
        // Haze is no matter of the clouds': it may shine where they are not.
        const double share = behind || draft.haze ? 1 : std::min(1., alpha + lost);
        for (int c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(image.pixels[p + static_cast<std::size_t>(c)]);
            ASSERT_TRUE(std::isfinite(value)) << "pixel " << p / 4;
            // A splat's light has one gradient for all channels: that of the brightest may show in the others.
            const double bound =
                method == Method::kSplats ? std::max({bounds.x, bounds.y, bounds.z}) : bounds[c];
            ASSERT_GE(value, -1e-6 * bound) << "pixel " << p / 4;
            // A few paths a pixel are far from the mean that the bound is about.
            if (method == Method::kPaths) continue;
            // Rung additive takes nothing from what lies behind: every particle may add its whole.
            const double most = rendered.plan.on(Effect::kViewExtinction)
                                    ? bound * share
                                    : bound * static_cast<double>(1 + rendered.survey.particles);
            ASSERT_LE(value, most * (1 + kExceed) + 1e-30)
                << "pixel " << p / 4 << ", alpha " << alpha << ", " << value / most
                << " times the bound";
        }
    }
}

// Figures of the survey and forecasts of the plan are numbers.
inline void expect_figures(const Rendered& rendered) {
    const Survey& survey = rendered.survey;
    for (const double figure :
         {survey.total_mass, survey.max_extinction, survey.optical_depth_sun,
          survey.optical_depth_zenith, survey.optical_depth_eye, survey.mean_depth_eye,
          survey.covered, survey.particles_per_pixel, survey.s_sums[0], survey.s_sums[1],
          survey.s_sums[2], survey.s_sums[3], survey.max_sigma_s}) {
        ASSERT_TRUE(std::isfinite(figure));
        ASSERT_GE(figure, 0);
    }
    ASSERT_LE(std::abs(survey.sun_cosine), 1 + 1e-9);
    ASSERT_FALSE(std::isnan(survey.min_projected_px) || std::isnan(survey.max_projected_px));
    const bool empty = survey.particles == 0 || !(survey.total_mass > 0);
    for (const RungForecast& forecast : rendered.plan.forecasts) {
        ASSERT_TRUE(std::isfinite(forecast.error) && std::isfinite(forecast.time_ms) &&
                    std::isfinite(forecast.bytes))
            << forecast.rung->name;
        ASSERT_TRUE(empty ? forecast.error == 0 : forecast.error > 0) << forecast.rung->name;
        ASSERT_GT(forecast.time_ms, 0) << forecast.rung->name;
        ASSERT_GT(forecast.bytes, 0) << forecast.rung->name;
    }
}

}  // namespace awan::test
