// The truth against what is known exactly: laws, integrals, limits. No renderer is needed.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/truth/oracles.h"
#include "tests/patience.h"
#include "tests/truth_scenes.h"

namespace awan {
namespace {

using std::numbers::pi;
using test::mean_red;
using test::particles_of;
using test::sum_of;
using test::traced;
using test::walks;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// --- laws of light

TEST(Furnace, IsWhiteThroughNextEventsAndEscapes) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1}, {{1, 0.5, 0}, 1, 1}});
    draft.sky.none = false;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    draft.sun.intensity = 0;
    draft.medium.g = 0.5;
    draft.camera.eye = {0, 0, 6};
    draft.image.width = draft.image.height = 16;
    draft.image.background = Background::kSky;
    TruthOptions options;
    options.samples = 4096;
    options.sky = SkySampling::kNextEvent;
    // Three standard errors.
    EXPECT_NEAR(mean_red(mean_of(traced(draft, options))), 1, 3e-3);
    // Escaping paths of albedo 1 bring exactly 1 each: this counts no light, only losses.
    options.sky = SkySampling::kEscape;
    options.samples = 64;
    const Image escaped = mean_of(traced(draft, options));
    for (std::size_t i = 0; i < escaped.pixel_count(); ++i)
        ASSERT_NEAR(escaped.pixels[4 * i], 1, 1e-5);
}

TEST(Sky, EscapesAndNextEventsAgree) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1}});
    draft.sky.none = false;
    draft.sun.intensity = 0;
    draft.medium.albedo = 0.9;
    draft.camera.eye = {0, 3, 6};
    draft.image.width = draft.image.height = 12;
    draft.image.background = Background::kTransparent;
    TruthOptions options;
    options.samples = 2048;
    const double by_escape = mean_red(mean_of(traced(draft, options)));
    options.sky = SkySampling::kNextEvent;
    EXPECT_NEAR(mean_red(mean_of(traced(draft, options))) / by_escape, 1, 0.01);
}

TEST(Walk, AbsorbedAndEscapedIsAll) {
    const SceneDraft draft = test::balls({{{0, 0, 0}, 2, 3}});
    const truth::Matter matter = truth::make_matter(particles_of(draft), {0, 1, 0}, 1, {}).value();
    for (const double albedo : {1.0, 0.95, 0.3}) {
        truth::Setting setting;
        setting.matter = &matter;
        setting.albedo = albedo;
        setting.phase.g = 0.6;
        truth::Tally tally;
        const int n = 20'000;
        walks(setting, {0.5 * matter.top, {0, 0, 1}}, n, 5, tally);
        EXPECT_NEAR((tally.absorbed + tally.escaped) / n, 1, albedo == 1 ? 1e-12 : 0.01);
        EXPECT_EQ(tally.cut_off, 0);
        // By hand for weak scattering: of what leaves the middle, e^-tau escapes unscattered.
        if (albedo == 0.3) {
            const double straight =
                0.3 * std::exp(-3 * std::sqrt(pi / 2));  // and 9% of the rest at most
            EXPECT_GT(tally.escaped / n, straight);
            EXPECT_LT(tally.escaped / n, straight + 0.09);
        }
    }
}

TEST(Light, GoesBothWays) {
    // Sun and eye change places: a far eye sees the same flux.
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, 0.2, 1)),
                     b = glm::normalize(glm::dvec3(1, 0.4, -0.2));
    double seen[2];
    for (int way = 0; way < 2; ++way) {
        SceneDraft draft =
            test::balls({{{0, 0, 0}, 2, 2}, {{1.5, 0.3, -0.5}, 1, 5}, {{-1, 0.8, 1}, 1.4, 1}});
        draft.medium.g = 0.7;
        draft.sun.direction = way == 0 ? a : b;
        draft.camera.eye = 3000.0 * (way == 0 ? b : a);
        draft.camera.fov = 2 * std::atan(5.0 / 3000) * 180 / pi;
        draft.image.width = draft.image.height = 32;
        draft.image.background = Background::kTransparent;
        TruthOptions options;
        options.samples = 512;
        seen[way] = mean_red(mean_of(traced(draft, options)));
    }
    EXPECT_NEAR(seen[0] / seen[1], 1, 0.01);
}

TEST(Light, OfOrderOneIsTheLineIntegral) {
    for (const double g : {0.0, 0.85}) {
        SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1, {1, 0.8f, 0.5f}},
                                        {{1.5, 0.3, -0.5}, 1, 4, {0.2f, 1, 1}},
                                        {{-1, 0.8, 1}, 1.4, 1}});
        draft.medium.g = g;
        draft.medium.albedo = 0.9;
        draft.sun.intensity = 10;
        draft.camera.eye = {1, 2, 9};
        draft.image.width = 10;
        draft.image.height = 8;
        draft.image.background = Background::kTransparent;
        TruthOptions options;
        options.samples = 2048;
        options.max_orders = 1;
        const Image image = mean_of(traced(draft, options));
        const Scene scene = test::valid(draft);
        const ParticleSet particles = particles_of(draft);
        const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
        double brightest = 0;
        for (const float v : image.pixels) brightest = std::max(brightest, static_cast<double>(v));
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 10; ++x) {
                const PixelRay ray = pixel_ray(view, 10, 8, x, y);
                const glm::dvec3 exact =
                    single_scattering(scene, particles, ray.origin, ray.direction);
                const test::Pixel p = test::pixel(image, x, y);
                EXPECT_NEAR(p.r, exact.x, 0.006 * exact.x + 0.001 * brightest);
                EXPECT_NEAR(p.g, exact.y, 0.006 * exact.y + 0.001 * brightest);
                EXPECT_NEAR(p.b, exact.z, 0.006 * exact.z + 0.001 * brightest);
            }
    }
}

TEST(Light, OfThinMatterIsTheFormula) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1e-5}});
    draft.medium.g = 0.3;
    draft.image.width = draft.image.height = 1;
    draft.image.background = Background::kTransparent;
    draft.sun.direction = glm::dvec3(0.6, 0, 0.8);
    TruthOptions options;
    options.samples = 256;
    const test::Pixel p = test::pixel(mean_of(traced(draft, options)), 0, 0);
    const double depth = 1e-5 * std::sqrt(2 * pi);
    EXPECT_NEAR(p.a / depth, 1, 1e-4);
    EXPECT_NEAR(p.r / (depth * phase_value(draft.medium, -0.8) / (4 * pi)), 1, 1e-3);
}

TEST(Light, DrawnFromTheSunsSideIsTheSame) {
    // Whatever number of directions is drawn from the sun's side, the mean stays, also of each order.
    const SceneDraft draft = test::balls({{{0, 0, 0}, 2, 4}, {{1.5, 0.3, -0.5}, 1, 8}});
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, 0.7, -0.4));
    const truth::Matter matter = truth::make_matter(particles_of(draft), to_sun, 1, {}).value();
    for (const std::uint32_t orders : {2u, 5u, kMaxOrders})
        for (const double g : {0.6, -0.5, 0.8}) {
            double mean[3], noise[3];
            const int choices[3] = {0, 1, 7};
            for (int c = 0; c < 3; ++c) {
                truth::Setting setting;
                setting.matter = &matter;
                setting.phase.g = g;
                setting.phase.cornette_shanks = g == 0.6;
                setting.to_sun = to_sun;
                setting.sun_irradiance = glm::dvec3(1);
                setting.max_orders = orders;
                setting.from_sun = choices[c];
                truth::Tally tally;
                const int n = 40'000;
                double sum = 0, square = 0;
                for (const truth::Brought& one : walks(setting, {0.4 * matter.top, {0, 0, -1}}, n,
                                                       static_cast<std::uint64_t>(c), tally)) {
                    sum += one.radiance.x;
                    square += one.radiance.x * one.radiance.x;
                }
                mean[c] = sum / n;
                noise[c] = std::sqrt((square / n - mean[c] * mean[c]) / n);
            }
            for (int c = 1; c < 3; ++c) {
                EXPECT_NEAR(mean[c], mean[0], 4.5 * std::hypot(noise[0], noise[c]))
                    << g << ' ' << orders;
                EXPECT_LT(noise[c], 0.05 * mean[0]);
            }
        }
}

// Absorption in particles of a colour, or by an albedo of the same: one law, and the same light, from whichever side
// the directions are drawn.
TEST(Light, DrawnFromTheSunsSideIsAbsorbedAsFromTheEyes) {
    const glm::vec3 color(0.9F, 0.6F, 0.3F);
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, 0.7, -0.4));
    const double albedo = 0.8;
    struct Mean {
        glm::dvec3 value{0}, noise{0};
    };
    const auto mean = [&](const glm::vec3& of_matter, const glm::dvec3& wanted, double of_setting,
                          int from_sun) {
        SceneDraft draft =
            test::balls({{{0, 0, 0}, 2, 4, of_matter}, {{1.5, 0.3, -0.5}, 1, 8, of_matter}});
        const truth::Matter matter = truth::make_matter(particles_of(draft), to_sun, 1, {}).value();
        truth::Setting setting;
        setting.matter = &matter;
        setting.phase.g = 0.7;
        setting.albedo = of_setting;
        setting.to_sun = to_sun;
        setting.sun_irradiance = wanted;
        setting.from_sun = from_sun;
        truth::Tally tally;
        const int n = 30'000;
        glm::dvec3 sum(0), square(0);
        for (const truth::Brought& one : walks(setting, {0.4 * matter.top, {0, 0, -1}}, n,
                                               static_cast<std::uint64_t>(3 + from_sun), tally)) {
            sum += one.radiance;
            square += one.radiance * one.radiance;
        }
        const glm::dvec3 value = sum / (1.0 * n);
        return Mean{value,
                    glm::sqrt(glm::max(square / (1.0 * n) - value * value, 0.0) / (1.0 * n))};
    };
    const Mean eye = mean(color, glm::dvec3(1), albedo, 0);
    const Mean sun = mean(color, glm::dvec3(1), albedo, 7);
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 one(0);
        one[c] = 1;
        const Mean grey = mean(glm::vec3(1), one, albedo * static_cast<double>(color[c]), 7);
        EXPECT_NEAR(sun.value[c], eye.value[c], 4.5 * std::hypot(sun.noise[c], eye.noise[c])) << c;
        EXPECT_NEAR(sun.value[c], grey.value[c], 4.5 * std::hypot(sun.noise[c], grey.noise[c]))
            << c;
        EXPECT_LT(sun.noise[c], 0.04 * sun.value[c]);
    }
}

// --- ground

truth::Setting over_ground(const truth::Matter& matter, double height) {
    truth::Setting setting;
    setting.matter = &matter;
    setting.has_ground = true;
    setting.ground_height = height;
    return setting;
}

TEST(Ground, AloneIsLambertian) {
    const truth::Matter nothing;
    truth::Setting setting = over_ground(nothing, 0);
    setting.ground_albedo = {0.2, 0.5, 1};
    setting.to_sun = glm::normalize(glm::dvec3(1, 1, 0));
    setting.sun_irradiance = glm::dvec3(3);
    setting.dome.shines = true;
    setting.dome.zenith = setting.dome.horizon = glm::dvec3(0.7);
    for (const SkySampling sky : {SkySampling::kEscape, SkySampling::kNextEvent}) {
        setting.sky = sky;
        truth::Tally tally;
        truth::Start start;
        start.on_ground = true;
        const glm::dvec3 sum = sum_of(walks(setting, start, 2000, 1, tally));
        const double white = 3 * std::sqrt(0.5) / pi + 0.7;
        // Weights are floats.
        EXPECT_NEAR(sum.x / 2000, 0.2 * white, 1e-7);
        EXPECT_NEAR(sum.z / 2000, white, 1e-7);
    }
    setting.to_sun = {0.6, -0.8, 0};  // a sun below: no light of it
    truth::Tally tally;
    truth::Start start;
    start.on_ground = true;
    EXPECT_NEAR(sum_of(walks(setting, start, 1, 1, tally)).z, 0.7, 1e-7);
}

TEST(Ground, HasTheCloudsShadow) {
    const ParticleSet one = particles_of({{{0, 5, 0}, 2, 2}});
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1, 1, 0));
    const truth::Matter matter = truth::make_matter(one, to_sun, 1, {}).value();
    const auto cells = [&](const glm::dvec3& p) { return (p - matter.origin) / matter.cell; };
    truth::Setting setting = over_ground(matter, cells({0, -3, 0}).y);
    setting.ground_albedo = glm::dvec3(0.5);
    setting.to_sun = to_sun;
    setting.sun_irradiance = glm::dvec3(1);
    setting.albedo = 0;  // nothing scattered: only what comes straight through
    for (const double x : {-8.0, -7.3, -6.0, 3.0}) {
        truth::Tally tally;
        const glm::dvec3 p(x, -3, 0.2);
        const double through = std::exp(-line_optical_depth(one, p, to_sun, 0, kInfinite));
        // Each path gets through to a point of the sun's disc or not: of the mean, 3.4 standard errors are allowed at
        // worst.
        constexpr int kPaths = 40000;
        truth::Start start{cells(p)};
        start.on_ground = true;
        const double sum = sum_of(walks(setting, start, kPaths, 1, tally)).x;
        EXPECT_NEAR(sum / kPaths, 0.5 / pi * to_sun.y * through, 0.003 / pi);
    }
}

TEST(Ground, OfAWhiteFurnaceIsWhite) {
    const SceneDraft draft = test::balls({{{0, 0, 0}, 2, 2}});
    const truth::Matter matter = truth::make_matter(particles_of(draft), {0, 1, 0}, 1, {}).value();
    truth::Setting setting = over_ground(matter, 0.3 * matter.top.y);
    setting.dome.shines = true;
    setting.ground_albedo = setting.dome.horizon = setting.dome.zenith = glm::dvec3(1);
    for (const SkySampling sky : {SkySampling::kEscape, SkySampling::kNextEvent}) {
        setting.sky = sky;
        truth::Tally tally;
        const int n = 40'000;
        truth::Start below{{0.4 * matter.top.x, setting.ground_height, 20}};
        below.on_ground = true;
        const double sum =
            sum_of(walks(setting, below, n / 2, 1, tally)).x +
            sum_of(walks(setting, {0.5 * matter.top, {0, 0.6, 0.8}}, n / 2, 2, tally)).x;
        EXPECT_NEAR(sum / n, 1, sky == SkySampling::kEscape ? 1e-9 : 0.02);
        EXPECT_NEAR(tally.escaped / n, 1, 1e-9);
    }
}

TEST(Ground, IsSeenFromAboveOnly) {
    const truth::Matter nothing;
    const truth::Setting setting = over_ground(nothing, 2);
    EXPECT_NEAR(ground_ahead(setting, {0, 5, 0}, {0, -1, 0}), 3, 1e-12);
    EXPECT_EQ(ground_ahead(setting, {0, 5, 0}, {0, 1, 0}), kInfinite);
    EXPECT_EQ(ground_ahead(setting, {0, 1, 0}, {0, 1, 0}), kInfinite);
    EXPECT_EQ(ground_ahead(setting, {0, 2, 0}, {1, 0, 0}), kInfinite);
}

TEST(Ground, StandsInThePicture) {
    SceneDraft draft = test::balls({{{0, 5, 0}, 2, 1}});
    draft.ground = Ground{-3, glm::dvec3(0.5)};
    draft.accuracy.rung = "truth";
    draft.image.width = draft.image.height = 12;
    draft.image.background = Background::kSky;
    draft.camera.eye = {0, 8, 30};
    auto scene = validate(draft);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    const ParticleSet particles = generate(*scene, 1, {}).value();
    const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
    TruthOptions options;
    options.samples = 64;
    const Image image = mean_of(trace_truth(*scene, particles, view, options, {}, {}).value());
    const test::Pixel corner = test::pixel(image, 0, 11);
    EXPECT_EQ(corner.a, 1);
    EXPECT_NEAR(corner.r, 0.5 / pi * sun_direction(draft.sun).y, 0.1 * corner.r);
}

// --- pictures

SceneDraft small_table() {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 20;
    draft.image.height = 14;
    draft.image.background = Background::kTransparent;
    return draft;
}

TEST(Picture, DoesNotDependOnThreads) {
    TruthOptions options;
    options.samples = 8;
    const TruthImage one = traced(small_table(), options);
    options.threads = 3;
    const TruthImage three = traced(small_table(), options);
    EXPECT_EQ(one.half_a.pixels, three.half_a.pixels);
    EXPECT_EQ(one.half_b.pixels, three.half_b.pixels);
    EXPECT_EQ(one.scatterings, three.scatterings);
    options.seed = 2;
    EXPECT_NE(traced(small_table(), options).half_a.pixels, one.half_a.pixels);
}

TEST(Picture, HalvesAreIndependent) {
    SceneDraft draft = small_table();
    draft.medium.g = 0.3;
    TruthOptions options;
    options.samples = 32;
    const TruthImage truth = traced(draft, options);
    options.samples = 1024;
    options.seed = 99;
    const Image known = mean_of(traced(draft, options));
    double product = 0, squares = 0, product_square = 0;
    for (std::size_t i = 0; i < known.pixel_count(); ++i) {
        const double a = static_cast<double>(truth.half_a.pixels[4 * i] - known.pixels[4 * i]);
        const double b = static_cast<double>(truth.half_b.pixels[4 * i] - known.pixels[4 * i]);
        product += a * b;
        product_square += a * a * b * b;
        squares += 0.5 * (a * a + b * b);
    }
    EXPECT_GT(squares, 0);
    // The known picture's own noise is in both: 1 / 64 of a half's.
    EXPECT_NEAR(product / squares, 1.0 / 64, 4 * std::sqrt(product_square) / squares);
}

TEST(Picture, AlphaIsExactAndTheSkyStandsBehind) {
    SceneDraft draft = small_table();
    const ParticleSet particles = particles_of(draft);
    const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
    TruthOptions options;
    options.samples = 4;
    const Image clear = mean_of(traced(draft, options));
    draft.image.background = Background::kSky;
    const Image opaque = mean_of(traced(draft, options));
    EXPECT_TRUE(opaque.opaque);
    EXPECT_FALSE(clear.opaque);
    for (int y = 0; y < 14; ++y)
        for (int x = 0; x < 20; ++x) {
            const PixelRay ray = pixel_ray(view, 20, 14, x, y);
            const double depth =
                line_optical_depth(particles, ray.origin, ray.direction, 0, kInfinite);
            const test::Pixel p = test::pixel(clear, x, y), q = test::pixel(opaque, x, y);
            EXPECT_NEAR(p.a, -std::expm1(-depth), 1e-7 + 1e-6 * p.a);
            EXPECT_EQ(q.a, 1);
            const double up = std::max(ray.direction.y, 0.0);
            const double share = 1.09 * up * up / (up * up + 0.09);
            const double blue = (0.95 + share * (0.72 - 0.95)) * 1.7;
            EXPECT_NEAR(q.b - p.b, std::exp(-depth) * blue, 1e-5);
        }
}

TEST(Picture, StopsWhenNobodyWaits) {
    const Scene scene = test::valid(test::table_4_4());
    const ParticleSet particles = particles_of(test::table_4_4());
    const View view = resolve_view(scene->camera, scene->image, bounds_of(particles));
    Deadline deadline;
    deadline.until = Deadline::Clock::now() + std::chrono::milliseconds(300);
    TruthOptions options;
    options.samples = 1u << 20;
    options.threads = 2;
    const auto late = trace_truth(scene, particles, view, options, {}, deadline);
    ASSERT_FALSE(late.ok());
    EXPECT_EQ(late.error().code, ErrorCode::kOverDeadline);
    EXPECT_LT(Deadline::Clock::now() - deadline.until, test::patience(2));
    deadline = {};
    deadline.cancelled = std::make_shared<std::atomic<bool>>(true);
    EXPECT_EQ(trace_truth(scene, particles, view, options, {}, deadline).error().code,
              ErrorCode::kCancelled);
}

// Its first paths tell that there will be no picture in time: nobody waits for the deadline to hear of it.
TEST(Picture, IsGivenUpAsSoonAsItIsHopeless) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = draft.image.height = 160;
    const Scene scene = test::valid(draft);
    const ParticleSet particles = particles_of(draft);
    const View view = resolve_view(scene->camera, scene->image, bounds_of(particles));
    TruthOptions options;
    options.samples = test::or_fewer(16u, 4u);
    options.threads = 2;
    const auto start = Deadline::Clock::now();
    ASSERT_TRUE(trace_truth(scene, particles, view, options, {}, {}).ok());
    const auto took = Deadline::Clock::now() - start;
    options.samples *= 100;
    Deadline deadline;
    deadline.until = Deadline::Clock::now() + 10 * took;
    const auto late = trace_truth(scene, particles, view, options, {}, deadline);
    ASSERT_FALSE(late.ok());
    EXPECT_EQ(late.error().code, ErrorCode::kOverDeadline);
    EXPECT_LT(Deadline::Clock::now(), deadline.until);
    EXPECT_NE(late.error().message.find("by its first paths"), std::string::npos)
        << late.error().message;
    // One that has time enough is not.
    options.samples /= 100;
    deadline.until = Deadline::Clock::now() + 10 * took;
    EXPECT_TRUE(trace_truth(scene, particles, view, options, {}, deadline).ok());
}

TEST(Picture, TellsItsProgress) {
    SceneDraft draft = small_table();
    const Scene scene = test::valid(draft);
    const ParticleSet particles = particles_of(draft);
    const View view = resolve_view(scene->camera, scene->image, bounds_of(particles));
    TruthOptions options;
    options.samples = 2;
    options.threads = 2;
    std::vector<double> told;
    ASSERT_TRUE(
        trace_truth(scene, particles, view, options, [&](double d) { told.push_back(d); }, {})
            .ok());
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1);
}

}  // namespace
}  // namespace awan
