// Matter that is narrower than a pixel: what a pixel shows of it is the mean over its area.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "core/survey/narrow.h"
#include "core/truth/path_tracer.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

using test::Ball;

constexpr double kCloud = 10;  // size of the clouds below

// A cloud of particles of radius 0.65, denser in its middle.
std::vector<Ball> cloud_of(int count, double radius, double density, unsigned seed = 3) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, kCloud / 5);
    std::vector<Ball> list;
    for (int i = 0; i < count; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        list.push_back({{x, 0.6 * y, z}, radius, density});
    }
    return list;
}

struct Seen {
    double alpha = 0, light = 0;  // integrals over the picture, in steradians near its middle
};

// From `distance` cloud sizes away, in a picture of `pixels` a side that is `sizes` cloud sizes wide there.
Seen look(const std::vector<Ball>& list, double distance, double sizes, int pixels,
          const glm::dvec3& off, double* ms = nullptr) {
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = draft.image.height = pixels;
    draft.camera.eye = glm::dvec3(0, 0, kCloud * distance);
    draft.camera.target = off;
    test::Stage stage = test::stage(draft);
    stage.view.tan_half_fov = sizes / distance / 2;
    const TransportLight light = test::grid_light(
        stage.scene, stage.particles, 24, 1,
        [](const glm::dvec3& p) { return std::max(0.0, 1 + 0.1 * p.z + 0.05 * p.x); });
    const auto start = std::chrono::steady_clock::now();
    const Image image = test::marched(stage, light, 1);
    if (ms != nullptr)
        *ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count();
    Seen seen;
    const double pixel = sizes / distance / pixels;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        seen.alpha += static_cast<double>(image.pixels[4 * i + 3]) * pixel * pixel;
        seen.light += static_cast<double>(image.pixels[4 * i]) * pixel * pixel;
    }
    return seen;
}

TEST(SubPixel, Study) {
    for (const double density : {0.3, 3.0}) {
        const auto list = cloud_of(600, 0.65, density);
        for (const double distance : {3.0, 100.0, 1e4}) {
            double ms0 = 0;
            const Seen whole = look(list, distance, 2, 160, {0, 0, 0}, &ms0);
            for (const double per_size : {20.0, 10.0, 5.0, 2.5, 1.0, 0.3, 0.03, 0.001}) {
                double ms = 0;
                const int pixels = std::max(8, static_cast<int>(2 * per_size));
                const double sizes = pixels / per_size;
                if (sizes > 2 * distance) continue;
                const Seen seen = look(list, distance, sizes, pixels, glm::dvec3(0.13, 0.37, 0) * (kCloud / per_size), &ms);
                std::printf("density %g distance %g pixels a size %g (pixel %.2f radii): alpha %.3f light %.3f  %.1f ms (whole %.1f)\n",
                            density, distance, per_size, kCloud / per_size / .65, seen.alpha / whole.alpha,
                            seen.light / whole.light, ms, ms0);
            }
        }
    }
}

TEST(SubPixel, Many) {
    for (const int count : {20000, 200000, 1000000}) {
        const auto list = cloud_of(count, 0.65 * std::cbrt(600.0 / count), 3);
        for (const double per_size : {64.0, 16.0, 4.0, 0.5, 1e-3}) {
            double ms = 0, ms0 = 0;
            const int pixels = std::max(8, static_cast<int>(2 * per_size));
            const double sizes = pixels / per_size;
            const Seen seen = look(list, 1e4, sizes, pixels, glm::dvec3(0.13, 0.37, 0) * (kCloud / per_size), &ms);
            const Seen whole = look(list, 1e4, 2, 640, {0, 0, 0}, &ms0);
            std::printf("count %d pixels a size %g (pixel %.2f radii): alpha %.3f light %.3f  %.1f ms (whole %.1f)\n",
                        count, per_size, kCloud / per_size / list[0].radius, seen.alpha / whole.alpha,
                        seen.light / whole.light, ms, ms0);
        }
    }
}

TEST(SubPixel, Truth) {
    for (const int count : {1, 600, 20000}) {
        const auto list = count == 1 ? std::vector<Ball>{{{0, 0, 0}, 0.65, 30}} : cloud_of(count, 0.65 * std::cbrt(600.0 / count), 3);
        for (const double per_size : {20.0, 5.0, 1.0, 0.1, 1e-3}) {
            const int pixels = std::max(8, static_cast<int>(2 * per_size));
            const double sizes = pixels / per_size;
            const glm::dvec3 off = glm::dvec3(0.13, 0.37, 0) * (kCloud / per_size);
            const Seen whole = look(list, 1e4, 2, 640, {0, 0, 0});
            SceneDraft draft = test::balls(list);
            draft.image.background = Background::kTransparent;
            draft.image.width = draft.image.height = pixels;
            draft.camera.eye = glm::dvec3(0, 0, kCloud * 1e4);
            draft.camera.target = off;
            test::Stage stage = test::stage(draft);
            stage.view.tan_half_fov = sizes / 1e4 / 2;
            TruthOptions options;
            options.whole_pixels = true;
            options.samples = 4;
            const auto start = std::chrono::steady_clock::now();
            const Image image = mean_of(*trace_truth(stage.scene, stage.particles, stage.view, options, {}, {}));
            const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
            double alpha = 0, light = 0;
            const double pixel = sizes / 1e4 / pixels;
            for (std::size_t i = 0; i < image.pixel_count(); ++i) {
                alpha += static_cast<double>(image.pixels[4 * i + 3]) * pixel * pixel;
                light += static_cast<double>(image.pixels[4 * i]) * pixel * pixel;
            }
            std::printf("truth count %d pixels a size %g: alpha %.4f light/alpha %g, %.0f ms\n", count, per_size, alpha / whole.alpha, light / alpha, ms);
        }
    }
}

}  // namespace
}  // namespace awan
