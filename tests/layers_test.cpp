// A picture and its layers: that they add up, and that each is what it says.
#include <gtest/gtest.h>

#include <cmath>

#include "core/light/once_scattered.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/truth/path_tracer.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

Rendered rendered(const SceneDraft& draft, int threads = 2) {
    const auto scene = validate(draft);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    Tools tools;
    tools.threads = threads;
    auto made = render_scene(*scene, tools, {});
    EXPECT_TRUE(made.ok()) << made.error().message;
    return *std::move(made);
}

// A lumpy cloud over a ground under a blue sky.
SceneDraft cloud(const char* rung) {
    SceneDraft draft;
    draft.clouds.resize(1);
    draft.clouds[0].cubes.push_back({});
    Cube& cube = draft.clouds[0].cubes[0];
    cube.particles = 300;
    cube.size = {4, 2, 3};
    cube.radius = 0.6;
    draft.density = 2;
    draft.image.width = 64;
    draft.image.height = 48;
    draft.image.precision = Precision::kFloat;
    draft.image.layers = "all";
    draft.accuracy.rung = rung;
    return draft;
}

// Largest difference of a picture from what its layers add up to.
float worst_sum(const Rendered& made) {
    const PictureLayers& l = made.layers;
    float worst = 0;
    for (std::size_t i = 0; i < made.image.pixel_count(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = 3 * i + c;
            const float sum = l.sun[at] + l.sky[at] + l.multiple[at] + l.haze[at] +
                              l.transmittance[i] * l.background[at];
            worst = std::max(worst, std::abs(sum - made.image.pixels[4 * i + c]));
        }
    return worst;
}

double mean(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += static_cast<double>(value);
    return sum / static_cast<double>(values.size());
}

TEST(Layers, AddUpToThePicture) {
    SceneDraft plain = cloud("transport-16");
    SceneDraft over_nothing = plain;
    over_nothing.image.background = Background::kTransparent;
    SceneDraft grounded = plain;
    grounded.ground = Ground{.height = -2};
    SceneDraft hazy = grounded;
    hazy.haze = Haze{.extinction = 0.02};
    hazy.effects[static_cast<int>(Effect::kAerialPerspective)] = Switch::kOn;
    SceneDraft gradient = plain;
    gradient.sky.physical = false;
    SceneDraft smooth = cloud("single");
    smooth.detail.reset();
    for (const SceneDraft& draft : {plain, over_nothing, grounded, hazy, gradient, smooth}) {
        const Rendered made = rendered(draft);
        EXPECT_LT(worst_sum(made), 1e-5F);
        // The parts are parts: nothing is taken from one that another has too much of.
        for (const auto* layer : {&made.layers.sun, &made.layers.sky, &made.layers.background})
            for (const float value : *layer) ASSERT_GE(value, 0);
        const double light = mean(made.layers.sun) + mean(made.layers.sky) +
                             mean(made.layers.multiple) + mean(made.layers.haze);
        double below = 0;
        for (const float value : made.layers.multiple)
            below += static_cast<double>(std::min(value, 0.0F));
        EXPECT_LT(-below / static_cast<double>(made.layers.multiple.size()), 1e-3 * light);
    }
}

TEST(Layers, LeaveThePictureAsItIs) {
    for (const char* const rung : {"transport-16", "single"}) {
        SceneDraft draft = cloud(rung);
        const Rendered with = rendered(draft);
        draft.image.layers = "none";
        const Rendered without = rendered(draft);
        EXPECT_EQ(with.image.pixels, without.image.pixels);
        EXPECT_TRUE(without.layers.depth.empty());
        EXPECT_TRUE(without.layers.sun.empty());
        draft.image.layers = "transmittance,sky";
        const Rendered some = rendered(draft, 1);
        EXPECT_EQ(some.layers.sky, with.layers.sky);
        EXPECT_EQ(some.layers.transmittance, with.layers.transmittance);
        EXPECT_TRUE(some.layers.sun.empty());
        EXPECT_TRUE(some.layers.depth.empty());
    }
}

TEST(Layers, OfTransparentPicturesTransmittanceIsWhatAlphaLeaves) {
    SceneDraft draft = cloud("transport-16");
    draft.image.background = Background::kTransparent;
    const Rendered made = rendered(draft);
    for (std::size_t i = 0; i < made.image.pixel_count(); ++i)
        ASSERT_NEAR(made.layers.transmittance[i], 1 - made.image.pixels[4 * i + 3], 1e-6F);
}

TEST(Layers, TheSunIsWhatRungSingleHas) {
    SceneDraft draft = cloud("transport-16");
    draft.detail.reset();
    draft.image.background = Background::kTransparent;
    const Rendered made = rendered(draft);
    draft.accuracy.rung = "single";
    const Rendered single = rendered(draft);
    double off = 0, sum = 0;
    for (std::size_t i = 0; i < made.image.pixel_count(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto exact = static_cast<double>(single.image.pixels[4 * i + c]);
            off += std::abs(static_cast<double>(made.layers.sun[3 * i + c]) - exact);
            sum += exact;
        }
    EXPECT_GT(sum, 0);
    EXPECT_LT(off, 0.02 * sum);
    // And that rung has nothing else.
    EXPECT_LT(std::abs(mean(single.layers.multiple)), 1e-3 * mean(single.layers.sun));
    EXPECT_EQ(mean(single.layers.sky), 0);
}

// The path tracer's first order, of a sky alone.
TEST(Layers, TheSkyIsThePathTracersFirstOrder) {
    SceneDraft draft = cloud("transport-32");
    draft.detail.reset();
    draft.image.background = Background::kTransparent;
    draft.image.width = 40;
    draft.image.height = 30;
    draft.sky.physical = false;
    draft.sky.intensity = 1;
    draft.sun.intensity = 0;
    for (const double g : {0.0, 0.85}) {
        draft.medium.g = g;
        const Rendered made = rendered(draft);
        draft.image.layers = "none";
        const auto scene = validate(draft);
        draft.image.layers = "all";
        ASSERT_TRUE(scene.ok());
        const auto planned = plan_scene(*scene, 2, {});
        ASSERT_TRUE(planned.ok());
        TruthOptions options;
        options.samples = 64;
        options.max_orders = 1;
        options.whole_pixels = true;
        options.threads = 2;
        const auto truth =
            trace_truth(*scene, planned->particles, planned->survey.view, options, {}, {});
        ASSERT_TRUE(truth.ok());
        const Image exact = mean_of(*truth);
        double own = 0, other = 0;
        for (std::size_t i = 0; i < exact.pixel_count(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                own += static_cast<double>(made.layers.sky[3 * i + c]);
                other += static_cast<double>(exact.pixels[4 * i + c]);
            }
        EXPECT_GT(other, 0);
        EXPECT_NEAR(own / other, 1, 0.04) << g;
    }
}

// One Gaussian on the middle ray: the mean of t over -d exp(-tau(t)), by the midpoint rule.
TEST(Layers, DepthIsTheMeanDistanceAtWhichTheRayEnds) {
    for (const double density : {0.01, 1.0, 30.0}) {
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.resize(1);
        draft.clouds[0].model = CloudModel::kParticles;
        draft.clouds[0].ready.positions = {{0, 0, 0}};
        draft.clouds[0].ready.radii = {2};
        draft.density = density;
        draft.detail.reset();
        draft.camera.automatic = false;
        draft.camera.eye = {0, 0, 10};
        draft.camera.target = {0, 0, 0};
        draft.camera.fov = 100;
        draft.image.width = draft.image.height = 33;
        draft.image.layers = "depth";
        draft.accuracy.rung = "transport-16";
        const Rendered made = rendered(draft);
        double tau = 0, sum = 0;
        constexpr double kStep = 1e-3;
        for (double t = kStep / 2; t < 20; t += kStep) {
            const double here = density * std::exp(-(t - 10) * (t - 10) / 2) * kStep;
            sum += t * std::exp(-tau) * -std::expm1(-here);
            tau += here;
        }
        const std::size_t middle = 16 * 33 + 16;
        EXPECT_NEAR(static_cast<double>(made.layers.depth[middle]), sum / -std::expm1(-tau), 0.02)
            << density;
        EXPECT_EQ(made.layers.depth[0], kNoDepth);
    }
}

TEST(Layers, AreOfTheMarchAlone) {
    const auto refused = [](const SceneDraft& draft, const char* part) {
        const auto scene = validate(draft);
        ASSERT_FALSE(scene.ok()) << part;
        EXPECT_EQ(scene.error().pointer, "/image/layers");
        EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
    };
    for (const char* const rung : {"truth", "harris", "additive"}) refused(cloud(rung), rung);
    SceneDraft draft = cloud("transport-16");
    draft.image.layers = "depth,sum";
    refused(draft, "transmittance");
    draft = cloud("transport-16");
    draft.accuracy = {};
    draft.effects[static_cast<int>(Effect::kViewExtinction)] = Switch::kOff;
    refused(draft, "view_extinction");
    // Whatever is cheapest for thin matter, and most exact: only a march is taken.
    draft = cloud("transport-16");
    draft.accuracy = {};
    draft.density = 1e-3;
    for (const double error : {0.5, 0.001}) {
        draft.accuracy.error = error;
        EXPECT_EQ(rendered(draft).rung->method, Method::kMarch);
    }
}

}  // namespace
}  // namespace awan
