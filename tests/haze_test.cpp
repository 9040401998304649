// The haze against integrals of its definition and against the path tracer, and when it is left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/accuracy/error_measures.h"
#include "core/draw/air.h"
#include "core/light/sun_depth.h"
#include "core/survey/haze_view.h"
#include "core/truth/haze_walk.h"
#include "tests/march_lights.h"
#include "tests/patience.h"

namespace awan {
namespace {

using std::numbers::pi;
using test::Ball;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// --- closed forms
// -----------------------------------------------------------------------------------------------------

// Simpson over the layer as the scene states it, from a point of the ray on; the exponential part as far as it matters.
double quadrature(const Haze& haze, double y, double slope, double t) {
    const auto density = [&](double at) {
        return std::exp(
            -std::max((y - haze.height) / haze.scale_height + slope / haze.scale_height * at, 0.0));
    };
    std::vector<double> cuts{0, t};
    const double crossing = slope != 0 ? (haze.height - y) / slope : -1;
    if (crossing > 0 && crossing < t) cuts.push_back(crossing);
    // 60 scale heights from the lower end there is e^-60 of the haze.
    const double beyond = slope != 0 ? 60 * haze.scale_height / std::abs(slope) : kInfinity;
    const double low = slope > 0 ? std::max(crossing, 0.0) : std::min(std::max(crossing, 0.0), t);
    for (const double cut : {low + beyond, low - beyond})
        if (slope != 0 && cut > 0 && cut < t) cuts.push_back(cut);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    constexpr int kIntervals = 4000;
    for (std::size_t part = 0; part + 1 < cuts.size(); ++part) {
        const double a = cuts[part], h = (cuts[part + 1] - a) / kIntervals;
        for (int i = 0; i <= kIntervals; ++i)
            sum += (i == 0 || i == kIntervals ? 1
                    : i % 2 == 1              ? 4
                                              : 2) *
                   density(a + i * h) * h / 3;
    }
    return haze.extinction * sum;
}

TEST(Haze, DepthIsTheIntegralOfTheLayer) {
    for (const double scale_height : {1e-3, 0.7, 40.0, 1e9})
        for (const double extinction : {0.0, 1e-3, 1e6})
            for (const double above : {-3e3, -2.0, 0.0, 0.5, 30.0})  // of the layer, scale heights
                for (const double slope : {0.0, 1e-13, -1e-13, 1e-7, -1e-4, 0.02, -0.3, 1.0, -1.0})
                    for (const double t : {1e-6, 1.0, 300.0, 1e9}) {
                        Haze haze;
                        haze.extinction = extinction;
                        haze.height = 5;
                        haze.scale_height = scale_height;
                        const double y = 5 + above * scale_height;
                        const double depth = HazeRay(haze, y, slope).depth(t);
                        const double expected = quadrature(haze, y, slope, t);
                        // Simpson over 60 scale heights in 4000 intervals: (60/4000)^4 / 180 = 3e-10; and `y` has
                        // 1e-16 of itself, which over a scale height is up to 1e-10.
                        EXPECT_NEAR(depth, expected, 2e-9 * expected + 1e-250)
                            << scale_height << " " << extinction << " " << above << " " << slope
                            << " " << t;
                        // The reference's own formulas.
                        EXPECT_NEAR(truth::HazePath(haze, y, slope).depth(t), depth,
                                    1e-8 * depth + 1e-250)
                            << scale_height << " " << above << " " << slope << " " << t;
                    }
}

TEST(Haze, RaysWithoutEndAreExactAndFinite) {
    Haze haze;
    haze.extinction = 0.3;
    haze.scale_height = 50;
    EXPECT_EQ(HazeRay(haze, 20, 0).opacity(kInfinity), 1);
    EXPECT_EQ(HazeRay(haze, 20, -0.1).opacity(kInfinity), 1);
    EXPECT_NEAR(HazeRay(haze, 20, 0.5).depth(kInfinity), 0.3 * 50 * std::exp(-0.4) / 0.5, 1e-12);
    EXPECT_NEAR(HazeRay(haze, -20, 0.5).depth(kInfinity), (0.3 * 20 + 0.3 * 50) / 0.5, 1e-12);
    EXPECT_NEAR(vertical_haze_depth(haze, -5, 10), 0.3 * 5 + 0.3 * 50 * -std::expm1(-0.2), 1e-12);
    haze.extinction = 0;
    EXPECT_EQ(HazeRay(haze, 20, 0).opacity(kInfinity), 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const auto power = [&](double low, double high) {
            return std::pow(10, low + (high - low) * unit(random));
        };
        haze.extinction = unit(random) < 0.1 ? 0 : power(-12, 6);
        haze.scale_height = power(-9, 9);
        haze.height = (unit(random) - 0.5) * power(0, 9);
        const double slope = unit(random) < 0.1 ? 0 : (unit(random) - 0.5) * power(-300, 0.3);
        const HazeRay ray(haze, (unit(random) - 0.5) * power(0, 9), slope);
        double before = 0;
        for (const double t : {0.0, 1e-9, 1e-3, 1.0, 1e4, 1e12, kInfinity}) {
            const double opacity = ray.opacity(t);
            ASSERT_TRUE(opacity >= before * (1 - 1e-9) && opacity <= 1) << i << " " << t;
            before = opacity;
        }
        double many[32];
        const double first = power(-9, 9), step = power(-6, 1) * first;
        ray.opacities(first, step, 32, many);
        for (int k = 0; k < 32; ++k) {
            const double one = ray.opacity(first + k * step);
            // A step's rounding of the height, at 1e9 of 1e-9 scale heights, is all it may differ by.
            ASSERT_NEAR(many[k], one, 1e-9 * one + 1e-250) << i << " " << k;
        }
    }
}

TEST(Haze, TheReferenceInvertsItsDepth) {
    Haze haze;
    haze.extinction = 0.2;
    haze.height = 1;
    haze.scale_height = 4;
    for (const double y : {-3.0, 1.0, 9.0})
        for (const double slope : {-0.8, -1e-9, 0.0, 1e-5, 0.4})
            for (const double depth : {1e-6, 0.1, 0.5}) {
                const truth::HazePath path(haze, y, slope);
                const double t = path.where(depth);
                if (std::isfinite(t)) {
                    EXPECT_NEAR(path.depth(t), depth, 1e-9 * depth) << y << " " << slope;
                } else {
                    EXPECT_LE(path.depth(kInfinity), depth);
                }
            }
}

// --- pictures
// ---------------------------------------------------------------------------------------------------------

SceneDraft hazy(SceneDraft draft, double extinction, double height, double scale_height) {
    draft.haze.emplace();
    draft.haze->extinction = extinction;
    draft.haze->height = height;
    draft.haze->scale_height = scale_height;
    return draft;
}

// A ball of matter that shades a hazy air, from the side.
SceneDraft shading_ball() {
    SceneDraft draft = hazy(test::balls({{{0, 4, 0}, 4, 3}}), 0.03, 0, 12);
    draft.haze->albedo = {0.9, 0.95, 1};
    draft.sun.elevation = 50;
    draft.sun.azimuth = 70;
    draft.sun.intensity = 10;
    draft.sky = {};
    draft.sky.intensity = 0.3;
    draft.medium.g = 0;
    draft.camera.fov = 60;
    draft.image.width = 48;
    draft.image.height = 36;
    return draft;
}

double mean(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (i % 4 != 3) sum += static_cast<double>(image.pixels[i]);
    return sum / static_cast<double>(3 * image.pixel_count());
}

// Root mean square of the difference over the mean.
double difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        if (i % 4 != 3) sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(3 * a.pixel_count())) / mean(b);
}

// A pixel from the integrals of the definition: matter that shines with `source` a unit of depth and scatters nothing.
glm::dvec3 by_hand(const test::Stage& stage, const test::Ray& ray, double source, bool shafts) {
    const Haze& haze = *stage.scene->haze;
    const Outside outside = outside_of(stage.scene);
    const SkyMeans sky = means_of(outside.sky);
    const glm::dvec3 ambient = 0.5 * (sky.above + sky.below);
    const double cosine = glm::dot(ray.direction, outside.to_sun);
    const double p =
        (1 - haze.g * haze.g) / (4 * pi * std::pow(1 + haze.g * haze.g - 2 * haze.g * cosine, 1.5));
    glm::dvec3 sum(0);
    double depth = 0, air = 0;
    // Even steps to where the shadow ends, then steps that grow to where the haze does.
    double t = 0, step = 0.05;
    while (air < 30 && t < 1e7) {
        if (t > 80) step = 0.01 * t;
        const glm::dvec3 at = ray.eye + (t + step / 2) * ray.direction;
        double matter = 0;
        for (std::size_t i = 0; i < stage.particles.size(); ++i) {
            const glm::dvec3 off = at - stage.particles.center[i];
            const double s = gaussian_s(stage.particles, i);
            matter += static_cast<double>(stage.particles.density[i]) *
                      std::exp(-glm::dot(off, off) / (2 * s * s));
        }
        const double fog =
            haze.extinction * std::exp(-std::max(at.y - haze.height, 0.0) / haze.scale_height);
        const double through = std::exp(-(depth + matter * step / 2 + air + fog * step / 2));
        const double lit =
            shafts ? std::exp(-test::line_depth(stage.particles, at, outside.to_sun)) : 1;
        sum += through * step *
               (matter * source + fog * haze.albedo * (outside.sun * (p * lit) + ambient));
        depth += matter * step;
        air += fog * step;
        t += step;
    }
    return sum + std::exp(-depth - air) * sky_radiance(outside.sky, ray.direction);
}

TEST(Haze, PixelsAreTheIntegralsAlongTheirRays) {
    SceneDraft draft = shading_ball();
    draft.medium.albedo = 0;
    const test::Stage stage = test::stage(draft);
    constexpr double kSource = 0.7;
    TransportLight light = test::grid_light(
        stage.scene, stage.particles, 24, 1, [&](auto) { return kSource; }, 2);
    light.sun = test::exact_sun(stage.scene, stage.particles, 48, 2);
    for (const bool shafts : {false, true}) {
        MarchSettings settings;
        settings.eye_effects.light_shafts = shafts;
        const Image image = test::marched(stage, light, 2, settings);
        double worst = 0, shadows = 0;
        for (int y = 1; y < image.height; y += 5)
            for (int x = 0; x < image.width; x += 4) {
                const test::Ray ray = test::ray(stage.view, image, x, y);
                const glm::dvec3 expected = by_hand(stage, ray, kSource, shafts);
                const test::Pixel got = test::pixel(image, x, y);
                worst = std::max(worst, std::abs(got.g / expected.g - 1));
                worst = std::max(worst, std::abs(got.b / expected.b - 1));
                if (shafts)
                    shadows =
                        std::max(shadows, 1 - expected.g / by_hand(stage, ray, kSource, false).g);
            }
        // Steps of the march cost 1%; the shadows' edges lie between rays two pixels apart: as much again.
        EXPECT_LT(worst, shafts ? 0.02 : 0.01) << shafts;
        if (shafts) {
            EXPECT_GT(shadows, 0.05);  // there is something to get wrong
        }
    }
}

Image rendered(SceneDraft draft, const char* rung) {
    draft.accuracy.rung = rung;
    return test::render(draft, 2).image;
}

SceneDraft hazy_table() {
    SceneDraft draft = hazy(test::table_4_4(), 0.02, -5, 6);
    draft.image.width = 48;
    draft.image.height = 36;
    return draft;
}

// Error of a march against the paths; `shafts` in the march and `shadows` in the paths.
PictureError against_paths(SceneDraft draft, const char* rung, bool shafts, bool shadows) {
    test::effect(draft, Effect::kLightShafts) = shafts ? Switch::kOn : Switch::kOff;
    const test::Stage stage = test::stage(draft);
    TruthOptions options;
    options.samples = test::or_fewer(32u, 16u);
    options.threads = 2;
    options.eye_effects.light_shafts = shadows;
    const auto truth = trace_truth(stage.scene, stage.particles, stage.view, options, {}, {});
    return picture_error(rendered(draft, rung), *truth);
}

void expect_within(const PictureError& error, double most) {
    EXPECT_LT(error.nrmse, most + 2 * error.nrmse_noise) << error.nrmse;
    EXPECT_LT(std::abs(error.bias), 0.3 * most + 2 * error.bias_noise) << error.bias;
}

TEST(Haze, MarchAgreesWithThePathsAroundABall) {
    SceneDraft ball = shading_ball();
    ball.medium.albedo = 0.9;
    ball.medium.g = 0.5;
    // The ball's own light is within .5%, and the haze within a percent of its integrals.
    expect_within(against_paths(ball, "transport-32", true, true), 0.015);
    expect_within(against_paths(ball, "transport-32", false, false), 0.015);
    // That is less than its shadow makes.
    EXPECT_GT(against_paths(ball, "transport-32", false, true).nrmse, 0.02);
}

TEST(Haze, MarchAgreesWithThePathsOnTable44) {
    // At 32 cells table 4.4's own light costs up to 4%.
    SceneDraft over_nothing = hazy_table();
    over_nothing.image.background = Background::kTransparent;
    expect_within(against_paths(over_nothing, "transport-32", true, true), 0.05);
    // A low sun behind the cloud: shadows come towards the eye.
    SceneDraft low_sun = hazy_table();
    low_sun.sun.elevation = 8;
    low_sun.sun.azimuth = 200;  // seen from azimuth 30
    expect_within(against_paths(low_sun, "transport-32", true, true), 0.03);
    EXPECT_GT(against_paths(low_sun, "transport-32", false, true).nrmse, 0.15);
}

// A pixel at the horizon is the mean of what is seen within it, in the march and in the truth: the haze there is opaque
// along one level line and clear a degree above it.
TEST(Haze, APixelAtTheHorizonIsTheMeanOverItsArea) {
    SceneDraft draft = hazy(test::balls({{{0, 40, 0}, 1, 0.01}}), 1e-3, -20, 10);
    draft.camera = {};
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 60};
    draft.camera.target = {0, 0.3, 0};
    draft.camera.fov = 40;
    draft.image.background = Background::kTransparent;
    const auto alphas = [&](int width, int height, bool whole) {
        draft.image.width = width;
        draft.image.height = height;
        const test::Stage stage = test::stage(draft);
        TruthOptions options;
        options.samples = 32;
        options.whole_pixels = whole;
        return mean_of(*trace_truth(stage.scene, stage.particles, stage.view, options, {}, {}));
    };
    const Image pixels = alphas(6, 5, true), parts = alphas(24, 20, false);
    const Image marched = [&] {
        draft.image.width = 6;
        draft.image.height = 5;
        return rendered(draft, "transport-16");
    }();
    float sharpest = 0;
    for (int y = 0; y < 5; ++y) {
        double mean = 0;
        for (int j = 0; j < 4; ++j)
            mean += 0.25 * static_cast<double>(
                               parts.pixels[4 * static_cast<std::size_t>(24 * (4 * y + j)) + 3]);
        const float own = pixels.pixels[4 * static_cast<std::size_t>(6 * y) + 3];
        EXPECT_NEAR(own, mean, 0.01) << y;
        EXPECT_NEAR(marched.pixels[4 * static_cast<std::size_t>(6 * y) + 3], mean, 0.02) << y;
        const float middle = parts.pixels[4 * static_cast<std::size_t>(24 * (4 * y + 2)) + 3];
        sharpest = std::max(sharpest, std::abs(middle - own));
    }
    EXPECT_GT(sharpest, 0.1F) << "no pixel is uneven";
}

TEST(Haze, SplatsAreSeenThroughIt) {
    // Splats are compared with themselves: dimmed by haze that is black they lose what they stand behind.
    SceneDraft draft = shading_ball();
    draft.sky.none = true;
    draft.haze->albedo = glm::dvec3(0);
    const double bare = [&] {
        SceneDraft clear = draft;
        clear.haze.reset();
        return mean(rendered(clear, "harris"));
    }();
    const double dimmed = mean(rendered(draft, "harris"));
    const double at_center =
        HazeRay(*draft.haze, 0, 4 / std::sqrt(416.0)).opacity(std::sqrt(416.0));
    EXPECT_NEAR(dimmed / bare, 1 - at_center,
                0.01);  // the ball is deep: its near side is 5% nearer
    // White haze: as the march has it, whose cloud differs from the splats' only a little in so thin a one.
    SceneDraft white = shading_ball();
    white.clouds[0].ready.densities[0] = 0.05f;
    const Image march = rendered(white, "transport-16");
    EXPECT_LT(difference(rendered(white, "harris"), march), 0.03);
}

// Shadows only take light, and about as much of the air around a black ball, whichever rung draws the ball. (A splat
// is as far away as its middle: of the air in the ball's own shade it shows more than the march, which stops at its
// near side.)
TEST(Haze, ShaftsTakeFromSplatsWhatTheyTakeFromTheMarch) {
    SceneDraft draft = shading_ball();
    draft.medium.albedo = 0;
    const auto taken = [&](const char* rung) {
        test::effect(draft, Effect::kLightShafts) = Switch::kOff;
        const Image off = rendered(draft, rung);
        test::effect(draft, Effect::kLightShafts) = Switch::kOn;
        const Image on = rendered(draft, rung);
        for (std::size_t i = 0; i < on.pixels.size(); ++i)
            EXPECT_LE(on.pixels[i], off.pixels[i] * 1.0001F) << rung << ' ' << i;
        return mean(off) - mean(on);
    };
    const double march = taken("transport-16"), splats = taken("harris");
    EXPECT_GT(march, 0);
    EXPECT_NEAR(splats / march, 1, 0.4);
}

TEST(Haze, WithoutHazeNothingChanges) {
    for (const char* rung : {"harris", "transport-16"}) {
        SceneDraft draft = test::table_4_4();
        draft.image.width = 40;
        draft.image.height = 30;
        const Image bare = rendered(draft, rung);
        SceneDraft forced = draft;
        test::effect(forced, Effect::kAerialPerspective) = Switch::kOn;
        test::effect(forced, Effect::kLightShafts) = Switch::kOn;
        EXPECT_EQ(rendered(forced, rung).pixels, bare.pixels) << rung;
        SceneDraft off = hazy_table();
        off.image = draft.image;
        test::effect(off, Effect::kAerialPerspective) = Switch::kOff;
        EXPECT_EQ(rendered(off, rung).pixels, bare.pixels) << rung;
        SceneDraft empty = draft;
        empty.haze.emplace();
        EXPECT_EQ(rendered(empty, rung).pixels, bare.pixels) << rung;
    }
}

TEST(Haze, WhatTheFigureSaysIsWhatSwitchingOffCosts) {
    for (const double extinction : {1e-5, 1e-4, 3e-3, 0.03}) {
        SceneDraft draft = shading_ball();
        draft.haze->extinction = extinction;
        draft.accuracy.rung = "transport-16";
        const Rendered with = test::render(draft, 2);
        const bool planned = with.plan.on(Effect::kLightShafts);
        SceneDraft all = draft, unshaded = draft;
        test::effect(all, Effect::kAerialPerspective) = Switch::kOn;
        test::effect(all, Effect::kLightShafts) = Switch::kOn;
        test::effect(unshaded, Effect::kAerialPerspective) = Switch::kOn;
        test::effect(unshaded, Effect::kLightShafts) = Switch::kOff;
        const Image a = rendered(all, "transport-16"), b = rendered(unshaded, "transport-16");
        double most = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            most = std::max(most, static_cast<double>(std::abs(a.pixels[i] - b.pixels[i])));
        const double change = most / mean(b), figure = with.survey.haze.shaded;
        // The raster has 192 rays and a guessed cloud: within a factor of 2.
        EXPECT_GT(figure, 0.5 * change) << extinction;
        EXPECT_LT(figure, 2 * change + 1e-4) << extinction;
        EXPECT_EQ(planned, figure > 0.01 && with.plan.on(Effect::kAerialPerspective)) << extinction;
    }
}

TEST(Haze, ThreadsDoNotShow) {
    const SceneDraft draft = hazy_table();
    SceneDraft named = draft;
    named.accuracy.rung = "transport-16";
    EXPECT_EQ(test::render(named, 1).image.pixels, test::render(named, 3).image.pixels);
}

TEST(Haze, AnyLayerGivesFinitePictures) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto power = [&](double low, double high) {
        return std::pow(10, low + (high - low) * unit(random));
    };
    for (int i = 0; i < test::or_fewer(40, 6); ++i) {
        SceneDraft draft = hazy(test::balls({{{0, 1, 0}, 3, 1}, {{2, -1, 3}, 1, 8}}), power(-8, 6),
                                (unit(random) - 0.5) * power(0, 9), power(-9, 9));
        draft.sky = {};
        draft.haze->g = 1.998 * (unit(random) - 0.5);
        draft.sun.direction =
            glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
        if (i % 3 == 0) draft.camera.eye = {0, 0, power(-2, 6)};
        if (i % 5 == 0) draft.sun.direction = draft.camera.eye;  // shadows towards the eye
        if (i % 4 == 0) draft.camera.eye.y = (unit(random) - 0.5) * power(0, 9);
        if (i % 2 == 0) {
            draft.ground.emplace();
            draft.ground->height = -2 - power(-3, 6) * unit(random);
        }
        draft.camera.target = draft.camera.eye - glm::dvec3(0.1, 0.2, 1);
        draft.image.width = 24;
        draft.image.height = 16;
        if (i % 7 == 0) draft.image.background = Background::kTransparent;
        for (const char* rung : {"transport-16", "harris"}) {
            const Image image = rendered(draft, rung);
            for (const float value : image.pixels)
                ASSERT_TRUE(std::isfinite(value) && value >= 0) << i << " " << rung << " " << value;
        }
    }
}

}  // namespace
}  // namespace awan
