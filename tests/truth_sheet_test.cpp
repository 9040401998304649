// The truth on wide, deep sheets, whose light is known in closed form, and what it says about itself.
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/generate.h"
#include "core/truth/path_tracer.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using std::numbers::pi;

struct Traced {
    TruthImage truth;
    double mean = 0;   // red
    double error = 0;  // a standard error of it, from the halves
};

Traced traced(const SceneDraft& draft, const TruthOptions& options) {
    const Scene scene = test::valid(draft);
    const ParticleSet particles = generate(scene, 1, {}).value();
    const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
    Traced traced{trace_truth(scene, particles, view, options, {}, {}).value()};
    const Image image = mean_of(traced.truth);
    const auto pixels = static_cast<double>(image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        traced.mean += static_cast<double>(image.pixels[4 * i]) / pixels;
        const double apart = static_cast<double>(traced.truth.half_a.pixels[4 * i] -
                                                 traced.truth.half_b.pixels[4 * i]);
        traced.error += apart * apart / 4;
    }
    traced.error = std::sqrt(traced.error) / pixels;
    return traced;
}

constexpr double kDepth = 32;
constexpr double kSunCosine = 0.5;

// A level sheet of Gaussians, s = 1, on a grid of spacing 1, five layers; so wide on each side of the middle. Its depth
// is the same everywhere to 1e-8. Seen from straight above its middle.
SceneDraft sheet(int half_width, double albedo) {
    constexpr int kLayers = 5;
    const double density = kDepth / (kLayers * std::pow(2 * pi, 1.5));
    std::vector<test::Ball> list;
    for (int x = -half_width; x <= half_width; ++x)
        for (int z = -half_width; z <= half_width; ++z)
            for (int y = 0; y < kLayers; ++y) list.push_back({{x, y - 2, z}, 2, density});
    SceneDraft draft = test::balls(list);
    draft.medium.albedo = albedo;
    draft.medium.g = 0;
    draft.sun.direction = glm::dvec3(std::sqrt(1 - kSunCosine * kSunCosine), kSunCosine, 0);
    draft.camera.eye = {0, 2000, 0.001};
    draft.camera.target = {0, 0, 0};
    draft.camera.up = {0, 0, 1};
    draft.camera.fov = 2 * std::atan(2.0 / 2000) * 180 / pi;
    draft.image.width = draft.image.height = 8;
    draft.image.background = Background::kTransparent;
    return draft;
}

// Radiance that goes straight up, for an irradiance of 1. Chandrasekhar 1950: H functions of isotropic scattering
// without absorption, H(1) = 2.9078, H(.5) = 2.0128; for a deep sheet over black, less what gets through,
// 4 K(1) K(.5) / (3 (depth + 1.42089)) with K = sqrt(3)/4 H.
double deep_sheet() {
    constexpr double kH1 = 2.9078, kH5 = 2.0128;
    const double without_end = kH1 * kH5 / (4 * (1 + kSunCosine));
    const double through = 4 * 3.0 / 16 * kH1 * kH5 / (3 * (kDepth + 1.42089));
    return kSunCosine / pi * (without_end - through);
}

TEST(Sheet, OfAnyWidthGivesBackWhatItMust) {
    for (const int half_width : {12, 36}) {
        TruthOptions options;
        options.samples = 1024;
        const Traced found = traced(sheet(half_width, 1), options);
        EXPECT_NEAR(found.mean / deep_sheet(), 1, 3.5 * found.error / found.mean) << half_width;
        EXPECT_LT(found.error / found.mean, 0.005);
    }
}

TEST(Sheet, OfAlmostNoAlbedoScattersOnce) {
    const double albedo = 1e-3;
    TruthOptions options;
    options.samples = 256;
    const Traced found = traced(sheet(36, albedo), options);
    // All that is met is on the way to both: 1 / (1 + 1 / cosine). The second order is ln 2 / 2 + ln 3 / 4 of it.
    const double once = albedo / (4 * pi) / (1 + 1 / kSunCosine);
    const double twice = albedo * (std::log(2.0) / 2 + std::log(3.0) / 4);
    EXPECT_NEAR(found.mean / once, 1 + twice, 0.002);
}

TEST(Noise, IsWhatItSays) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 40;
    draft.image.height = 28;
    draft.image.background = Background::kTransparent;
    for (const double albedo : {1.0, 0.9}) {
        draft.medium.albedo = albedo;
        draft.medium.g = 0.5;
        TruthOptions options;
        options.samples = 32;
        const Traced one = traced(draft, options);
        options.seed = 2;
        const Traced other = traced(draft, options);
        // Two pictures' difference has the noise of both.
        TruthImage both{mean_of(one.truth), mean_of(other.truth), 0};
        const double measured = both.noise() * std::sqrt(2.0);
        EXPECT_NEAR(one.truth.noise() / measured, 1, 0.2) << albedo;
    }
}

TEST(Sky, WithoutCloudsStopsInTime) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1}});
    draft.camera.target = {0, 0, 40};  // away from it
    draft.image.width = draft.image.height = 4096;
    const Scene scene = test::valid(draft);
    const ParticleSet particles = generate(scene, 1, {}).value();
    const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
    Deadline deadline;
    const auto start = Deadline::Clock::now();
    deadline.until = start + std::chrono::milliseconds(300);
    TruthOptions options;
    options.samples = 2;
    const auto late = trace_truth(scene, particles, view, options, {}, deadline);
    ASSERT_FALSE(late.ok());
    EXPECT_EQ(late.error().code, ErrorCode::kOverDeadline);
    EXPECT_LT(Deadline::Clock::now() - start, std::chrono::seconds(2));
}

}  // namespace
}  // namespace awan
