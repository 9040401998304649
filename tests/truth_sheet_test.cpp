// The truth on wide, deep sheets, whose light is known in closed form, and what it says about itself.
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/generate.h"
#include "core/truth/path_random.h"
#include "core/truth/path_tracer.h"
#include "tests/patience.h"
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

// Of a picture as it is planned, with its detail.
TruthImage picture(const SceneDraft& draft, std::uint32_t samples, bool whole_pixels,
                   std::uint64_t seed) {
    const Scene scene = test::valid(draft);
    const Planned planned = plan_scene(scene, 1, {}).value();
    TruthOptions options;
    options.samples = samples;
    options.seed = seed;
    options.whole_pixels = whole_pixels;
    return trace_truth(scene, planned.particles, planned.survey.view, options, {}, {}).value();
}

// Stated and measured over pairs of seeds.
void expect_true_noise(const char* name, const SceneDraft& draft, std::uint32_t samples,
                       bool whole_pixels = false) {
    double stated = 0, measured = 0;
    for (std::uint64_t pair = 0; pair < 3; ++pair) {
        const TruthImage one = picture(draft, samples, whole_pixels, 2 * pair + 1),
                         other = picture(draft, samples, whole_pixels, 2 * pair + 2);
        stated += std::pow(one.noise(), 2) + std::pow(other.noise(), 2);
        // Two pictures' difference has the noise of both.
        measured += 4 * std::pow(TruthImage{mean_of(one), mean_of(other), 0}.noise(), 2);
    }
    EXPECT_GT(std::sqrt(stated / measured), 0.8) << name;
    EXPECT_LT(std::sqrt(stated / measured), 1.25) << name;
}

TEST(Noise, IsWhatItSays) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 40;
    draft.image.height = 28;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = "truth";
    draft.medium.g = 0.5;
    expect_true_noise("smooth", draft, 32);
    SceneDraft other = draft;
    other.medium.albedo = 0.9;
    expect_true_noise("absorbing", other, 32);
    other = draft;
    other.detail = Detail{0.8, 1.2};
    expect_true_noise("with detail", other, 16);
    // Particles are narrower than pixels by far.
    std::vector<test::Ball> dust;
    for (std::uint64_t i = 0; i < 300; ++i) {
        truth::PathRandom random(i + 1);
        const glm::dvec3 place(random.unit(), random.unit(), random.unit());
        dust.push_back({8.0 * (place - 0.5), 0.2, 20});
    }
    other = test::balls(dust);
    other.image.width = other.image.height = 16;
    other.image.background = Background::kTransparent;
    other.accuracy.rung = "truth";
    expect_true_noise("dust", other, 32, true);
    // Into the sun.
    other = draft;
    other.medium.g = 0.85;
    other.sun.direction = glm::dvec3(0.1, 0.2, -1);
    other.camera.automatic = false;
    other.camera.eye = {0, 0, 25};
    other.camera.target = {0, 0, 0};
    expect_true_noise("backlit", other, 32);
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
    EXPECT_LT(Deadline::Clock::now() - start, test::patience(2));
}

}  // namespace
}  // namespace awan
