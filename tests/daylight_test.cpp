// The colours of clear daylight against measurements and tables that others published, and against laws.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "core/scene/outside.h"
#include "tests/sky_checks.h"

namespace awan {
namespace {

constexpr double kPi = std::numbers::pi;
using test::kDegree;
using test::towards;

// What the unit of luminance is, lux.
double unit() {
    return sun_illuminance(90 * kDegree, 2);
}

struct Chromaticity {
    double x, y;
};

// IEC 61966-2-1: Rec. 709 primaries and D65.
Chromaticity chromaticity(const glm::dvec3& c) {
    const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z;
    const double y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
    const double z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
    return {x / (x + y + z), y / (x + y + z)};
}

// As the display has it by itself, of what a camera set to daylight makes of it.
glm::dvec3 unbalanced(const glm::dvec3& color) {
    const glm::dvec3 white(0.95047, 1, 1.08883);
    return color * rec709(white) / balanced_rec709(white);
}

// Correlated colour temperature, McCamy 1992; a few kelvin between 2850 and 6500 K.
double temperature(const glm::dvec3& color) {
    const Chromaticity c = chromaticity(color);
    const double n = (c.x - 0.3320) / (0.1858 - c.y);
    return ((449 * n + 3525) * n + 6823.3) * n + 5520.33;
}

double temperature_of(const glm::dvec3& balanced) {
    return temperature(unbalanced(balanced));
}

SkyDome dome(double elevation, double turbidity) {
    SkyDome sky;
    sky.shines = sky.physical = true;
    sky.clear = clear_sky(towards(elevation), turbidity);
    return sky;
}

// --- the sun

TEST(Sunlight, AirIsAsDeepAsMeasured) {
    // Turbidity 1 has no aerosol: Rayleigh scattering (Bodhaine et al. 1999, sea level, 360 ppm: .3600 at 400 nm,
    // .0973 at 550 nm, .0366 at 700 nm) and .35 cm of ozone (Chappuis band: absorption .085 / cm at 550 nm). 5%:
    // Penndorf's refractive index and the paper's power law.
    const auto depth = [](int i) { return -std::log(air_transmittance(i, 1, 1)); };
    EXPECT_NEAR(depth(2), 0.3600, 0.05 * 0.3600);
    EXPECT_NEAR(depth(17), 0.0973 + 0.35 * 0.085, 0.05 * 0.127);
    // At 720 nm water vapour is dark, beside it less so.
    EXPECT_GT(depth(34), 2 * depth(31));
    // Angstrom's law: of turbidity 3, beta = .0924, at 500 nm the aerosol is .0924 * .5^-1.3 = .2275 deep.
    EXPECT_NEAR(-std::log(air_transmittance(12, 1, 3)) - depth(12), 0.2275, 0.001);
    for (int i = 0; i < 38; ++i)
        for (const double mass : {1., 5., 36.5}) {
            const double share = air_transmittance(i, mass, 2);
            EXPECT_GT(share, 0);
            EXPECT_LT(share, air_transmittance(i, mass, 1)) << i;
        }
}

TEST(Sunlight, IsAsBrightAsTheIlluminatingEngineersSay) {
    // IES 1984, "Recommended practice for the calculation of daylight availability": a clear sky's direct normal
    // illuminance is 127.5 klx exp(-.21 / sin elevation). Turbidity 2 is that air, within 6%.
    for (const double elevation : {15., 20., 30., 45., 60., 75., 90.}) {
        const double said = 127500 * std::exp(-0.21 / std::sin(elevation * kDegree));
        EXPECT_NEAR(sun_illuminance(elevation * kDegree, 2), said, 0.06 * said) << elevation;
    }
    EXPECT_NEAR(luminance(unbalanced(sunlight(90 * kDegree, 2))), 1,
                1e-3);  // luminance() has four digits
}

TEST(Sunlight, HasTheColourTemperatureOfTheHour) {
    // Photographers' tables of the sun alone: 4900 to 5800 K at noon, 4500 at 30 degrees, 4000 at 20, 3500 at 10, 2000
    // to 3000 when it rises or sets. They are round figures for air that is not given: 10%.
    for (const double turbidity : {2.0, 3.0}) {
        EXPECT_GT(temperature_of(sunlight(90 * kDegree, turbidity)), 4900);
        EXPECT_LT(temperature_of(sunlight(90 * kDegree, turbidity)), 5800);
    }
    EXPECT_NEAR(temperature_of(sunlight(30 * kDegree, 3)), 4500, 450);
    EXPECT_NEAR(temperature_of(sunlight(20 * kDegree, 3)), 4000, 450);
    EXPECT_NEAR(temperature_of(sunlight(10 * kDegree, 3)), 3500, 350);
    EXPECT_GT(temperature_of(sunlight(3 * kDegree, 2)), 2000);
    EXPECT_LT(temperature_of(sunlight(3 * kDegree, 2)), 3000);
}

TEST(Sunlight, ReddensAndDimsAsTheSunSinksAndAsTheAirThickens) {
    for (const double turbidity : {2., 3., 6., 10.}) {
        glm::dvec3 above = sunlight(90 * kDegree, turbidity);
        for (double elevation = 89.5; elevation >= 0; elevation -= 0.5) {
            const glm::dvec3 here = sunlight(elevation * kDegree, turbidity);
            EXPECT_LT(luminance(here), luminance(above)) << elevation;
            // Green and blue over red, while there is light enough to have a colour: of less than a millionth the far
            // red is left, where the matching functions are no more than their fits.
            if (luminance(here) > 1e-6) {
                EXPECT_LE(here.y * above.x, above.y * here.x) << elevation;
                EXPECT_LE(here.z * above.x, above.z * here.x) << elevation;
            }
            above = here;
        }
    }
    for (const double elevation : {5., 40., 90.}) {
        glm::dvec3 clearer = sunlight(elevation * kDegree, 2);
        for (const double turbidity : {3., 4., 6., 8., 10.}) {
            const glm::dvec3 here = sunlight(elevation * kDegree, turbidity);
            EXPECT_LT(luminance(here), luminance(clearer));
            clearer = here;
        }
    }
}

TEST(Sunlight, SetsWithoutAStep) {
    // Ten air masses a degree near the horizon, each up to 1.3 deep: 14% in a hundredth of a degree; below it the disc
    // sets within a degree, at most 1.5% in a hundredth.
    for (const double turbidity : {2., 6., 10.}) {
        const double level = luminance(sunlight(0, turbidity));
        double above = luminance(sunlight(2 * kDegree, turbidity));
        for (double elevation = 1.99; elevation > -2; elevation -= 0.01) {
            const double here = luminance(sunlight(elevation * kDegree, turbidity));
            EXPECT_LE(here, above);
            EXPECT_LE(above - here, elevation > -0.005 ? 0.14 * above : 0.016 * level) << elevation;
            above = here;
        }
        EXPECT_EQ(sunlight(-1 * kDegree, turbidity), glm::dvec3(0));
        EXPECT_EQ(sunlight(-90 * kDegree, turbidity), glm::dvec3(0));
    }
}

// --- the sky

TEST(ClearSky, HasThePapersParametersAndZenith) {
    // Appendix 2 by hand, turbidity 2, sun 45 degrees high.
    const ClearSky sky = clear_sky(towards(45 * kDegree), 2);
    const double luminance_fit[] = {-1.1056, -0.2833, 5.2797, -2.3359, 0.2363};
    const double x_fit[] = {-0.2978, -0.1322, 0.2117, -1.0271, 0.0386};
    const double y_fit[] = {-0.2942, -0.1808, 0.1944, -1.7419, 0.0311};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(sky.perez[0][i], luminance_fit[i], 1e-9);
        EXPECT_NEAR(sky.perez[1][i], x_fit[i], 1e-9);
        EXPECT_NEAR(sky.perez[2][i], y_fit[i], 1e-9);
    }
    // chi = (4/9 - 1/60) pi / 2 = .67195; (8.0906 - 4.9710) tan chi - .4310 + 2.4192 = 4.468 kcd/m^2.
    const glm::dvec3 zenith = unbalanced(radiance(sky, {0, 1, 0}));
    EXPECT_NEAR(luminance(zenith) * unit(), 4468, 0.002 * 4468);
    // x = 4 * 0.000133 + 2 * 0.004064 + 0.232294; y = 4 * 0.000059 + 2 * 0.007458 + 0.228569.
    EXPECT_NEAR(chromaticity(zenith).x, 0.24095, 5e-4);
    EXPECT_NEAR(chromaticity(zenith).y, 0.24372, 5e-4);
}

TEST(ClearSky, LightsTheGroundAsMeasuredOrMore) {
    // IES 1984: a clear sky gives a level plane .8 + 15.5 sqrt(sin elevation) klx. The model is known to be brighter
    // than measured skies (Zotti, Wilkie & Purgathofer 2007, "A critical review of the Preetham skylight model"): up to
    // 2.4 times. With the sun, whose light is most of the day's, it is within 20% of theirs.
    for (const double elevation : {30., 45., 60., 90.}) {
        const double up = std::sin(elevation * kDegree);
        const double said = 800 + 15500 * std::sqrt(up);
        const double sky =
            luminance(unbalanced(means_of(dome(elevation * kDegree, 2)).irradiance_up)) * unit();
        EXPECT_GT(sky, said) << elevation;
        EXPECT_LT(sky, 2.4 * said) << elevation;
        const double day = said + up * 127500 * std::exp(-0.21 / up);
        EXPECT_NEAR(sky + up * sun_illuminance(elevation * kDegree, 2), day, 0.21 * day);
    }
}

TEST(ClearSky, IsBlueOverheadAndBrightAndPaleAtTheHorizonAndAroundTheSun) {
    for (const double turbidity : {2., 3.}) {
        const ClearSky sky = clear_sky(towards(45 * kDegree), turbidity);
        const glm::dvec3 zenith = unbalanced(radiance(sky, {0, 1, 0}));
        const glm::dvec3 horizon = unbalanced(radiance(sky, towards(2 * kDegree, kPi / 2)));
        const glm::dvec3 beside_sun = unbalanced(radiance(sky, towards(50 * kDegree)));
        // Measured clear skies: the zenith is bluer than 10000 K (x < .28), the horizon paler and brighter.
        EXPECT_LT(chromaticity(zenith).x, 0.28);
        EXPECT_GT(chromaticity(horizon).x, chromaticity(zenith).x + 0.02);
        EXPECT_GT(luminance(horizon), luminance(zenith));
        EXPECT_GT(luminance(beside_sun), 2 * luminance(zenith));
        EXPECT_GT(zenith.z, 1.5 * zenith.x);
    }
}

TEST(ClearSky, IsFiniteAndNotNegativeInEveryDirectionAtEveryHourInAnyAir) {
    for (double turbidity = 2; turbidity <= 10; turbidity += 0.5)
        for (double elevation = -90; elevation <= 90; elevation += 2.5)
            test::expect_sane_everywhere(
                clear_sky(towards(elevation * kDegree), turbidity),
                std::to_string(turbidity) + " " + std::to_string(elevation));
    test::expect_finite_on_axes([](const glm::dvec3& sun) { return clear_sky(sun, 2); });
}

TEST(ClearSky, HasNoEdgeAtTheHorizonAndNoStepAtSunset) {
    for (const double turbidity : {2., 10.}) {
        const ClearSky sky = clear_sky(towards(10 * kDegree), turbidity);
        const double level = luminance(radiance(sky, towards(0, 1)));
        EXPECT_NEAR(luminance(radiance(sky, towards(1e-4, 1))), level, 1e-3 * level);
        EXPECT_NEAR(luminance(radiance(sky, towards(-1e-4, 1))), level, 1e-3 * level);
        // As the sun goes through the horizon; twilight falls by e in 1.1 degrees.
        double before = luminance(radiance(clear_sky(towards(1 * kDegree), turbidity), {0, 1, 0}));
        for (double elevation = 1; elevation > -20; elevation -= 0.01) {
            const double here =
                luminance(radiance(clear_sky(towards(elevation * kDegree), turbidity), {0, 1, 0}));
            EXPECT_NEAR(here, before, 0.02 * before + 1e-9) << elevation;
            EXPECT_LE(here, before * (1 + 1e-9)) << elevation;
            before = here;
        }
        EXPECT_EQ(before, 0);
    }
}

TEST(ClearSky, TwilightFallsAsMeasured) {
    // Seidelmann 1992: from sunset to the end of civil twilight the illuminance falls to .5%, to the end of nautical
    // twilight to about 1e-5 of it. A factor of 2: it is our fade, not the paper's.
    const auto zenith = [](double below) {
        return luminance(radiance(clear_sky(towards(-below * kDegree), 2), {0, 1, 0}));
    };
    EXPECT_NEAR(std::log(zenith(6) / zenith(0)), std::log(0.005), std::log(2.));
    EXPECT_NEAR(std::log(zenith(12) / zenith(0)), std::log(1.1e-5), std::log(3.));
}

TEST(ClearSky, IsTheSameOnBothSidesOfTheSun) {
    const ClearSky sky = clear_sky(towards(30 * kDegree, 0.7), 3);
    for (const double up : {5., 40., 80.})
        for (const double aside : {0.3, 1.5, 3.0}) {
            const glm::dvec3 left = radiance(sky, towards(up * kDegree, 0.7 - aside));
            const glm::dvec3 right = radiance(sky, towards(up * kDegree, 0.7 + aside));
            EXPECT_NEAR(glm::length(left - right), 0, 1e-12);
        }
}

// --- what shines on a scene

TEST(Outside, MeansAreThoseOfAFinerSum) {
    for (const double elevation : {90., 45., 5.}) {
        const SkyDome sky = dome(elevation * kDegree, 3);
        const SkyMeans fine = means_of(sky, 300), usual = means_of(sky), rough = means_of(sky, 12);
        for (const auto& [steps, share] : {std::pair{usual, 2e-3}, std::pair{rough, 0.02}}) {
            EXPECT_NEAR(luminance(steps.irradiance_up), luminance(fine.irradiance_up),
                        share * luminance(fine.irradiance_up));
            EXPECT_NEAR(luminance(steps.above), luminance(fine.above),
                        share * luminance(fine.above));
            EXPECT_NEAR(luminance(steps.below), luminance(fine.below),
                        share * luminance(fine.below));
        }
    }
    // A gradient of one colour: radiance 1 all round.
    SkyDome even;
    even.shines = true;
    even.zenith = even.horizon = glm::dvec3(1);
    EXPECT_NEAR(means_of(even).irradiance_up.x, kPi, 1e-3);
    EXPECT_NEAR(means_of(even).above.y, 1, 1e-12);
    EXPECT_NEAR(means_of(even).below.z, 1, 1e-12);
}

TEST(Outside, AnAutomaticSunHasTheColourOfItsElevationUnlessThatIsSwitchedOff) {
    SceneDraft draft;
    draft.sun.auto_color = true;
    draft.sun.elevation = 8;
    draft.sun.intensity = 40;
    draft.sky.turbidity = 4;
    const glm::dvec3 color = 40.0 * sunlight(8 * kDegree, 4);
    EXPECT_NEAR(glm::length(outside_of(draft).sun - color), 0, 1e-9);
    draft.effects[static_cast<int>(Effect::kSunColor)] = Switch::kOff;
    const glm::dvec3 grey = outside_of(draft).sun;
    EXPECT_EQ(grey.x, grey.y);
    EXPECT_EQ(grey.y, grey.z);
    EXPECT_NEAR(luminance(grey), luminance(color), 1e-9);
}

TEST(Outside, OneIntensityScalesSunAndPhysicalSky) {
    SceneDraft draft;
    draft.sky.physical = true;
    draft.sky.intensity = 1;
    draft.sun.auto_color = true;
    draft.sun.intensity = 20;
    const Outside one = outside_of(draft);
    draft.sun.intensity = 60;
    const Outside three = outside_of(draft);
    const glm::dvec3 to = towards(0.5, 2);
    EXPECT_NEAR(glm::length(three.sun - 3.0 * one.sun), 0, 1e-9);
    EXPECT_NEAR(glm::length(sky_radiance(three.sky, to) - 3.0 * sky_radiance(one.sky, to)), 0,
                1e-9);
    draft.sky.intensity = 0.5;
    EXPECT_NEAR(
        glm::length(sky_radiance(outside_of(draft).sky, to) - 0.5 * sky_radiance(three.sky, to)), 0,
        1e-9);
    draft.sun.elevation = -40;  // night
    EXPECT_FALSE(outside_of(draft).sky.shines);
    EXPECT_EQ(outside_of(draft).sun, glm::dvec3(0));
    draft.sky.none = true;
    EXPECT_FALSE(outside_of(draft).sky.shines);
}

}  // namespace
}  // namespace awan
