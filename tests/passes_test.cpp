// Both passes on the software renderer, against closed forms in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "core/light/light.h"
#include "core/survey/gauss.h"
#include "core/survey/narrow.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::Ball;
using test::balls;
using test::effect;
using test::pixel;
using test::Pixel;
using test::render;

const double kRootTwoPi = std::sqrt(2 * std::numbers::pi);

// A particle is cut where its optical depth is 5e-4, and scaled by as much; several overlap in these scenes.
constexpr double kExact = 1.5e-3;

double henyey_greenstein(double cosine, double g) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

// Optical depth of a ball along a ray from the eye outward.
double depth_along(const test::Ray& ray, const Ball& ball) {
    const double s = ball.radius / 2;
    const glm::dvec3 q = ball.center - ray.eye;
    const double t = glm::dot(q, ray.direction);
    const glm::dvec3 miss = q - ray.direction * t;
    return ball.density * s * kRootTwoPi * std::exp(-glm::dot(miss, miss) / (2 * s * s)) * 0.5 *
           std::erfc(-t / (s * std::numbers::sqrt2));
}

// Largest difference between a picture's alpha and the exact transmittance of the balls.
double alpha_error(const SceneDraft& draft, const std::vector<Ball>& list) {
    const Rendered rendered = render(draft);
    double worst = 0;
    for (int y = 0; y < rendered.image.height; ++y)
        for (int x = 0; x < rendered.image.width; ++x) {
            double tau = 0;
            for (const Ball& ball : list)
                tau += depth_along(test::ray(rendered.survey.view, rendered.image, x, y), ball);
            worst = std::max(worst, std::abs(pixel(rendered.image, x, y).a - -std::expm1(-tau)));
        }
    return worst;
}

SceneDraft transparent(const std::vector<Ball>& list) {
    SceneDraft draft = balls(list);
    draft.image.background = Background::kTransparent;
    return draft;
}

bool all_finite(const Image& image, double most = 1e30) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [&](float v) {
        return std::isfinite(v) && v >= 0 && static_cast<double>(v) <= most;
    });
}

double largest_difference(const Image& a, const Image& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        worst = std::max(worst, static_cast<double>(std::abs(a.pixels[i] - b.pixels[i])));
    return worst;
}

// --- the eye pass
// ---------------------------------------------------------------------------------

TEST(Draw, AnEmptySceneIsItsBackground) {
    SceneDraft draft = balls({});
    draft.sky.none = false;
    draft.sky.intensity = 2;
    const Rendered rendered = render(draft);
    for (const int y : {0, 20, 47}) {
        const glm::dvec3 d = test::ray(rendered.survey.view, rendered.image, 30, y).direction;
        const double up = std::max(0.0, d.y);
        const glm::dvec3 expected =
            2.0 * glm::mix(draft.sky.horizon, draft.sky.zenith, 1.09 * up * up / (up * up + 0.09));
        const Pixel p = pixel(rendered.image, 30, y);
        EXPECT_NEAR(p.r, expected.x, 1e-5);
        EXPECT_NEAR(p.b, expected.z, 1e-5);
        EXPECT_EQ(p.a, 1);
    }
    EXPECT_TRUE(render(transparent({})).image.pixels == std::vector<float>(64 * 48 * 4, 0.F));
}

TEST(Draw, TransmittanceIsExactFromOutside) {
    const std::vector<Ball> list = {{{0, 0, 0}, 4, 0.5}, {{3, 1, -2}, 2, 3}, {{-2, -1, 5}, 1, 0.2}};
    EXPECT_LT(alpha_error(transparent(list), list), kExact);
}

TEST(Draw, TransmittanceIsExactAtAWideAngle) {
    const std::vector<Ball> list = {
        {{14, 9, 5}, 4, 0.5}, {{-25, 2, 16}, 3, 1}, {{5, -18, 11}, 5, 0.3}};
    SceneDraft draft = transparent(list);
    draft.camera.fov = 140;
    EXPECT_LT(alpha_error(draft, list), kExact);
}

TEST(Draw, TransmittanceIsExactFromInside) {
    const std::vector<Ball> list = {
        {{0, 0, 20}, 4, 0.3}, {{1, 0, 19}, 6, 0.2}, {{0, 0, 23}, 3, 0.4}, {{0, 0, 0}, 8, 0.1}};
    EXPECT_LT(alpha_error(transparent(list), list), kExact);
    SceneDraft wide = transparent(list);
    wide.camera.fov = 120;
    EXPECT_LT(alpha_error(wide, list), kExact);
}

TEST(Draw, ASplatMayBeLargerThanAnyPointSprite) {
    const std::vector<Ball> list = {{{0, 0, 0}, 30, 0.1}};
    SceneDraft draft = transparent(list);
    draft.camera.eye = {0, 0, 70};
    draft.image.width = 700;
    draft.image.height = 600;
    EXPECT_LT(alpha_error(draft, list), kExact);
}

TEST(Draw, SpecksKeepTheAreaThatTheyCover) {
    // s is 1/40 of a pixel: what the pixels take together is what the particle takes.
    const double tan_half = std::tan(20 * std::numbers::pi / 180),
                 pixel_size = 2 * tan_half * 20 / 48;
    const double radius = 2 * pixel_size / 40, density = 40;
    const Rendered rendered = render(transparent({{{0.01, 0.02, 0}, radius, density}}));
    double sum = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) sum += pixel(rendered.image, x, y).a;
    const double s = radius / 2;
    const double exact = covered_area(density * s * kRootTwoPi) * 2 * std::numbers::pi * s * s /
                         (pixel_size * pixel_size);
    EXPECT_NEAR(sum / exact, 1, 0.02);
}

TEST(Draw, FarFromTheOriginIsTheSamePicture) {
    const std::vector<Ball> list = {{{0, 0, 0}, 4, 0.5}, {{3, 1, -2}, 2, 3}};
    SceneDraft draft = transparent(list);
    const Image near = render(draft).image;
    const glm::dvec3 away(9e8, 9e8, -9e8);
    for (glm::dvec3& p : draft.clouds[0].ready.positions) p += away;
    draft.camera.eye += away;
    draft.camera.target += away;
    EXPECT_LT(largest_difference(render(draft).image, near), 2e-6);
}

TEST(Draw, TheOrderOfTheListDoesNotMatter) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4, 4);
    std::vector<Ball> list;
    for (int i = 0; i < 300; ++i)
        list.push_back({{place(random), place(random), place(random)},
                        1 + 0.2 * place(random),
                        1,
                        {1, 0.5F, 0.2F}});
    const Image one = render(transparent(list)).image;
    std::shuffle(list.begin(), list.end(), random);
    // Sums of light depths are rounded in another order.
    EXPECT_LT(largest_difference(render(transparent(list)).image, one), 1e-5);
}

TEST(Draw, ThousandsInOnePlaceAreOne) {
    // Half of them white, half black: no order makes the picture white or black.
    std::vector<Ball> list;
    for (int i = 0; i < 2000; ++i)
        list.push_back({{0, 0, 0}, 4, 0.01, glm::vec3(i < 1000 ? 1 : 0)});
    SceneDraft draft = transparent(list);
    effect(draft, Effect::kSelfShadow) = Switch::kOff;
    const Pixel many = pixel(render(draft).image, 32, 24);
    SceneDraft one = transparent({{{0, 0, 0}, 4, 20, glm::vec3(0.5F)}});
    effect(one, Effect::kSelfShadow) = Switch::kOff;
    const Pixel merged = pixel(render(one).image, 32, 24);
    EXPECT_NEAR(many.r / merged.r, 1, 1e-3);
    EXPECT_NEAR(many.a, merged.a, 1e-5);
}

TEST(Draw, AHundredThousandThinLayersKeepTheirTransmittance) {
    std::vector<Ball> list;
    for (int i = 0; i < 100000; ++i)
        list.push_back({{0, 0, -10 + i * 1e-4}, 40, 1e-5 / (20 * kRootTwoPi)});
    SceneDraft draft = transparent(list);
    draft.image.width = draft.image.height = 8;
    draft.camera.eye = {0, 0, 200};
    const Rendered rendered = render(draft);
    double tau = 0;
    for (const Ball& ball : list)
        tau += depth_along(test::ray(rendered.survey.view, rendered.image, 4, 4), ball);
    EXPECT_GT(tau, 0.5);
    EXPECT_NEAR((1 - pixel(rendered.image, 4, 4).a) / std::exp(-tau), 1,
                3e-3);  // 2.2e-3 are the cut at 3.5 s
}

TEST(Draw, PicturesOfEveryShape) {
    for (const auto& [width, height] : {std::pair{1, 1}, {8192, 16}, {3, 2000}, {17, 33}}) {
        SceneDraft draft = transparent({{{0, 0, 0}, 4, 0.5}});
        draft.image.width = width;
        draft.image.height = height;
        const Rendered rendered = render(draft);
        ASSERT_EQ(rendered.image.pixels.size(),
                  static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
        if (height < 16) continue;  // only there is the ball wider than a pixel
        const test::Ray middle =
            test::ray(rendered.survey.view, rendered.image, width / 2, height / 2);
        EXPECT_NEAR(pixel(rendered.image, width / 2, height / 2).a,
                    -std::expm1(-depth_along(middle, {{0, 0, 0}, 4, 0.5})), kExact);
    }
}

// --- light
// ----------------------------------------------------------------------------------------

TEST(Light, ThinMatterScattersOnce) {
    // radiance = albedo * optical depth * intensity * p / 4 pi, at several angles and with both
    // phase functions.
    for (const double elevation : {-60.0, 0.0, 30.0, 90.0})
        for (const double g : {0.0, 0.5, 0.85, -0.4}) {
            SceneDraft draft = transparent({{{0, 0, 0}, 4, 1e-3}});
            draft.medium.g = g;
            draft.medium.albedo = 0.8;
            draft.sun.elevation = elevation;
            draft.sun.intensity = 3;
            const Rendered rendered = render(draft);
            const test::Ray middle = test::ray(rendered.survey.view, rendered.image, 40, 20);
            const double tau = depth_along(middle, {{0, 0, 0}, 4, 1e-3});
            const double cosine = glm::dot(middle.direction, sun_direction(draft.sun));
            const double expected =
                0.8 * tau * 3 * henyey_greenstein(cosine, g) / (4 * std::numbers::pi);
            EXPECT_NEAR(pixel(rendered.image, 40, 20).g / expected, 1, 4e-3)
                << elevation << " " << g;
        }
}

TEST(Light, WhiteFurnaceIsInvisibleWithoutShadow) {
    // Equal light from everywhere and no absorption: without self-shadow the cloud cannot be seen.
    SceneDraft draft = test::table_4_4();
    draft.clouds[0].cubes.resize(1);
    draft.medium.albedo = 1;
    draft.sun.intensity = 0;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    draft.image.width = 64;
    draft.image.height = 48;
    effect(draft, Effect::kSelfShadow) = Switch::kOff;
    for (const float v : render(draft).image.pixels) ASSERT_NEAR(v, 1, 2e-5);
}

TEST(Light, AFurnaceNeverExceedsOne) {
    for (const double density : {0.1, 1.0, 100.0, 1e6}) {
        SceneDraft draft = test::table_4_4();
        draft.density = density;
        draft.medium.albedo = 1;
        draft.sun.intensity = 0;
        draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
        draft.sky.intensity = 1;
        draft.image.width = 64;
        draft.image.height = 48;
        EXPECT_TRUE(all_finite(render(draft).image, 1.00002)) << density;
    }
}

// Light on particles in a row towards the sun: the recurrence (3.12) in double, on the lines
// through the six points around each centre where the light is sampled.
TEST(Light, TheRecurrenceOfHarris) {
    const std::vector<double> depths = {0.3, 2.0, 0.01, 1.0, 0.7, 0.1};
    std::vector<Ball> list;
    for (std::size_t k = 0; k < depths.size(); ++k)
        list.push_back({{0, -10.0 * static_cast<double>(k), 0}, 2, depths[k] / kRootTwoPi});
    SceneDraft draft = transparent(list);
    draft.sun.elevation = 90;
    draft.medium.g = 0.5;
    auto planned = plan_scene(test::valid(draft), 1, {});
    ASSERT_TRUE(planned.ok());
    const auto lighting =
        light(test::valid(draft), planned->particles, planned->plan, test::device(), {});
    ASSERT_TRUE(lighting.ok());
    const double gain = gathering_fraction(draft.medium, kSunGathering);
    for (std::size_t k = 0; k < depths.size(); ++k) {
        double direct = 0, whole = 0;
        for (int point = 0; point < 6; ++point) {
            glm::dvec3 p = list[k].center;
            p[point / 2] += point % 2 == 0 ? 1.2 : -1.2;
            double passed = 1, gained = 1;
            for (std::size_t j = 0; j < depths.size(); ++j) {
                const double share =
                    normal_cdf(list[j].center.y - p.y);  // of the mass between sun and p
                const double t = std::exp(-depths[j] * std::exp(-(p.x * p.x + p.z * p.z) / 2));
                passed *= std::pow(t, share);
                gained *= std::pow(t + gain * (1 - t), share);
            }
            direct += passed / 6;
            whole += gained / 6;
        }
        const ParticleLight& got = lighting->particles[k];
        EXPECT_NEAR(static_cast<double>(got.direct.w) / direct, 1, 0.1) << k;
        EXPECT_NEAR(static_cast<double>(got.direct.w + got.scattered.w) / whole, 1, 0.05) << k;
    }
}

TEST(Light, NeverGrowsWhateverThePhaseFunction) {
    for (const double g : {-0.999, 0.0, 0.999})
        for (const double density : {1e-6, 1.0, 1e6}) {
            SceneDraft draft = test::table_4_4();
            draft.density = density;
            draft.medium.g = g;
            draft.medium.albedo = 1;
            auto planned = plan_scene(test::valid(draft), 1, {});
            auto lighting =
                light(test::valid(draft), planned->particles, planned->plan, test::device(), {});
            ASSERT_TRUE(lighting.ok());
            for (const ParticleLight& p : lighting->particles) {
                ASSERT_GE(p.direct.w, 0);
                ASSERT_GE(p.scattered.w, 0);
                ASSERT_LE(p.direct.w + p.scattered.w, 1.0001F);
                // Deep in a layer without end there is five times a beam's light, in a wide cloud .8 of it.
                ASSERT_GE(p.diffuse.w, 0);
                ASSERT_LE(p.diffuse.w, 4.0001F);
                // Half a sky from either side: together no more than all of it.
                ASSERT_LE(p.from_above.w + p.from_below.w, 2.0002F);
                ASSERT_TRUE(
                    std::isfinite(p.direct.x + p.scattered.y + p.from_above.z + p.from_below.x));
            }
        }
}

TEST(Light, TheSideToTheSunIsBrighter) {
    SceneDraft draft = transparent({{{0, 0, 0}, 6, 2}});
    draft.sun.direction = glm::dvec3(1, 0, 0);
    effect(draft, Effect::kMultipleScattering) = Switch::kOff;
    draft.medium.g = 0;
    const Image image = render(draft).image;
    EXPECT_GT(pixel(image, 42, 24).r, 1.5 * pixel(image, 21, 24).r);
}

TEST(Light, MirrorScenesGiveMirrorPictures) {
    std::vector<Ball> list = {{{1, 0.5, 0}, 3, 1}, {{-2, 1, 1}, 2, 2}, {{3, -1, -2}, 1, 3}};
    SceneDraft draft = transparent(list);
    draft.sun.direction = glm::dvec3(0.5, 0.7, 0.2);
    const Image one = render(draft).image;
    for (glm::dvec3& p : draft.clouds[0].ready.positions) p.x = -p.x;
    draft.sun.direction->x *= -1;
    const Image other = render(draft).image;
    double worst = 0, brightest = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            worst = std::max(worst, std::abs(pixel(one, x, y).r - pixel(other, 63 - x, y).r));
            brightest = std::max(brightest, pixel(one, x, y).r);
        }
    // The light's volume has its own axes, which do not mirror: its texels lie elsewhere.
    EXPECT_LT(worst, 0.03 * brightest);
}

// --- hard cases
// -----------------------------------------------------------------------------------

TEST(HardCases, StayFiniteAndWithinBounds) {
    const auto check = [](const char* what, const SceneDraft& draft, double most) {
        EXPECT_TRUE(all_finite(render(draft).image, most)) << what;
    };
    const double peak = 2 / (1e-3 * 1e-3);  // of the phase function at |g| = .999
    for (const double density : {0.0, 1e-30, 1e6}) {
        SceneDraft draft = transparent({{{0, 0, 0}, 4, 1}, {{0, 0, 0}, 1e6, 1e-9}});
        draft.density = density;
        check("density", draft, 1.01);
    }
    for (const double g : {0.999, -0.999}) {
        SceneDraft draft = transparent({{{0, 0, 0}, 4, 1}});
        draft.medium.g = g;
        draft.sun.direction = glm::dvec3(0, 0, -1);  // straight into the sun
        check("g", draft, peak);
    }
    for (const double elevation : {90.0, -90.0}) {
        SceneDraft draft = transparent({{{0, 0, 0}, 4, 1}});
        draft.sun.elevation = elevation;
        check("sun along up", draft, 10);
    }
    check("radii of all sizes",
          transparent({{{0, 0, 0}, 1e-6, 1}, {{1, 0, 0}, 1, 1}, {{0, 2, 0}, 1e6, 1e-7}}), 10);
    SceneDraft at_center = transparent({{{0, 0, 20}, 1e-6, 1e6}, {{0, 0, 20}, 3, 1}});
    check("eye at a centre", at_center, 10);
    effect(at_center, Effect::kInterior) = Switch::kOff;
    check("eye at a centre, not as an interior", at_center, 10);
    SceneDraft above = transparent({{{0, 5, 20}, 1, 1}, {{0, -30, 20}, 9, 1}});
    above.camera.fov = 170;
    effect(above, Effect::kInterior) = Switch::kOff;
    check("straight above the eye", above, 10);
    check("cubes beyond each other's precision",
          transparent({{{1e9, 0, 0}, 1, 1}, {{-1e9, 0, 0}, 1, 1}, {{0, 0, 0}, 1, 1}}), 10);
}

TEST(HardCases, TheSamePictureEveryTimeAndForEveryNumberOfThreads) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 200;
    draft.image.height = 150;
    const Image one = render(draft, 1).image;
    for (const int threads : {1, 2, 5}) EXPECT_EQ(render(draft, threads).image.pixels, one.pixels);
}

TEST(HardCases, ADeadlineStopsTheRender) {
    SceneDraft draft = test::table_4_4();
    Deadline over;
    over.until = Deadline::Clock::now();
    const auto rendered =
        render_scene(test::valid(draft), {&test::device(), 1, nullptr, {}, {}}, over);
    ASSERT_FALSE(rendered.ok());
    EXPECT_EQ(rendered.error().code, ErrorCode::kOverDeadline);
}

}  // namespace
}  // namespace awan
