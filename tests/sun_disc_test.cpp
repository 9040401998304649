// The sun's disc in pictures: how much light it brings, what hides it, when it is there. No renderer is needed.
#include "core/draw/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/draw/march.h"
#include "core/pipeline.h"
#include "tests/march_lights.h"
#include "tests/scenes.h"

namespace awan {
namespace {

constexpr double kIrradiance = 3;

// A sun before the eye, 20 degrees up, and a ball of Gaussian matter `aside` units from the way to it.
SceneDraft sunny(double depth, double aside, double fov) {
    SceneDraft draft =
        test::balls({{{aside, 0, 0}, 1, depth / (0.5 * std::sqrt(2 * std::numbers::pi))}});
    draft.sun.elevation = 20;
    draft.sun.azimuth = 180;
    draft.sun.color = {1, 1, 1};
    draft.sun.intensity = kIrradiance;
    const glm::dvec3 to_sun = sun_direction(draft.sun);
    draft.camera.eye = -6.0 * to_sun;
    draft.camera.target = draft.camera.eye + glm::dvec3(0.01, 0.004, 0) + to_sun;
    draft.camera.fov = fov;
    draft.image.width = 120;
    draft.image.height = 90;
    draft.image.format = ImageFormat::kExr;
    draft.sun.disc = SunDisc::kShown;
    return draft;
}

Image black(const Scene& scene) {
    Image image{scene->image.width, scene->image.height, true, {}};
    image.pixels.assign(4 * image.pixel_count(), 0.0f);
    return image;
}

Image disc_of(const test::Stage& stage, int threads = 1, double most = INFINITY) {
    Image image = black(stage.scene);
    add_sun_disc(stage.scene, stage.view, stage.particles, true, most, threads, image);
    return image;
}

// Irradiance at the eye from the picture, red.
double irradiance(const test::Stage& stage, const Image& image) {
    const double tan = stage.view.tan_half_fov, side = 2 * tan / image.height;
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double u = ((x + .5) / image.width * 2 - 1) * tan * stage.view.aspect;
            const double v = (1 - (y + .5) / image.height * 2) * tan;
            sum += test::pixel(image, x, y).r * side * side * std::pow(1 + u * u + v * v, -1.5);
        }
    return sum;
}

TEST(SunDisc, BringsTheSunsIrradianceHoweverLargeItIs) {
    for (const double fov : {1.5, 5., 20., 60., 110.}) {
        const test::Stage stage = test::stage(sunny(1, 50, fov));
        EXPECT_NEAR(irradiance(stage, disc_of(stage)) / kIrradiance, 1, .01) << fov;
    }
}

// Where it stands within a pixel does not show.
TEST(SunDisc, HasNoStairs) {
    for (const double shift : {0., .0005, .0013, .0021}) {
        SceneDraft draft = sunny(1, 50, 30);
        draft.camera.target.x += shift;
        const test::Stage stage = test::stage(draft);
        EXPECT_NEAR(irradiance(stage, disc_of(stage)) / kIrradiance, 1, .01) << shift;
    }
}

// On film the limb's pixels are between the sky and the disc, as much as the disc covers of them.
TEST(SunDisc, HasALimbWithoutStairsOnFilm) {
    const test::Stage stage = test::stage(sunny(1, 50, 20));
    const Image image = disc_of(stage, 1, 4);
    double sum = 0;
    int between = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double r = test::pixel(image, x, y).r;
            EXPECT_LE(r, 4.0001);
            sum += r / 4;
            between += r > .2 && r < 3.8;
        }
    const double radius =
        .2665 * std::numbers::pi / 180 * image.height / (2 * stage.view.tan_half_fov);
    EXPECT_NEAR(sum, std::numbers::pi * radius * radius, .15);
    EXPECT_GE(between, 4);
}

TEST(SunDisc, IsDimmedByWhatStandsBeforeIt) {
    for (const double depth : {.1, 1., 5.}) {
        SceneDraft draft = sunny(depth, 0, 5);
        const test::Stage stage = test::stage(draft);
        EXPECT_NEAR(irradiance(stage, disc_of(stage)) / (kIrradiance * std::exp(-depth)), 1, .01);
        // Haze on its way to the eye, and a ball behind the eye.
        draft.haze = Haze{.extinction = .05, .height = 100, .scale_height = 1};
        const test::Stage hazy = test::stage(draft);
        const double way = (100 + 1 - draft.camera.eye.y) / sun_direction(draft.sun).y;
        EXPECT_NEAR(irradiance(hazy, disc_of(hazy)) / (kIrradiance * std::exp(-depth - .05 * way)),
                    1, .02);
        draft.haze.reset();
        draft.camera.eye = 6.0 * sun_direction(draft.sun);
        draft.camera.target = draft.camera.eye + sun_direction(draft.sun);
        const test::Stage past = test::stage(draft);
        EXPECT_NEAR(irradiance(past, disc_of(past)) / kIrradiance, 1, .01);
    }
}

// The march sees the same lumps.
TEST(SunDisc, IsDimmedByTheLumpsThatThePictureShows) {
    SceneDraft draft = sunny(2, 0, 1.5);
    draft.detail = Detail{};
    draft.detail->amount = 1;
    draft.accuracy.rung = "transport-16";
    test::effect(draft, Effect::kDetail) = Switch::kOn;
    const auto planned = plan_scene(test::valid(draft), 1, {});
    ASSERT_NE(planned->particles.detail, nullptr);
    const test::Stage stage{test::valid(draft), planned->particles, planned->survey.view};
    const Image light = disc_of(stage);
    const double disc = irradiance(stage, light) / kIrradiance;
    draft.image.background = Background::kTransparent;
    const test::Stage clear{test::valid(draft), planned->particles, planned->survey.view};
    const TransportLight none =
        test::grid_light(clear.scene, clear.particles, 8, 1, [](glm::dvec3) { return 0.0; });
    const Image cloud = test::marched(clear, none, 1);
    double through = 0, all = 0;
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x)
            if (test::pixel(light, x, y).r > 0) {
                through += 1 - test::pixel(cloud, x, y).a;
                ++all;
            }
    ASSERT_GT(all, 100);
    EXPECT_NEAR(disc, through / all, .05 * disc + .01);
}

TEST(SunDisc, IsThereWhereItIsAskedFor) {
    SceneDraft draft = sunny(1, 50, 20);
    draft.sky.none = false;
    EXPECT_TRUE(shows_sun_disc(draft));
    draft.sun.disc = SunDisc::kAutomatic;
    EXPECT_FALSE(shows_sun_disc(draft));
    draft.image.format = ImageFormat::kPng;
    EXPECT_TRUE(shows_sun_disc(draft));
    draft.sky.none = true;
    EXPECT_FALSE(shows_sun_disc(draft));
    draft.sun.disc = SunDisc::kShown;
    EXPECT_TRUE(shows_sun_disc(draft));
    draft.image.background = Background::kTransparent;
    EXPECT_FALSE(shows_sun_disc(draft));
}

TEST(SunDisc, IsNotSeenBehindTheEyeNorBelowTheGround) {
    SceneDraft draft = sunny(1, 50, 20);
    draft.sun.azimuth = 0;
    const test::Stage behind = test::stage(draft);
    EXPECT_EQ(disc_of(behind).pixels, black(behind.scene).pixels);
    // The half of a sun that has set halfway.
    draft.sun.azimuth = 180;
    draft.sun.elevation = 0;
    draft.ground = Ground{};
    draft.ground->height = -50;
    draft.camera.eye = {0, 0, 6};
    draft.camera.target = {0, 0, 0};
    const test::Stage setting = test::stage(draft);
    EXPECT_NEAR(irradiance(setting, disc_of(setting)) / kIrradiance, .5, .02);
}

TEST(SunDisc, HasAGlareInPicturesThatTakesItsLightFromIt) {
    SceneDraft draft = sunny(1, 50, 60);
    draft.image.format = ImageFormat::kPng;
    const test::Stage stage = test::stage(draft);
    const Image image = disc_of(stage);
    const double all = irradiance(stage, image);
    EXPECT_LT(all, 1.005 * kIrradiance);
    EXPECT_GT(all, .98 * kIrradiance);
    // Less and less away from the sun, and never none.
    double before = INFINITY;
    for (int x = 66; x < image.width; x += 6) {
        const double here = test::pixel(image, x, image.height / 2).r;
        EXPECT_LT(here, before);
        EXPECT_GT(here, 0);
        before = here;
    }
    for (int threads = 2; threads <= 3; ++threads)
        EXPECT_EQ(image.pixels, disc_of(stage, threads).pixels);
}

}  // namespace
}  // namespace awan
