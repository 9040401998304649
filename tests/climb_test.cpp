// Grids that go on from coarser ones, and the error that is stated of their pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "core/accuracy/error_measures.h"
#include "core/climb.h"
#include "core/draw/picture_difference.h"
#include "core/light/nested_grids.h"
#include "core/pipeline.h"
#include "core/truth/path_tracer.h"
#include "tests/patience.h"
#include "tests/scenes.h"

namespace awan {
namespace {

SceneDraft cumulus(double g, double density) {
    SceneDraft draft = test::table_4_4();
    draft.medium.g = g;
    draft.medium.albedo = 1;
    draft.density = density;
    draft.sky.none = true;
    draft.image.width = test::or_fewer(64, 16);
    draft.image.height = test::or_fewer(48, 12);
    draft.image.background = Background::kTransparent;
    draft.accuracy = {};
    return draft;
}

Rendered rendered(const SceneDraft& draft, int threads = 2, LightCache* lights = nullptr) {
    auto made = render_scene(test::valid(draft), {nullptr, threads, lights, {}, {}}, {});
    EXPECT_TRUE(made.ok()) << made.error().message;
    return *std::move(made);
}

// A light with one band, whose first moment is `value` of the places of its cells' middles.
template <typename Value>
TransportLight light_of(int cells, const Value& value) {
    TransportLight light;
    light.cells = glm::ivec3(cells, cells / 2, cells);
    light.cell = 8.0 / glm::dvec3(light.cells);
    light.bands.resize(1);
    for (int k = 0; k < light.cells.z; ++k)
        for (int j = 0; j < light.cells.y; ++j)
            for (int i = 0; i < light.cells.x; ++i) {
                light.bands[0].moments.emplace_back();
                light.bands[0].moments.back()[0] =
                    static_cast<float>(value((glm::dvec3(i, j, k) + 0.5) * light.cell));
            }
    return light;
}

TEST(NestedGrids, GrowFromTheCoarsest) {
    EXPECT_EQ(nested_cells(64), (std::vector<int>{8, 12, 16, 24, 32, 48, 64}));
    EXPECT_EQ(nested_cells(16), (std::vector<int>{8, 12, 16}));
    EXPECT_EQ(nested_cells(20), (std::vector<int>{8, 12, 16, 20}));
    EXPECT_EQ(nested_cells(5), std::vector<int>{5});
    EXPECT_EQ(nested_cells(0), std::vector<int>{0});
}

TEST(NestedGrids, MomentsBetweenCellsAreLinear) {
    const auto plane = [](const glm::dvec3& p) { return 1 + p.x - 2 * p.y + 0.5 * p.z; };
    const TransportLight coarse = light_of(8, plane), fine = light_of(12, plane);
    const auto between = moments_between(coarse, 0, fine, 2);
    std::size_t at = 0;
    for (int k = 0; k < fine.cells.z; ++k)
        for (int j = 0; j < fine.cells.y; ++j)
            for (int i = 0; i < fine.cells.x; ++i, ++at)
                if (i > 0 && j > 0 && k > 0 && i < 11 && j < 5 && k < 11) {
                    EXPECT_NEAR(between[at][0], fine.bands[0].moments[at][0], 1e-5);
                }
}

// What falls with the square of a cell's side is gone; what would change a cell by too much is held back.
TEST(NestedGrids, ExtrapolationTakesAnErrorOfSecondOrderAway) {
    const auto with_error = [](int cells, double error) {
        return light_of(cells, [=](const glm::dvec3&) { return 3 + error / (cells * cells); });
    };
    TransportLight fine = with_error(24, 100);
    extrapolate(with_error(16, 100), fine, 2);
    for (const auto& moments : fine.bands[0].moments) EXPECT_NEAR(moments[0], 3, 1e-4);
    EXPECT_NEAR(fine.solved.at(0)[0][0], 3 + 100.0 / 576, 1e-5);

    TransportLight wild = with_error(24, 1e5);
    const float before = wild.bands[0].moments[0][0];
    extrapolate(with_error(16, 1e5), wild, 2);
    EXPECT_NEAR(wild.bands[0].moments[0][0], 0.5F * before, 1e-3F * before);
}

TEST(PictureDifference, IsRelativeToTheCloudsMean) {
    Image truth{4, 1, false, {2, 2, 2, 1, 4, 4, 4, 1, 0, 0, 0, 0, 9, 9, 9, 0.01F}};
    Image x = truth;
    for (std::size_t i = 0; i < 8; ++i) x.pixels[i] *= 1.1F;
    x.pixels[12] = 0;  // thinner than what counts
    EXPECT_NEAR(picture_difference(x, truth), 0.1 * std::sqrt(10.0) / 3, 1e-6);
    EXPECT_EQ(picture_difference(truth, truth), 0);
}

TEST(Climb, StricterAsksNeverGiveWorsePictures) {
    for (const double density : {4.0, 0.4, 40.0}) {
        if (density != test::or_fewer(density, 4.0)) continue;
        int cells = 0;
        for (const double error : {0.2, 0.1, 0.05, 0.03, 0.02}) {
            if (error < test::or_fewer(0.0, 0.04)) continue;
            SceneDraft draft = cumulus(0.6, density);
            draft.accuracy.error = error;
            const Rendered one = rendered(draft);
            if (one.rung->cells == 0) continue;  // no grid was needed, or none does
            EXPECT_GE(one.rung->cells, cells) << density << ' ' << error;
            EXPECT_TRUE(one.stated_error <= error || one.rung->cells == 64) << one.rung->name;
            EXPECT_EQ(one.plan.rung, one.rung->name);
            cells = one.rung->cells;
        }
        EXPECT_GE(cells, test::or_fewer(24, 16)) << density;
    }
}

// A rung by name is the picture of the climb that ends there.
TEST(Climb, EndsAtThePictureOfTheRung) {
    SceneDraft draft = cumulus(0.6, 4);
    draft.accuracy.error = 0.05;
    const Rendered climbed = rendered(draft);
    ASSERT_GT(climbed.rung->cells, 0);
    draft.accuracy = {{}, {}, climbed.rung->name};
    const Rendered named = rendered(draft, 3);
    EXPECT_EQ(climbed.image.pixels, named.image.pixels);
    EXPECT_EQ(climbed.stated_error, named.stated_error);
}

TEST(Climb, ANewCameraKeepsTheLight) {
    LightCache lights(256 << 20);
    SceneDraft draft = cumulus(0.6, 4);
    draft.accuracy.error = 0.05;
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 30};
    draft.camera.target = {0, -2, 0};
    EXPECT_FALSE(rendered(draft, 2, &lights).light_was_kept);
    draft.camera.eye = {4, 0, 30};
    const Rendered again = rendered(draft, 2, &lights);
    EXPECT_TRUE(again.light_was_kept);
    EXPECT_EQ(again.image.pixels, rendered(draft).image.pixels);
}

// A time that is over before it begins, and one that never is.
TEST(Climb, WithoutTimeNothingIsMeasuredAndWithAllOfItTheFinestGridIs) {
    SceneDraft draft = cumulus(0.6, 4);
    const auto climbed_in = [&](double ms) {
        draft.accuracy = {{}, ms, {}};
        const Scene scene = test::valid(draft);
        auto planned = plan_scene(scene, 2, {});
        EXPECT_TRUE(planned.ok());
        const Planned grids = planned_for_grids(scene, *std::move(planned), 2);
        auto climbed = climb(scene, grids, {nullptr, 2}, {});
        EXPECT_TRUE(climbed.ok());
        return *std::move(climbed);
    };
    const Climbed hurried = climbed_in(1e-3), patient = climbed_in(1e7);
    EXPECT_EQ(hurried.rung->cells, 16);
    EXPECT_TRUE(std::isnan(hurried.stated));
    EXPECT_EQ(patient.rung->cells, 64);
    draft.accuracy = {{}, {}, "transport-64"};
    EXPECT_EQ(patient.stated, rendered(draft).stated_error);
}

// Two grids may be near to each other by luck; then the ones before tell.
TEST(Climb, StatedErrorsHardlyGrowFromGridToGrid) {
    for (const double density : {0.3, 3.0, 30.0}) {
        if (density != test::or_fewer(density, 3.0)) continue;
        double before = 0;
        for (const char* rung : {"transport-16", "transport-24", "transport-32", "transport-48"}) {
            SceneDraft draft = cumulus(0.6, density);
            draft.accuracy.rung = rung;
            const double stated = rendered(draft).stated_error;
            if (before > 0) {
                EXPECT_LE(stated, 1.25 * before) << density << ' ' << rung;
            }
            before = stated;
        }
    }
}

TEST(Climb, TheSameBytesOnAnyThreads) {
    SceneDraft draft = cumulus(0.6, 4);
    draft.detail = Detail{};
    draft.image.width = test::or_fewer(40, 12);
    draft.image.height = test::or_fewer(30, 9);
    draft.accuracy.rung = "transport-24";
    const Rendered one = rendered(draft, 1);
    for (const int threads : {2, 7, 32}) {
        const Rendered many = rendered(draft, threads);
        EXPECT_EQ(one.image.pixels, many.image.pixels) << threads;
        EXPECT_EQ(one.stated_error, many.stated_error) << threads;
    }
}

// Against the path tracer: what is stated is near to what is measured, and not below it by more than the noise.
TEST(Climb, WhatIsStatedHolds) {
    struct Case {
        double g, density;
        const char* rung;
    };
    for (const Case& one : {Case{0, 10, "transport-16"}, Case{0.5, 30, "transport-32"},
                            Case{0, 10, "transport-32"}, Case{0.85, 10, "transport-16"}}) {
        SceneDraft draft = cumulus(one.g, one.density);
        draft.accuracy.rung = one.rung;
        const Scene scene = test::valid(draft);
        const auto planned = plan_scene(scene, 2, {});
        ASSERT_TRUE(planned.ok());
        TruthOptions options;
        options.samples = test::or_fewer(64u, 16u);
        options.threads = 2;
        options.whole_pixels = true;
        const auto truth =
            trace_truth(scene, planned->particles, planned->survey.view, options, {}, {});
        ASSERT_TRUE(truth.ok());
        const Rendered picture = rendered(draft);
        const PictureError error = picture_error(picture.image, *truth);
        std::printf("g %.2f, density %g, %s: stated %.3f, measured %.3f +- %.3f\n", one.g,
                    one.density, one.rung, picture.stated_error, error.nrmse, error.nrmse_noise);
        EXPECT_GT(picture.stated_error, error.nrmse - 2 * error.nrmse_noise);
        EXPECT_LT(picture.stated_error, 4 * error.nrmse + 3 * error.nrmse_noise + 0.02);
    }
}

// A rung without a grid says how far off it is: in thick matter, far.
TEST(Climb, RungsWithoutAGridAreMeasuredToo) {
    SceneDraft draft = cumulus(0.6, 10);
    draft.accuracy.rung = "single";
    EXPECT_GT(rendered(draft).stated_error, 0.5);
    draft.density = 5e-5;
    EXPECT_LT(rendered(draft).stated_error, 0.05);
}

}  // namespace
}  // namespace awan
