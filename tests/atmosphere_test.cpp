// The sky of scattered light against measurements that others published, and against laws.
#include "core/scene/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/scene/outside.h"
#include "tests/sky_checks.h"

namespace awan {
namespace {

constexpr double kPi = std::numbers::pi;
using test::kDegree;
using test::towards;

AirSky sky_at(double degrees, double turbidity) {
    return air_sky(towards(degrees * kDegree), turbidity);
}

// Of the sky on a level plane, over the unit of luminance of daylight.h.
glm::dvec3 irradiance(const AirSky& sky) {
    constexpr int kUp = 60, kAround = 48;
    glm::dvec3 sum(0);
    for (int i = 0; i < kUp; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double up = kPi / 2 * (i + 0.5) / kUp, around = 2 * kPi * (j + 0.5) / kAround;
            sum += std::sin(up) * std::cos(up) * radiance(sky, towards(up, around));
        }
    return sum * (kPi / 2 / kUp) * (2 * kPi / kAround);
}

// The same in lux; what a camera set to daylight does to the blue of a sky is 2% of it.
double illuminance(const AirSky& sky) {
    return daylight_unit() * luminance(irradiance(sky));
}

TEST(Daylight, OfSunAndSkyIsWhite) {
    const double elevation = 45 * kDegree;
    const glm::dvec3 both =
        irradiance(sky_at(45, 2)) + std::sin(elevation) * sunlight(elevation, 2);
    EXPECT_NEAR(both.x / both.y, 1, 1e-3);
    EXPECT_NEAR(both.z / both.y, 1, 1e-3);
}

TEST(AirSky, LightsTheGroundAsMeasured) {
    // IES 1984, "Recommended practice for the calculation of daylight availability": a clear sky gives a level plane
    // .8 + 15.5 sqrt(sin elevation) klx, the sun 127.5 exp(-.21 / sin elevation) klx at normal incidence.
    for (const double elevation : {20., 30., 45., 60., 90.}) {
        const double up = std::sin(elevation * kDegree);
        const double said = 800 + 15500 * std::sqrt(up);
        const double sky = illuminance(sky_at(elevation, 2));
        EXPECT_NEAR(sky, said, 0.15 * said) << elevation;
        const double day = said + up * 127500 * std::exp(-0.21 / up);
        EXPECT_NEAR(sky + up * sun_illuminance(elevation * kDegree, 2), day, 0.15 * day);
    }
}

TEST(AirSky, TwilightFallsAsMeasured) {
    // Seidelmann 1992, "Explanatory Supplement to the Astronomical Almanac": light on a level plane, lux, as the sun's
    // middle is on the horizon, .8 and 6 degrees below it.
    const double measured[][2] = {{0, 732}, {-0.8, 453}, {-6, 3.4}};
    for (const auto& [elevation, lux] : measured) {
        const double here = illuminance(sky_at(elevation, 2));
        EXPECT_NEAR(std::log(here / lux), 0, std::log(1.5)) << elevation << ": " << here;
    }
}

TEST(AirSky, TheHorizonIsNeverMauve) {
    // Neither pink nor violet: green is not below both red and blue, by more than a code of 8 bits in hazy air.
    for (const double turbidity : {2., 2.5, 3., 4., 6., 10.})
        for (double elevation = 15; elevation <= 70; elevation += 5) {
            const AirSky sky = sky_at(elevation, turbidity);
            for (double up = 0; up <= 10; up += 2)
                for (double azimuth = 0; azimuth <= 180; azimuth += 15) {
                    const glm::dvec3 seen = radiance(sky, towards(up * kDegree, azimuth * kDegree));
                    EXPECT_GE(seen.y, (turbidity > 3 ? 0.975 : 0.999) * std::min(seen.x, seen.z))
                        << "turbidity " << turbidity << ", sun " << elevation << ", at " << up
                        << " " << azimuth;
                }
        }
}

TEST(AirSky, IsBlueOverheadAndBrightAndPaleAtTheHorizonAndAroundTheSun) {
    for (const double turbidity : {2., 3.}) {
        const AirSky sky = sky_at(45, turbidity);
        const glm::dvec3 zenith = radiance(sky, {0, 1, 0});
        const glm::dvec3 horizon = radiance(sky, towards(2 * kDegree, kPi / 2));
        EXPECT_GT(zenith.z, 2 * zenith.x);
        EXPECT_LT(horizon.z, 1.5 * horizon.x);
        EXPECT_GT(luminance(horizon), 1.5 * luminance(zenith));
        EXPECT_GT(luminance(radiance(sky, towards(50 * kDegree))), 2 * luminance(zenith));
    }
    // Ozone keeps the zenith blue when the sun has set (Hulburt 1953); the glow where it went is red.
    const AirSky twilight = sky_at(-2, 2);
    const glm::dvec3 zenith = radiance(twilight, {0, 1, 0}),
                     glow = radiance(twilight, towards(0.03));
    EXPECT_GT(zenith.z, 1.5 * zenith.x);
    EXPECT_GT(glow.x, 1.3 * glow.z);
}

TEST(AirSky, IsFiniteAndNotNegativeInEveryDirectionAtEveryHourInAnyAir) {
    for (const double turbidity : {2., 5., 10.})
        for (double elevation = -90; elevation <= 90; elevation += 7.5)
            test::expect_sane_everywhere(
                sky_at(elevation, turbidity),
                std::to_string(turbidity) + " " + std::to_string(elevation));
    test::expect_finite_on_axes([](const glm::dvec3& sun) { return air_sky(sun, 2); });
}

TEST(AirSky, HasNoEdgeAtTheHorizonAndNoStepAtSunset) {
    for (const double turbidity : {2., 10.}) {
        const AirSky sky = sky_at(10, turbidity);
        const double level = luminance(radiance(sky, towards(0, 1)));
        EXPECT_NEAR(luminance(radiance(sky, towards(1e-4, 1))), level, 0.02 * level);
        EXPECT_NEAR(luminance(radiance(sky, towards(-1e-4, 1))), level, 0.02 * level);
        // In steps of a tenth of a degree; twilight falls by e in about 1 degree.
        double before = luminance(radiance(sky_at(2, turbidity), {0, 1, 0}));
        for (double elevation = 1.9; elevation > -12; elevation -= 0.1) {
            const double here = luminance(radiance(sky_at(elevation, turbidity), {0, 1, 0}));
            EXPECT_NEAR(here, before, 0.2 * before + 1e-8) << elevation;
            EXPECT_LE(here, before * (1 + 1e-9)) << elevation;
            before = here;
        }
        EXPECT_LT(before, 1e-7);
    }
}

// From straight below comes what dark land throws back of the light on it, a little veiled by the air before it; the
// nearer the horizon, the more of the horizon's sky.
TEST(AirSky, BelowTheHorizonIsLandThatTheAirVeils) {
    for (const double elevation : {10., 40., 80.}) {
        const AirSky sky = sky_at(elevation, 2);
        const double day =
            luminance(irradiance(sky)) +
            std::sin(elevation * kDegree) * luminance(sunlight(elevation * kDegree, 2));
        const double land = luminance(radiance(sky, {0, -1, 0}));
        EXPECT_GT(land, 0.07 * day / kPi) << elevation;
        EXPECT_LT(land, 0.18 * day / kPi) << elevation;
        for (const double around : {0.5, 2.0}) {
            const double level = luminance(radiance(sky, towards(0, around)));
            double before = level;
            for (const double down : {0.3, 2., 5., 15., 45.}) {
                const double here = luminance(radiance(sky, towards(-down * kDegree, around)));
                EXPECT_LE(here, before * 1.001) << elevation << " " << down;
                before = here;
            }
            EXPECT_LT(before, 0.75 * level);
        }
    }
}

TEST(AirSky, IsTheSameOnBothSidesOfTheSunAndTurnsWithIt) {
    const AirSky sky = air_sky(towards(30 * kDegree, 0.7), 3),
                 other = air_sky(towards(30 * kDegree, 2), 3);
    for (const double up : {5., 40., 80.})
        for (const double aside : {0.3, 1.5, 3.0}) {
            const glm::dvec3 left = radiance(sky, towards(up * kDegree, 0.7 - aside));
            const glm::dvec3 right = radiance(sky, towards(up * kDegree, 0.7 + aside));
            EXPECT_NEAR(glm::length(left - right), 0, 1e-12);
            EXPECT_NEAR(glm::length(radiance(other, towards(up * kDegree, 2 + aside)) - right), 0,
                        1e-12);
        }
}

TEST(AirSky, IsThatOfAPhysicalSkyUnlessThePapersFitsAreAskedFor) {
    SceneDraft draft;
    draft.sky.physical = true;
    draft.sky.intensity = 1;
    const glm::dvec3 to = towards(0.5, 2);
    const glm::dvec3 sun = sun_direction(draft.sun);
    const double strength = draft.sun.intensity;
    const auto seen = [&] { return sky_radiance(outside_of(draft).sky, to) / strength; };
    EXPECT_NEAR(glm::length(seen() - radiance(air_sky(sun, draft.sky.turbidity), to)), 0, 1e-12);
    draft.sky.daylight = Daylight::kPreetham;
    EXPECT_NEAR(
        glm::length(seen() - kPreethamShare * radiance(clear_sky(sun, draft.sky.turbidity), to)), 0,
        1e-12);
}

}  // namespace
}  // namespace awan
