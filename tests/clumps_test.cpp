// Matter that stands in clumps which cells do not see.
#include "core/survey/clumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/accuracy/error_measures.h"
#include "core/pipeline.h"
#include "core/survey/islands.h"
#include "core/truth/path_tracer.h"
#include "tests/scenes.h"

namespace awan {
namespace {

void add(ParticleSet& set, const glm::dvec3& center, double s, double depth) {
    set.center.push_back(center);
    set.radius.push_back(static_cast<float>(2 * s));
    set.density.push_back(static_cast<float>(depth / (s * std::sqrt(2 * std::numbers::pi))));
}

// Balls on a lattice with so many along each side, `apart` from each other.
ParticleSet balls(int side, double apart, double s, double depth) {
    ParticleSet set;
    for (int i = 0; i < side * side * side; ++i)
        add(set, apart * glm::dvec3(i % side, i / side % side, i / side / side), s, depth);
    return set;
}

double hidden_in(double depth) {
    return 1 - (1 - std::exp(-depth)) / depth;
}

TEST(Clumps, OneBallIsClosedForm) {
    const double s = 0.7, depth = 3;
    ParticleSet set;
    add(set, {4, 5, 6}, s, depth);
    const Clumps clumps = find_clumps(set, {}, 1);
    for (std::size_t g = 0; g < Clumps::kGrids; ++g) {
        // Its box is four s wide.
        const double cell = 4 * s / (Clumps::kFewestCells << g);
        const double left = std::pow(s * s / (s * s + cell * cell / 4), 1.5);
        EXPECT_NEAR(clumps.hidden[g], (1 - left) * hidden_in((1 - left) * depth),
                    1e-3 + 0.02 * (1 - left))
            << g;
    }
}

TEST(Clumps, BallsFarApartAreHiddenFromCellsThatHoldSeveral) {
    const double depth = 5;
    const Clumps clumps = find_clumps(balls(12, 20, 1, depth), {}, 2);
    // Cells of 28 s, and of a third of an s.
    EXPECT_NEAR(clumps.hidden[0], hidden_in(depth), 0.02);
    EXPECT_LT(clumps.at(672), 0.12 * clumps.hidden[0]);
    for (std::size_t g = 1; g < Clumps::kGrids; ++g)
        EXPECT_LT(clumps.hidden[g], clumps.hidden[g - 1] + 1e-6);
}

TEST(Clumps, ThinOnesHideNothing) {
    EXPECT_LT(find_clumps(balls(8, 20, 1, 0.02), {}, 2).hidden[0], 0.011);
}

TEST(Clumps, OverlappingBallsAreNone) {
    // 1.25 s apart along each side: the sum is even but at its rim.
    const Clumps clumps = find_clumps(balls(20, 1.25, 1, 2), {}, 2);
    EXPECT_LT(clumps.hidden[0], 0.08);
    EXPECT_LT(clumps.at(20), 0.03);
}

TEST(Clumps, CellsAreThoseOfIslands) {
    // Two heaps far apart: on one grid for both a heap is a clump, on its own grid it is not.
    ParticleSet set = balls(8, 1.25, 1, 2);
    const std::size_t half = set.size();
    for (std::size_t i = 0; i < half; ++i) add(set, set.center[i] + glm::dvec3(3000, 0, 0), 1, 2);
    const Islands islands = find_islands(set);
    ASSERT_EQ(islands.list.size(), 2U);
    EXPECT_GT(find_clumps(set, {}, 1).hidden[1], 0.5);
    EXPECT_LT(find_clumps(set, islands, 1).hidden[1], 0.1);
}

TEST(Clumps, BetweenGrids) {
    Clumps clumps;
    clumps.hidden = {0.6, 0.4, 0.3, 0.2, 0.1, 0};
    EXPECT_NEAR(clumps.at(4), 0.6, 1e-12);
    EXPECT_NEAR(clumps.at(16), 0.4, 1e-12);
    EXPECT_NEAR(clumps.at(16 * std::sqrt(2.0)), 0.35, 1e-12);
    EXPECT_NEAR(clumps.at(4096), 0, 1e-12);
}

TEST(Clumps, AreTheSameForEveryNumberOfThreads) {
    const ParticleSet set = balls(9, 3, 1, 4);
    EXPECT_EQ(find_clumps(set, {}, 1).hidden, find_clumps(set, {}, 3).hidden);
}

// Small dense balls in a wide box, as a layout of many small particles has them: 16 cells do not see them, nor do 24.
TEST(Clumps, WhatTheyHideIsStated) {
    SceneDraft draft;
    Cube cube;
    cube.particles = 300;
    cube.size = {10, 10, 10};
    cube.radius = 0.2;
    draft.clouds.resize(1);
    draft.clouds[0].cubes = {cube};
    draft.fill = Fill::kUniform;
    draft.detail = std::nullopt;
    draft.density = 5 / (0.1 * std::sqrt(2 * std::numbers::pi));
    draft.image.width = 64;
    draft.image.height = 48;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = "truth";
    const Scene scene = test::valid(draft);
    const Planned planned = plan_scene(scene, 2, {}).value();
    TruthOptions options;
    options.samples = 64;
    options.whole_pixels = true;
    options.threads = 2;
    options.eye_effects = planned.plan.eye_effects();
    const auto truth = trace_truth(scene, planned.particles, planned.survey.view, options, {}, {});
    ASSERT_TRUE(truth.ok());
    for (const char* rung : {"transport-16", "transport-24"}) {
        draft.accuracy.rung = rung;
        const Rendered made =
            render_scene(test::valid(draft), {nullptr, 2, nullptr, {}, {}}, {}).value();
        const PictureError error = picture_error(made.image, *truth);
        EXPECT_GT(error.nrmse, 0.1) << rung;
        EXPECT_LT(error.nrmse - error.nrmse_noise, made.stated_error) << rung;
        EXPECT_LT(made.stated_error, 2.5 * error.nrmse) << rung;
    }
}

}  // namespace
}  // namespace awan
