// Matter that is narrower than a pixel: what a pixel shows of it is the mean over its area.
#include <gtest/gtest.h>

#include <random>

#include "core/survey/narrow.h"
#include "core/truth/path_tracer.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

using test::Ball;

constexpr double kSize = 10;  // of the clouds below

// A cloud of particles of radius 0.65 where there are 600, denser in its middle.
std::vector<Ball> cloud_of(int count, double density, const glm::dvec3& middle = {0, 0, 0}) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, kSize / 5);
    std::vector<Ball> list;
    for (int i = 0; i < count; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        list.push_back(
            {middle + glm::dvec3(x, 0.6 * y, z), 0.65 * std::cbrt(600.0 / count), density});
    }
    return list;
}

// A picture of `pixels` a side, each of them `pixel` scene units wide at the origin, which lies off its middle.
test::Stage far_stage(const std::vector<Ball>& list, double distance, double pixel, int pixels) {
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = draft.image.height = pixels;
    draft.camera.eye = {0, 0, distance};
    draft.camera.target = pixel * glm::dvec3(0.13, 0.37, 0);
    test::Stage stage = test::stage(draft);
    stage.view.tan_half_fov = 0.5 * pixel * pixels / distance;
    return stage;
}

// Sums over the picture, times a pixel's area.
struct Sums {
    double alpha = 0, light = 0;
};
Sums sums_of(const Image& image, double pixel) {
    Sums sums;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        sums.alpha += static_cast<double>(image.pixels[4 * i + 3]) * pixel * pixel;
        sums.light += static_cast<double>(image.pixels[4 * i]) * pixel * pixel;
    }
    return sums;
}

// Under light that changes across the cloud and through it.
Sums marched_sums(const std::vector<Ball>& list, double distance, double pixel, int pixels) {
    const test::Stage stage = far_stage(list, distance, pixel, pixels);
    const TransportLight light = test::grid_light(
        stage.scene, stage.particles, 24, 1,
        [](const glm::dvec3& p) { return std::max(0.0, 1 + 0.1 * p.z + 0.05 * p.x); });
    return sums_of(test::marched(stage, light), pixel);
}

// The area that a cloud covers as seen from far away: rays side by side, `gap` apart.
double exact_area(const std::vector<Ball>& list, double distance, double gap) {
    const test::Stage stage = far_stage(list, distance, 1, 8);
    double area = 0;
    for (double y = -0.8 * kSize; y < 0.8 * kSize; y += gap)
        for (double x = -1.2 * kSize; x < 1.2 * kSize; x += gap) {
            const glm::dvec3 d = glm::normalize(glm::dvec3(x, y, -distance));
            area -= std::expm1(-test::line_depth(stage.particles, {0, 0, distance}, d)) * gap * gap;
        }
    return area;
}

TEST(Narrow, CoveredAreasAreTheIntegral) {
    for (const double depth : {1e-9, 1e-3, 0.5, 3.0, 4.5, 60.0}) {
        // By midpoints in the square of the radius.
        double sum = 0;
        constexpr int kSteps = 200000;
        const double step = 60.0 / kSteps;
        for (int i = 0; i < kSteps; ++i)
            sum -= std::expm1(-depth * std::exp(-(i + 0.5) * step)) * step;
        EXPECT_NEAR(covered_area(depth) / sum, 1, 1e-6) << depth;
        EXPECT_NEAR(depth_covering(covered_area(depth)) / depth, 1, 1e-6) << depth;
        EXPECT_NEAR(covered_area(widened_depth(depth, 3)) * 9 / covered_area(depth), 1, 1e-6);
    }
    EXPECT_EQ(widened_depth(5, 1), 5);
    EXPECT_TRUE(std::isfinite(widened_depth(1e300, 1.0001)));
    EXPECT_EQ(widened_depth(0, 7), 0);
}

TEST(SubPixel, OneParticleCoversItsArea) {
    for (const double density : {0.01, 1.0, 30.0, 1e5})
        for (const double pixel : {0.5, 1.0, 3.0, 20.0, 300.0, 5e3}) {
            const double s = 0.325;
            const double exact = 2 * std::numbers::pi * s * s *
                                 covered_area(density * s * std::sqrt(2 * std::numbers::pi));
            const Sums sums = marched_sums({{{0, 0, 0}, 2 * s, density}}, 1e5, pixel, 12);
            EXPECT_NEAR(sums.alpha / exact, 1, 0.02) << density << " " << pixel;
        }
}

TEST(SubPixel, CloudsAreTheSameFromAnyDistance) {
    for (const double density : {0.3, 3.0}) {
        const auto list = cloud_of(600, density);
        for (const double distance : {30.0, 1e3, 1e5}) {
            const Sums whole = marched_sums(list, distance, kSize / 60, 150);
            if (distance > 100) {
                EXPECT_NEAR(whole.alpha / exact_area(list, distance, 0.1), 1, 0.003);
            }
            for (const double pixel : {0.65, 1.6, 2.6, 10.0, 50.0, 3e3, 1e5}) {
                if (pixel > distance / 12) continue;  // off the middle, pixels are not as large
                const int pixels = pixel < 5 ? static_cast<int>(25 / pixel) : 8;
                const Sums sums = marched_sums(list, distance, pixel, pixels);
                EXPECT_NEAR(sums.alpha / whole.alpha, 1, 0.01) << density << " " << pixel;
                EXPECT_NEAR(sums.light / whole.light, 1, 0.01) << density << " " << pixel;
            }
        }
    }
}

// More particles than rays can be spent on.
TEST(SubPixel, ManyAreStillSeen) {
    const auto list = cloud_of(100'000, 3);
    const Sums whole = marched_sums(list, 1e5, kSize / 150, 360);
    for (const double pixel : {0.3, 3.0, 1e4}) {
        const int pixels = pixel < 5 ? static_cast<int>(24 / pixel) : 8;
        const Sums sums = marched_sums(list, 1e5, pixel, pixels);
        EXPECT_NEAR(sums.alpha / whole.alpha, 1, 0.02) << pixel;
        EXPECT_NEAR(sums.light / whole.light, 1, 0.02) << pixel;
    }
}

// By splats. A view that is narrower than a scene may ask for is taken from nearer.
Sums splat_sums(const std::vector<Ball>& list, double distance, double pixel, int pixels,
                const char* rung = "harris") {
    distance = std::min(distance, 5000 * pixel * pixels);
    SceneDraft draft = test::balls(list);
    draft.accuracy.rung = rung;
    draft.image.background = Background::kTransparent;
    draft.image.width = draft.image.height = pixels;
    draft.camera.eye = {0, 0, distance};
    draft.camera.target = pixel * glm::dvec3(0.13, 0.37, 0);
    draft.camera.fov = 2 * 180 / std::numbers::pi * std::atan(0.5 * pixel * pixels / distance);
    return sums_of(test::render(draft).image, pixel);
}

TEST(SubPixelSplats, OneParticleCoversItsArea) {
    for (const double density : {0.01, 1.0, 30.0, 1e5})
        for (const double pixel : {0.26, 0.52, 0.91, 1.56, 2.6, 20.0, 300.0, 6.5e3}) {
            const double s = 0.325;
            const double exact = 2 * std::numbers::pi * s * s *
                                 covered_area(density * s * std::sqrt(2 * std::numbers::pi));
            const int pixels = std::max(12, static_cast<int>(6 / pixel));
            const Sums sums = splat_sums({{{0, 0, 0}, 2 * s, density}}, 1e5, pixel, pixels);
            EXPECT_NEAR(sums.alpha / exact, 1, 0.02) << density << " " << pixel;
        }
}

// Heaps of 600, thin to dense, out to pixels of 10,000 radii.
TEST(SubPixelSplats, HeapsAreTheSameFromAnyDistance) {
    for (const double density : {0.003, 0.3, 30.0}) {
        const auto list = cloud_of(600, density);
        const double exact = exact_area(list, 1e5, 0.1);
        const double radius = 0.65;
        for (const double radii : {0.4, 0.8, 1.4, 2.4, 4.0, 15.0, 80.0, 5e3, 1e4}) {
            const double pixel = radii * radius;
            const int pixels = pixel < 5 ? static_cast<int>(25 / pixel) : 8;
            for (const char* rung : {"harris", "additive"}) {
                const Sums sums = splat_sums(list, 1e5, pixel, pixels, rung);
                EXPECT_NEAR(sums.alpha / exact, 1, 0.01) << rung << " " << density << " " << radii;
            }
        }
    }
}

// Denser and finer, against paths.
TEST(SubPixelSplats, ManySmallOnesAreAsTruthSeesThem) {
    const auto list = cloud_of(20'000, 8);
    for (const double pixel : {0.5, 3.0, 40.0}) {
        const int pixels = pixel < 5 ? static_cast<int>(24 / pixel) : 8;
        const test::Stage stage = far_stage(list, 1e5, pixel, pixels);
        TruthOptions options;
        options.samples = 2;
        options.whole_pixels = true;
        const auto truth = trace_truth(stage.scene, stage.particles, stage.view, options, {}, {});
        ASSERT_TRUE(truth.ok());
        const Sums sums = splat_sums(list, 1e5, pixel, pixels);
        EXPECT_NEAR(sums.alpha / sums_of(truth->half_a, pixel).alpha, 1, 0.02) << pixel;
    }
}

// Away from the picture's middle, where single floats do not tell a cloud's particles from each other.
TEST(SubPixelSplats, TheEdgeOfAPictureIsAsFineAsItsMiddle) {
    const double pixel = 6500, distance = 100 * pixel / (2 * std::tan(20 * std::numbers::pi / 180));
    const double aside = 40.3 * pixel;
    const auto list = cloud_of(600, 3, {aside, -0.7 * aside, 0});
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = draft.image.height = 100;
    draft.camera.eye = {0, 0, distance};
    const double sum = sums_of(test::render(draft).image, pixel).alpha;
    const ParticleSet particles = plan_scene(test::valid(draft), 1, {})->particles;
    // By the other program, too, which counts the half line before the eye.
    test::effect(draft, Effect::kInterior) = Switch::kOn;
    EXPECT_NEAR(sums_of(test::render(draft).image, pixel).alpha / sum, 1, 1e-3);
    // Rays around the line to the cloud, and the area of the image plane that their solid angle is.
    const glm::dvec3 to_cloud(aside, -0.7 * aside, -distance);
    const SideAxes side = side_axes(glm::normalize(to_cloud));
    double solid = 0;
    const double gap = 0.1, far = glm::length(to_cloud);
    for (double y = -1.2 * kSize; y < 1.2 * kSize; y += gap)
        for (double x = -1.2 * kSize; x < 1.2 * kSize; x += gap) {
            const glm::dvec3 d = glm::normalize(to_cloud + x * side.u + y * side.v);
            const double depth = test::line_depth(particles, {0, 0, distance}, d);
            solid -= std::expm1(-depth) * gap * gap / (far * far);
        }
    const double cosine = distance / far;
    EXPECT_NEAR(sum / (solid * distance * distance / (cosine * cosine * cosine)), 1, 0.01);
}

// A wide ball of optical depth 1 before a cloud within a pixel.
TEST(SubPixelSplats, NearMatterHidesWhatIsFar) {
    auto list = cloud_of(200, 3);
    const double alone = splat_sums(list, 1e5, 100, 4).alpha;
    const Ball ball{{0, 0, 99'000}, 200, 1 / (100 * std::sqrt(2 * std::numbers::pi))};
    list.push_back(ball);
    const double both = splat_sums(list, 1e5, 100, 4).alpha;
    const double before = splat_sums({ball}, 1e5, 100, 4).alpha;
    EXPECT_NEAR((both - before) / alone, std::exp(-1.0), 0.01);
}

// Clouds far below a pixel in one picture with a ball that is not.
TEST(SubPixel, NearMatterHidesWhatIsFar) {
    auto list = cloud_of(200, 3, {0, 0, 1000});
    const auto behind = cloud_of(200, 3, {400, 30, 0});
    list.insert(list.end(), behind.begin(), behind.end());
    list.push_back({{0, 0, 99'000}, 12, 0.1});
    const test::Stage stage = far_stage(list, 1e5, 1000, 4);
    const Image image = test::marched(stage, {});
    const Image again = test::marched(stage, {}, 1);
    EXPECT_EQ(image.pixels, again.pixels);
    TruthOptions options;
    options.samples = 2;
    options.whole_pixels = true;
    const auto truth = trace_truth(stage.scene, stage.particles, stage.view, options, {}, {});
    ASSERT_TRUE(truth.ok());
    const Sums sums = sums_of(image, 1), exact = sums_of(truth->half_a, 1);
    EXPECT_NEAR(sums.alpha / exact.alpha, 1, 0.01);
    // The ball is just wide enough for its pixels' middles to stand for them.
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_NEAR(test::pixel(image, x, y).a, test::pixel(truth->half_a, x, y).a, 0.006)
                << x << " " << y;
}

TEST(SubPixel, TheSurveySaysHowMuchThereIs) {
    const auto share = [](double pixel) {
        auto list = cloud_of(100, 1);
        list.push_back({{0, 0, 0}, 40, 1});
        SceneDraft draft = test::balls(list);
        draft.image.width = draft.image.height = 100;
        draft.camera.eye = {0, 0, 1e4};
        draft.camera.fov = 2 * 180 / std::numbers::pi * std::atan(50 * pixel / 1e4);
        const test::Stage stage = test::stage(draft);
        return survey(stage.scene, stage.particles, 1, {})->sub_pixel;
    };
    EXPECT_EQ(share(0.1), 0);
    EXPECT_GT(share(3), 0.01);
    EXPECT_LT(share(3), 0.2);
    EXPECT_EQ(share(80), 1);
}

// With a handful of paths.
TEST(SubPixel, TruthSeesIt) {
    const auto ball = std::vector<Ball>{{{0, 0, 0}, 0.65, 30}};
    for (const auto& list : {ball, cloud_of(600, 3)}) {
        const double exact = list.size() == 1
                                 ? 2 * std::numbers::pi * 0.325 * 0.325 *
                                       covered_area(30 * 0.325 * std::sqrt(2 * std::numbers::pi))
                                 : exact_area(list, 1e5, 0.1);
        for (const double pixel : {0.4, 3.0, 6.5, 1e3}) {
            const int pixels = pixel < 5 ? static_cast<int>(24 / pixel) : 8;
            const test::Stage stage = far_stage(list, 1e5, pixel, pixels);
            TruthOptions options;
            options.samples = 2;
            options.whole_pixels = true;
            const auto truth =
                trace_truth(stage.scene, stage.particles, stage.view, options, {}, {});
            ASSERT_TRUE(truth.ok());
            EXPECT_NEAR(sums_of(truth->half_a, pixel).alpha / exact, 1, 0.005) << pixel;
            EXPECT_NEAR(sums_of(truth->half_b, pixel).alpha / exact, 1, 0.005) << pixel;
            EXPECT_GT(sums_of(truth->half_a, pixel).light, 0);
        }
    }
}

}  // namespace
}  // namespace awan
