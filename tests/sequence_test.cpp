// Frames of a sequence: each depends on its time alone, and on what is settled for all.
#include "core/sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/generate/generate.h"
#include "core/scene/rungs.h"
#include "tests/patience.h"
#include "tests/scenes.h"

namespace awan {
namespace {

SceneDraft moving() {
    SceneDraft draft = test::table_4_4();
    draft.top_level_cubes = false;
    draft.clouds[0].velocity = {2, 0, -0.5};
    draft.image.width = test::or_fewer(48, 16);
    draft.image.height = test::or_fewer(36, 12);
    draft.sequence = Sequence{1, 9, 5};
    draft.accuracy.rung = "transport-16";
    return draft;
}

Settled settled_of(const SceneDraft& draft) {
    auto settled = settle(test::valid(draft), Settling::kMeasured, {nullptr, 2}, {});
    EXPECT_TRUE(settled.ok());
    return *std::move(settled);
}

Rendered rendered(const Scene& scene, Result<Planned> planned, int threads) {
    planned = with_detail_made(scene, std::move(planned), threads);
    EXPECT_TRUE(planned.ok());
    auto made = render_planned(scene, *std::move(planned), {nullptr, threads, nullptr, {}, {}}, {});
    EXPECT_TRUE(made.ok());
    return *std::move(made);
}

std::vector<float> pixels(const Frame& frame, int threads = 1) {
    return rendered(frame.scene, plan_frame(frame, threads, {}, {}), threads).image.pixels;
}

std::vector<float> pixels(const Scene& scene) {
    return rendered(scene, plan_still(scene, 1, {}, {}, {}), 1).image.pixels;
}

TEST(Sequence, TimesAreEvenFromTheFirstToTheLast) {
    const Sequence sequence{-1, 3, 9};
    EXPECT_EQ(frame_time(sequence, 0), -1);
    EXPECT_EQ(frame_time(sequence, 8), 3);
    for (std::uint64_t i = 1; i < 9; ++i)
        EXPECT_DOUBLE_EQ(frame_time(sequence, i) - frame_time(sequence, i - 1), 0.5);
    EXPECT_EQ(frame_time({5, 7, 1}, 0), 5);
    EXPECT_EQ(frame_time({5, 2, 2}, 1), 2);  // backwards
}

// What a farm relies on: the frame by itself, settled again, on other threads.
TEST(Sequence, AFrameAloneIsTheSameBytesAsAmongOthers) {
    SceneDraft draft = moving();
    draft.detail = Detail{};
    draft.accuracy = {};
    const Settled one = settled_of(draft), two = settled_of(draft);
    std::vector<std::vector<float>> forward;
    for (std::uint64_t i = 0; i < 5; ++i) {
        forward.push_back(pixels(frame_at(one, frame_time(*draft.sequence, i))));
    }
    const Frame alone = frame_at(two, frame_time(*draft.sequence, 3));
    EXPECT_EQ(pixels(alone, 2), forward[3]);
    EXPECT_NE(forward[3], forward[2]);
    // The scene as a service gets it: with its sequence, at that time.
    draft.time = frame_time(*draft.sequence, 3);
    const Scene scene = test::valid(draft);
    auto planned = plan_scene(scene, 1, {}, {});
    ASSERT_TRUE(planned.ok());
    auto rendered = render_planned(scene, *std::move(planned), {nullptr, 1, nullptr, {}, {}}, {});
    ASSERT_TRUE(rendered.ok());
    EXPECT_EQ(rendered->image.pixels, forward[3]);
}

TEST(Sequence, VelocityIsTranslationInTime) {
    SceneDraft draft = moving();
    draft.sequence.reset();
    draft.camera = {false, {0, 0, 60}, {0, 0, 0}, {0, 1, 0}, 40};
    draft.clouds[0].scale = 1.25;
    draft.clouds[0].rotate_y = 30;
    draft.time = 2;
    const auto moved = pixels(test::valid(draft));
    draft.time = 0;
    draft.clouds[0].translate += 2.0 * draft.clouds[0].velocity;
    EXPECT_EQ(pixels(test::valid(draft)), moved);
    draft.clouds[0].velocity = {0, 0, 0};
    draft.time = 77;
    EXPECT_EQ(pixels(test::valid(draft)), moved);
}

TEST(Sequence, TheAutomaticCameraHoldsTheCloudsAllTheWay) {
    const SceneDraft draft = moving();
    const Settled settled = settled_of(draft);
    EXPECT_FALSE(settled.draft.camera.automatic);
    for (std::uint64_t i = 0; i < draft.sequence->frames; ++i) {
        const Frame frame = frame_at(settled, frame_time(*draft.sequence, i));
        auto particles = generate(frame.scene, 1, {});
        ASSERT_TRUE(particles.ok());
        const Bounds bounds = bounds_of(*particles);
        const View view = resolve_view(frame.scene->camera, frame.scene->image, bounds);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p = glm::dvec3((corner & 1) ? bounds.max.x : bounds.min.x,
                                            (corner & 2) ? bounds.max.y : bounds.min.y,
                                            (corner & 4) ? bounds.max.z : bounds.min.z) -
                                 view.eye;
            const double depth = glm::dot(p, view.forward);
            EXPECT_GT(depth, 0);
            EXPECT_LE(std::abs(glm::dot(p, view.right)), depth * view.tan_half_fov * view.aspect);
            EXPECT_LE(std::abs(glm::dot(p, view.up)), depth * view.tan_half_fov);
        }
    }
}

TEST(Sequence, RungAndEffectsAreThoseOfTheMostDemandingFrame) {
    SceneDraft draft = moving();
    draft.camera = {false, {0, 5, 60}, {0, 0, 0}, {0, 1, 0}, 40};
    draft.ground = Ground{-6, glm::dvec3(0.3)};
    draft.accuracy = {};
    draft.sequence = Sequence{0, 400, 3};  // at its end the cloud is far away
    const Settled settled = settled_of(draft);
    ASSERT_TRUE(settled.draft.accuracy.rung.has_value());
    SceneDraft first = draft;
    first.sequence.reset();
    auto planned = plan_still(test::valid(first), 1, {}, {}, {});
    ASSERT_TRUE(planned.ok());
    EXPECT_GE(find_rung(*settled.draft.accuracy.rung)->id, find_rung(planned->plan.rung)->id);
    for (const EffectDecision& decision : planned->plan.effects)
        if (decision.on) {
            EXPECT_EQ(settled.draft.effects[static_cast<int>(decision.effect)], Switch::kOn)
                << effect_name(decision.effect);
        }
}

// The scene as a service gets it, whose error is measured while it is rendered, and a frame that a farm renders: the
// settled rung is of each of the means there are.
TEST(Sequence, AnErrorThatIsAskedForIsHeldAlikeByAll) {
    std::vector<std::string> rungs;
    for (const double error : {0.2, 0.1, 0.06, 0.04, 0.01}) {
        SceneDraft draft = moving();
        draft.sequence->frames = 2;
        draft.sequence->to = 3;
        // So few paths do that they are not too long to wait for.
        if (error < 0.02) draft.image.width = draft.image.height = 4;
        draft.accuracy = {error, {}, {}};
        draft.time = frame_time(*draft.sequence, 1);
        const Settled settled = settled_of(draft);
        rungs.push_back(settled.draft.accuracy.rung.value_or("none"));
        const Frame frame = frame_at(settled, draft.time);
        const Rendered alone = rendered(frame.scene, plan_frame(frame, 2, {}, {}), 2);
        const Scene scene = test::valid(draft);
        const Rendered served = rendered(scene, plan_scene(scene, 1, {}, {3}), 1);
        EXPECT_EQ(served.image.pixels, alone.image.pixels) << error;
        EXPECT_EQ(served.plan.rung, rungs.back()) << error;
        EXPECT_EQ(alone.plan.rung, rungs.back()) << error;
        EXPECT_EQ(served.stated_error, alone.stated_error) << error;
        EXPECT_NE(served.plan.rung_reason.find("measured"), std::string::npos);
    }
    std::printf("settled: %s %s %s %s %s\n", rungs[0].c_str(), rungs[1].c_str(), rungs[2].c_str(),
                rungs[3].c_str(), rungs[4].c_str());
    EXPECT_NE(rungs.front(), rungs[3]);
    EXPECT_EQ(rungs.back(), "truth");
}

// A time, too: the machine and its threads, which its forecast hangs on, are not those of the others.
TEST(Sequence, ATimeThatIsAskedForMeansTheSameRungOnAllMachines) {
    SceneDraft draft = moving();
    draft.accuracy = {{}, 150, {}};
    const Scene scene = test::valid(draft);
    const auto one = settle(scene, Settling::kMeasured, {nullptr, 1}, {});
    const auto eight = settle(scene, Settling::kForecast, {nullptr, 8}, {});
    ASSERT_TRUE(one.ok() && eight.ok());
    ASSERT_TRUE(one->draft.accuracy.rung.has_value());
    EXPECT_EQ(one->draft.accuracy.rung, eight->draft.accuracy.rung);
    const auto served = plan_only(scene, 1, {}, {7});
    ASSERT_TRUE(served.ok());
    EXPECT_EQ(served->plan.rung, *one->draft.accuracy.rung);
    EXPECT_TRUE(served->rung_is_settled);
}

TEST(Sequence, DetailGoesWithTheCloud) {
    SceneDraft draft = moving();
    draft.detail = Detail{};
    const Settled settled = settled_of(draft);
    ASSERT_TRUE(settled.detail.has_value());
    const Frame first = frame_at(settled, 1), later = frame_at(settled, 5);
    const glm::dvec3 moved = later.detail->origin - first.detail->origin;
    EXPECT_LT(glm::length(moved - 4.0 * draft.clouds[0].velocity), 1e-12);  // rounding
    EXPECT_EQ(later.detail->radius, first.detail->radius);
    // At the sequence's beginning, which is not time 0, it is where a picture of that time alone has it.
    SceneDraft alone = draft;
    alone.sequence.reset();
    alone.time = 1;
    const auto still = plan_scene(test::valid(alone), 1, {});
    EXPECT_EQ(first.detail->origin, still->survey.detail.origin);
    EXPECT_EQ(later.detail->extinction, first.detail->extinction);
}

// Light that was made for other matter would be a wrong picture.
TEST(Sequence, LightIsKeptForAnotherCameraAndMadeAnewForAnotherTime) {
    LightCache lights(64 << 20);
    SceneDraft draft = moving();
    draft.sequence.reset();
    draft.camera = {false, {0, 0, 60}, {0, 0, 0}, {0, 1, 0}, 40};
    const auto kept = [&](const SceneDraft& one) {
        const Scene scene = test::valid(one);
        auto rendered = render_scene(scene, {nullptr, 1, &lights, {}, {}}, {});
        EXPECT_TRUE(rendered.ok());
        return rendered->light_was_kept;
    };
    EXPECT_FALSE(kept(draft));
    draft.camera.eye.x = 10;
    EXPECT_TRUE(kept(draft));
    draft.time = 0.5;
    EXPECT_FALSE(kept(draft));
    draft.clouds[0].velocity = {0, 0, 0};
    EXPECT_TRUE(kept(draft));  // where it began
    draft.time = 0.75;
    EXPECT_TRUE(kept(draft));  // nothing moves
}

TEST(Sequence, WhatCannotBeNamesItsPlace) {
    const auto pointer = [](auto change) {
        SceneDraft draft = moving();
        change(draft);
        auto scene = validate(draft);
        return scene.ok() ? std::string("none") : scene.error().pointer;
    };
    EXPECT_EQ(pointer([](SceneDraft& d) { d.sequence->frames = 0; }), "/sequence/frames");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.sequence->frames = 1'000'000; }), "/sequence/frames");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.sequence->to = std::nan(""); }), "/sequence/to");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.sequence->from = -1e7; }), "/sequence/from");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.time = INFINITY; }), "/time");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.clouds[0].velocity.z = 1e7; }), "/clouds/0/velocity/2");
    // It would leave the world before the sequence ends.
    EXPECT_EQ(pointer([](SceneDraft& d) {
                  d.sequence->to = 1e5;
                  d.clouds[0].velocity.x = 1e5;
              }),
              "/clouds/0/velocity");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.look = Look::kGardner; }), "/look");
    EXPECT_EQ(pointer([](SceneDraft& d) { d.clouds[0].model = CloudModel::kSpheres; }),
              "/clouds/0");
}

// Where the settled camera would stand beyond the limits, every frame keeps its own.
TEST(Sequence, CloudsAtTheEndOfTheWorldHaveFramesToo) {
    SceneDraft draft = moving();
    draft.clouds[0].translate = {9.9999e8, 0, 9.99999e8};
    draft.clouds[0].scale = 1000;
    const Settled settled = settled_of(draft);
    const Frame frame = frame_at(settled, 3);
    EXPECT_EQ(frame.scene->time, 3);
}

}  // namespace
}  // namespace awan
