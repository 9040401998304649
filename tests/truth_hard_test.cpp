// Hard cases through the paths of the truth: finite and within what physics allows.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/truth_scenes.h"

namespace awan {
namespace {

using test::Ball;
using test::mean_red;
using test::traced;

// --- hard cases

void expect_physical(const SceneDraft& draft, double most, const char* what) {
    TruthOptions options;
    options.samples = 4;
    const Image image = mean_of(traced(draft, options));
    for (const float v : image.pixels) {
        ASSERT_TRUE(std::isfinite(v)) << what;
        ASSERT_GE(v, 0) << what;
        ASSERT_LE(static_cast<double>(v), most) << what;
    }
}

SceneDraft hard(const std::vector<Ball>& list) {
    SceneDraft draft = test::balls(list);
    draft.image.width = draft.image.height = 6;
    draft.image.background = Background::kTransparent;
    draft.medium.g = 0.5;
    draft.camera.eye = {0, 0, 6};
    return draft;
}

TEST(Hard, OpticalDepths) {
    for (const double depth : {1e3, 1e6, 1e12}) {
        SceneDraft draft = hard({{{0, 0, 0}, 2, 1}});
        draft.clouds[0].ready.radii = {static_cast<float>(std::min(depth, 1e6))};
        draft.clouds[0].ready.densities = {static_cast<float>(depth / std::min(depth, 1e6))};
        draft.camera.eye = {0, 0, 4.0 * std::min(depth, 1e6)};
        for (const double albedo : {1.0, 0.9999, 0.5, 0.0}) {
            draft.medium.albedo = albedo;
            expect_physical(draft, 50, "thick");
        }
    }
    SceneDraft draft = hard({{{0, 0, 0}, 2, 1e-12}});
    expect_physical(draft, 1e-9, "thin");
}

TEST(Hard, Anisotropy) {
    for (const double g : {0.999, -0.999})
        for (const PhaseFunction phase :
             {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks}) {
            SceneDraft draft = hard({{{0, 0, 0}, 2, 5}});
            draft.medium.g = g;
            draft.medium.phase = phase;
            expect_physical(draft, 1e6, "g");
            draft.sun.direction = glm::dvec3(0, 0, -1);  // straight into the eye
            expect_physical(draft, 1e6, "g");
        }
}

TEST(Hard, SunsAndEyes) {
    for (const double elevation : {90.0, -90.0, 0.0}) {
        SceneDraft draft = hard({{{0, 0, 0}, 2, 5}});
        draft.sun.elevation = elevation;
        draft.sky.none = false;
        expect_physical(draft, 50, "sun");
    }
    SceneDraft draft = hard({{{0, 0, 0}, 2, 5}, {{1, 0, 0}, 1e-6, 1e6}});
    draft.camera.eye = {0, 0, 0};
    draft.camera.target = {0, 0, -1};
    expect_physical(draft, 50, "eye in a centre");
    draft.camera.eye = {1, 0, 0};
    draft.camera.target = {0, 0, -1};
    expect_physical(draft, 50, "eye in a small centre");
    draft.image.width = draft.image.height = 1;
    expect_physical(draft, 50, "one pixel");
}

TEST(Hard, SizesAndPlaces) {
    SceneDraft small = hard({{{0, 0, 0}, 1e-6, 1e6}});
    small.camera.eye = {0, 0, 4e-6};
    expect_physical(small, 50, "small");
    SceneDraft far = hard({{{1e9, 1e9, 1e9}, 2, 3}});
    far.camera.eye = {1e9, 1e9, 1e9 - 9};
    far.camera.target = {1e9, 1e9, 1e9};
    expect_physical(far, 50, "far");
    expect_physical(hard({{{0, 0, 0}, 2, 5}, {{1e9, 0, 0}, 1e-6, 1e6}, {{-1e9, 0, 0}, 1e6, 1}}), 50,
                    "apart");
    expect_physical(hard(std::vector<Ball>(5000, {{0.3, 0, 0}, 2, 2e-3})), 50, "coincident");
    expect_physical(hard({{{0, 0, 0}, 2, 0}}), 0, "nothing");
    expect_physical(hard({}), 0, "no particles");
    // A picture of the far cloud is that of the near one.
    SceneDraft near = hard({{{0, 0, 0}, 2, 3}});
    near.camera.eye = {0, 0, -9};
    TruthOptions options;
    options.samples = 512;
    EXPECT_NEAR(mean_red(mean_of(traced(far, options))) / mean_red(mean_of(traced(near, options))),
                1, 0.05);
}

TEST(Hard, ThickMatterGivesLightBack) {
    // An optical depth of 1000 with nothing absorbed reflects nearly all: a ball lit from the eye's side, seen
    // under the same sky from everywhere, is as bright as the sky.
    SceneDraft draft = hard({{{0, 0, 0}, 2, 400}});
    draft.sun.intensity = 0;
    draft.sky.none = false;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    draft.medium.g = 0;
    draft.image.background = Background::kSky;
    draft.image.width = draft.image.height = 1;
    TruthOptions options;
    options.samples = 256;
    options.sky = SkySampling::kNextEvent;
    const Image image = mean_of(traced(draft, options));
    EXPECT_NEAR(image.pixels[0], 1, 0.25);
}

}  // namespace
}  // namespace awan
