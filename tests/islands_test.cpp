// Scenes that fall apart into islands: how they are cut, and what light each gets.
#include "core/survey/islands.h"

#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>

#include "core/accuracy/error_measures.h"
#include "core/light/island_sun.h"
#include "core/light/light_cache.h"
#include "core/light/sun_depth.h"
#include "core/plan/forecast_figures.h"
#include "core/plan/island_settings.h"
#include "core/truth/path_tracer.h"
#include "server/document/json.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

// A round cloud of small balls with optical depth about `depth` through its middle.
void add_cloud(std::vector<test::Ball>& list, const glm::dvec3& center, double half, double depth,
               unsigned seed, int count = 60) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 0.33);
    const double radius = 0.6 * half, s = radius / 2;
    // The mean column through the middle of `count` Gaussians with this spread.
    const double spread = 0.33 * 0.33 * half * half + s * s;
    const double density = depth * spread / (count * s * s * s * std::sqrt(2 * std::numbers::pi));
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 off(normal(random), normal(random), normal(random));
        list.push_back(
            {center + half * glm::clamp(off, glm::dvec3(-0.8), glm::dvec3(0.8)), radius, density});
    }
}

SceneDraft field_of(const std::vector<test::Ball>& list) {
    SceneDraft draft = test::balls(list);
    draft.clouds[0].ready.colors.clear();
    draft.medium = {0.999, 0.6, PhaseFunction::kHenyeyGreenstein};
    draft.sun.intensity = 10;
    draft.accuracy.rung = "transport-24";
    return draft;
}

// Nine clouds of several sizes, some in others' shadow, under a sky; the eye is below them.
SceneDraft nine_clouds() {
    std::vector<test::Ball> list;
    for (int i = 0; i < 9; ++i)
        add_cloud(list, {9.0 * (i % 3 - 1) + i / 3, 0.8 * (i % 2), 10.0 * (i / 3 - 1)},
                  1.2 + 0.25 * (i * 4 % 9), 12, 100 + static_cast<unsigned>(i));
    SceneDraft draft = field_of(list);
    draft.sky = test::plain_draft().sky;
    draft.sun.intensity = 40;
    draft.sun.elevation = 25;
    draft.sun.azimuth = 70;
    draft.camera.eye = {2, -3, 30};
    draft.camera.target = {0, 0.5, 0};
    draft.image.width = 96;
    draft.image.height = 64;
    draft.image.background = Background::kTransparent;
    return draft;
}

Planned planned(const Scene& scene, int threads = 2) {
    return *plan_scene(scene, threads, {});
}

TransportLight solved(const Scene& scene, const Planned& plan, const TransportSettings& settings,
                      int threads = 2) {
    return *transport_light(scene, plan.particles, plan.survey, settings, threads, {});
}

TEST(Islands, EveryParticleIsInOneAndItsBoxHoldsIt) {
    const test::Stage stage = test::stage(nine_clouds());
    const Islands islands = find_islands(stage.particles);
    ASSERT_EQ(islands.list.size(), 9U);
    std::vector<std::size_t> count(islands.list.size());
    for (std::size_t i = 0; i < stage.particles.size(); ++i) {
        const auto at = static_cast<std::size_t>(island_at(islands, stage.particles.center[i]));
        ++count[at];
        const double reach = 4 * gaussian_s(stage.particles, i);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(islands.list[at].low[axis], stage.particles.center[i][axis] - reach);
            EXPECT_GE(islands.list[at].high[axis], stage.particles.center[i][axis] + reach);
        }
    }
    for (std::size_t i = 0; i < count.size(); ++i) EXPECT_EQ(count[i], islands.list[i].particles);
}

// A ray's regions are those of its points.
TEST(Islands, RaysMeetTheRegionsOfTheirPoints) {
    const test::Stage stage = test::stage(nine_clouds());
    const Islands islands = find_islands(stage.particles);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 start = 20.0 * glm::dvec3(unit(random), unit(random), unit(random));
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        for (double t = 0; t < 60;) {
            const IslandOnRay here = island_on_ray(islands, start, direction, t);
            ASSERT_GT(here.until, t);
            const double end = std::min(here.until, 60.0);
            for (const double part : {0.001, 0.5, 0.999})
                EXPECT_EQ(island_at(islands, start + (t + part * (end - t)) * direction),
                          here.island);
            t = here.until;
        }
    }
}

TEST(Islands, OneCloudIsOne) {
    EXPECT_TRUE(find_islands(test::stage(test::table_4_4()).particles).list.empty());
    for (const double far : {0.0, 1e8}) {
        std::vector<test::Ball> list;
        add_cloud(list, {far, 0, 0}, 3, 20, 1);
        EXPECT_TRUE(find_islands(test::stage(field_of(list)).particles).list.empty());
    }
    EXPECT_TRUE(find_islands(ParticleSet{}).list.empty());
}

// Apart, each has the light that it has alone: .5% is what the solve's tolerance, and the little that they see of each
// other at 60 times their size, leave.
TEST(Islands, TwoFarCloudsHaveTheirOwnLight) {
    std::vector<test::Ball> one, both;
    add_cloud(one, {0, 0, 0}, 2, 15, 1);
    both = one;
    add_cloud(both, {120, 0, -20}, 2, 15, 2);
    SceneDraft alone = field_of(one), pair = field_of(both);
    for (SceneDraft* draft : {&alone, &pair}) {
        draft->sky = test::plain_draft().sky;
        draft->sun.elevation = 60;
        draft->camera.eye = {0, 0, 12};
        draft->image.background = Background::kTransparent;
    }
    const Rendered a = test::render(alone, 2), b = test::render(pair, 2);
    ASSERT_EQ(b.survey.islands.list.size(), 2U);
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i) {
        sum += static_cast<double>(a.image.pixels[i]);
        difference += std::abs(static_cast<double>(a.image.pixels[i] - b.image.pixels[i]));
    }
    EXPECT_LT(difference, 0.005 * sum);
}

// SunDepth of an island counts what stands before it: trilinear between columns a third of s wide, 2% of the depth.
TEST(Islands, ShadowsOfOthersAreInTheDepthFromTheSun) {
    std::vector<test::Ball> list{{{0, 0, 0}, 2, 0.8}, {{0.3, 30, 0.2}, 3, 0.4}};
    SceneDraft draft = field_of(list);
    draft.sun.elevation = 90;
    const test::Stage stage = test::stage(draft);
    ParticleSet own;
    own.center = {stage.particles.center[0]};
    own.radius = {stage.particles.radius[0]};
    own.density = {stage.particles.density[0]};
    const SunDepth sun =
        sun_depth_in(sun_lattice(own, sun_direction(stage.scene->sun), 24, 1), stage.particles);
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {0.7, 0.5, -0.4}, {0, -2.5, 0}, {-1, 1, 1}}) {
        const double exact = test::line_depth(stage.particles, p, {0, 1, 0}, 0);
        EXPECT_NEAR(depth_at(sun, p), exact, 0.02 * exact + 0.01);
    }
}

// A neighbour need not stand between an island and the sun to shade it: out to 4 s its rim does. Each island's depth
// from the sun is that of all matter, wherever the neighbour's middle is.
TEST(Islands, ANeighboursRimShades) {
    std::vector<test::Ball> list;
    add_cloud(list, {0, 0, 0}, 2, 6, 1);
    // s = 3; its middle is as far beside the small cloud as 2 s and 2.7 s, high above it.
    list.push_back({{8, 60, 0}, 6, 4});
    list.push_back({{0, 62, 10}, 6, 4});
    SceneDraft draft = field_of(list);
    draft.sun.elevation = 90;
    const Scene scene = test::valid(draft);
    const Planned plan = planned(scene);
    const TransportLight light = solved(scene, plan, plan.plan.transport);
    ASSERT_GE(light.islands.size(), 2U);
    int lit = 0;
    double most_of_others = 0;
    for (const LightIsland& island : light.islands) {
        if (!island.lit || island.high.y > 30) continue;
        ++lit;
        for (const glm::dvec3 p :
             {glm::dvec3(0, 0, 0), {0.7, 0.5, -0.4}, {1.2, -0.5, 0}, {0.2, 0, 1.1}, {-1, -1, -1}}) {
            const double all = test::line_depth(plan.particles, p, {0, 1, 0}, 0);
            const double others =
                test::line_depth(plan.particles, p + glm::dvec3(0, 25, 0), {0, 1, 0}, 0);
            EXPECT_NEAR(depth_at(island.light.sun, p), all, 0.03 * all + 0.01);
            most_of_others = std::max(most_of_others, others);
        }
    }
    EXPECT_EQ(lit, 1);
    EXPECT_GT(most_of_others, 1);
}

TEST(Islands, ThreadsDoNotShow) {
    SceneDraft draft = nine_clouds();
    draft.accuracy.rung = "transport-16";
    draft.image.width = 48;
    draft.image.height = 32;
    const Scene scene = test::valid(draft);
    const Rendered one = *render_scene(scene, {nullptr, 1, nullptr, {}, {}}, {});
    const Rendered three = *render_scene(scene, {nullptr, 3, nullptr, {}, {}}, {});
    ASSERT_EQ(one.survey.islands.list.size(), 9U);
    EXPECT_EQ(one.image.pixels, three.image.pixels);
}

// Islands out of the picture have no light of their own; a light made for one camera is not another's.
TEST(Islands, WhatIsNotSeenIsNotSolved) {
    SceneDraft draft = nine_clouds();
    draft.camera.eye = {0, 0, 0};
    draft.camera.target = {0, 0, -10};
    draft.camera.fov = 30;
    const Scene scene = test::valid(draft), before = test::valid(nine_clouds());
    const Planned away = planned(scene), all = planned(before);
    std::size_t lit = 0;
    for (const LightIsland& island : solved(scene, away, away.plan.transport).islands)
        lit += island.lit ? 1U : 0U;
    EXPECT_GT(lit, 0U);
    EXPECT_LT(lit, 6U);
    EXPECT_NE(light_key(scene, away.plan.transport), light_key(before, all.plan.transport));
}

// Cells go with the square root of the size in the picture, in steps, within bounds.
TEST(Islands, FartherIslandsHaveFewerCells) {
    SceneDraft draft = nine_clouds();
    int previous = 1000;
    for (const double distance : {20.0, 60.0, 200.0, 2000.0}) {
        draft.camera.eye = {0, 0, distance};
        draft.camera.target = {0, 0, 0};
        const Planned plan = planned(test::valid(draft));
        int most = 0;
        for (const IslandCells& cells : plan.plan.transport.islands) {
            EXPECT_LE(cells.cells, 24);
            if (cells.sun_cells > 0) {
                EXPECT_GE(cells.cells, kLeastIslandCells);
            }
            most = std::max(most, cells.cells);
        }
        EXPECT_LE(most, previous);
        previous = most;
    }
    EXPECT_EQ(previous, kLeastIslandCells);
}

// Against every path of light: with islands the error is less than half of one grid's. Noise of the truth is taken out
// of the measure; two standard errors of it are allowed.
TEST(Islands, AreCloserToTheTruthThanOneGrid) {
    const Scene scene = test::valid(nine_clouds());
    const Planned plan = planned(scene);
    TruthOptions options;
    options.samples = 96;
    options.threads = 2;
    const TruthImage truth = *trace_truth(scene, plan.particles, plan.survey.view, options, {}, {});
    TransportSettings together = plan.plan.transport;
    together.islands.clear();
    PictureError error[2];
    for (int i = 0; i < 2; ++i) {
        const TransportLight light = solved(scene, plan, i == 0 ? plan.plan.transport : together);
        const Image image =
            *march(scene, plan.particles, plan.survey.view, light, {}, 2, Deadline{});
        error[i] = picture_error(image, truth);
        std::printf("%s: nrmse %.4f +- %.4f, bias %.4f +- %.4f, %.2f MB\n",
                    i == 0 ? "islands" : "one grid", error[i].nrmse, error[i].nrmse_noise,
                    error[i].bias, error[i].bias_noise, 1e-6 * static_cast<double>(light.bytes()));
    }
    EXPECT_LT(error[0].nrmse, 0.5 * error[1].nrmse + 2 * error[0].nrmse_noise);
}

// The preset of a hundred clouds: memory within what the plan says, cells and nodes as the forecast counts them to a
// factor of 1.5 (boxes are rounded up to cells; the islands' outlines are taken for ellipsoids). Times are for the
// reader.
TEST(Islands, SkyOfAHundredCostsWhatIsPredicted) {
    std::ifstream file(AWAN_SOURCE_DIR "/web/presets/sky-of-100.json");
    std::ostringstream text;
    text << file.rdbuf();
    SceneDraft draft = *parse_scene(text.str());
    EXPECT_EQ(draft.clouds.size(), 100U);
    EXPECT_EQ(particle_count(draft), 200'000U);
    draft.accuracy.rung = "transport-32";
    const Scene scene = test::valid(draft);
    const Planned plan = planned(scene);
    const std::size_t count = plan.survey.islands.list.size();
    EXPECT_GT(count, 30U);
    const auto start = Deadline::Clock::now();
    const TransportLight light = solved(scene, plan, plan.plan.transport);
    const double ms = ms_since(start);
    double cells = static_cast<double>(light.bands.at(0).moments.size());
    auto nodes = static_cast<double>(light.sun.depth.size());
    std::size_t lit = 0;
    for (const LightIsland& island : light.islands) {
        if (!island.lit) continue;
        ++lit;
        cells += static_cast<double>(island.light.bands.at(0).moments.size());
        nodes += static_cast<double>(island.light.sun.depth.size());
    }
    const IslandWork work = island_work(plan.plan.transport, scene, plan.survey);
    std::printf(
        "%zu islands, %zu lit, %.0f cells (%.0f said), %.0f nodes (%.0f said), %.1f MB of %.1f, "
        "light %.0f ms\n",
        count, lit, cells, work.cells, nodes, work.nodes, 1e-6 * static_cast<double>(light.bytes()),
        1e-6 * plan.plan.predicted.bytes, ms);
    EXPECT_LT(static_cast<double>(light.bytes()), plan.plan.predicted.bytes);
    EXPECT_LT(std::abs(std::log(cells / work.cells)), std::log(1.5));
    EXPECT_LT(std::abs(std::log(nodes / work.nodes)), std::log(1.5));
}

}  // namespace
}  // namespace awan
