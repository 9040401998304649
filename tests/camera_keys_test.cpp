// A camera that moves along keys, and the flights that are made of them.
#include "core/scene/camera_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/flight_path.h"
#include "core/generate/generate.h"
#include "core/light/light_cache.h"
#include "core/pipeline.h"
#include "core/scene/combine.h"
#include "core/scene/fingerprint.h"
#include "core/scene/spheres.h"
#include "core/sequence.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using Keys = std::vector<CameraKey>;

constexpr glm::dvec3 kUp{0, 1, 0};

Camera at(const Keys& keys, double time, bool linear = false) {
    return camera_at(keys, linear, kUp, time);
}

Keys some_keys() {
    return {{1, {0, 0, 9}, {0, 0, 0}, 40},
            {2, {4, 1, 8}, {1, 0, 0}, 30},
            {5, {9, 3, -2}, {0, 2, 0}, 60},
            {5.5, {9, 3, -4}, {0, 2, 1}, 55},
            {9, {-5, 0, 3}, {0, 0, -1}, 20}};
}

TEST(CameraKeys, AreWhatTheCameraIsAtTheirTimes) {
    const Keys keys = some_keys();
    for (const bool linear : {false, true})
        for (const CameraKey& key : keys) {
            const Camera camera = at(keys, key.time, linear);
            EXPECT_FALSE(camera.automatic);
            EXPECT_EQ(camera.eye, key.eye);
            EXPECT_EQ(camera.target, key.target);
            EXPECT_EQ(camera.fov, key.fov);
            EXPECT_EQ(camera.up, kUp);
        }
    EXPECT_EQ(at(keys, -100).eye, keys.front().eye);
    EXPECT_EQ(at(keys, 100).eye, keys.back().eye);
    EXPECT_EQ(at({keys[1]}, 7).target, keys[1].target);
}

TEST(CameraKeys, ALineIsPassedAlongIt) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(3, 1, -2));
    Keys keys;
    for (const double s : {0.0, 1.0, 1.5, 6.0, 40.0, 40.5})
        keys.push_back({std::sqrt(s) + 0.1 * s, 1.0 + s * way, glm::dvec3(100) + s * way, 40});
    double before = -1;
    for (int i = 0; i <= 500; ++i) {
        const double time = keys.back().time * i / 500;
        const glm::dvec3 from_first = at(keys, time).eye - keys[0].eye;
        const double along = glm::dot(from_first, way);
        EXPECT_LT(glm::length(from_first - along * way), 1e-12) << time;
        // Without turning back.
        EXPECT_GE(along, before - 1e-12) << time;
        before = along;
    }
    // Even from key to key, it is even between them, to the bit or nearly so.
    Keys even;
    for (int i = 0; i < 6; ++i)
        even.push_back({0.7 * i, {2.0 * i, 5, -1.0 * i}, {2.0 * i, 0, 0}, 40});
    for (double time = 0; time <= 3.5; time += 0.01)
        EXPECT_LT(glm::length(at(even, time).eye - glm::dvec3(time / 0.7 * 2, 5, -time / 0.7)),
                  1e-12);
}

// One tangent on either side of a key: what the camera covers in a moment before it and after it is the same.
TEST(CameraKeys, TheCameraDoesNotJerk) {
    const Keys keys = some_keys();
    const double moment = 1e-6;
    for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
        const glm::dvec3 before = keys[i].eye - at(keys, keys[i].time - moment).eye,
                         after = at(keys, keys[i].time + moment).eye - keys[i].eye;
        EXPECT_LT(glm::length(after - before), 1e-3 * glm::length(after)) << i;
    }
    // Straight between keys, it does.
    const glm::dvec3 before = keys[2].eye - at(keys, keys[2].time - moment, true).eye,
                     after = at(keys, keys[2].time + moment, true).eye - keys[2].eye;
    EXPECT_GT(glm::length(after - before), 0.1 * glm::length(after));
}

// Eight keys of a circle: half way between two the curve is where the closed form of its tangents has it, .8% within.
TEST(CameraKeys, ACircleStaysRound) {
    Keys keys;
    for (int i = 0; i <= 24; ++i) {
        const double angle = i * std::numbers::pi / 4;
        keys.push_back({1.0 * i, {std::sin(angle), 0, std::cos(angle)}, {0, 0, 0}, 40});
    }
    const double half = std::numbers::pi / 8;
    const double middle = std::cos(half) + std::sin(2 * half) * std::sin(half) / 4;
    for (int i = 8; i < 16; ++i) EXPECT_NEAR(glm::length(at(keys, i + 0.5).eye), middle, 1e-12);
    for (double time = 8; time < 16; time += 0.05) {
        EXPECT_LT(glm::length(at(keys, time).eye), 1 + 1e-12) << time;
        EXPECT_GT(glm::length(at(keys, time).eye), middle - 1e-12) << time;
    }
}

TEST(CameraKeys, WhereTwoStandInOnePlaceTheCameraRests) {
    const glm::dvec3 place(3, 1, 4);
    const Keys keys = {{0, {0, 0, 9}, {0, 0, 0}, 40},
                       {1, place, {0, 0, 0}, 40},
                       {2, place, {0, 0, 0}, 40},
                       {3, {9, 0, 0}, {0, 0, 0}, 40}};
    for (double time = 1; time <= 2; time += 0.05) EXPECT_EQ(at(keys, time).eye, place);
}

// A lens does not zoom beyond its keys, nor a camera leave the world.
TEST(CameraKeys, StayWithinTheLimitsWhateverTheyAre) {
    std::mt19937_64 random(7);
    const auto pick = [&](std::initializer_list<double> of) {
        return *(of.begin() + static_cast<std::ptrdiff_t>(random() % of.size()));
    };
    const auto place = [&] {
        const auto one = [&] { return pick({-1e9, -1, 0, 1e-300, 1e-9, 2, 1e9}); };
        return glm::dvec3(one(), one(), one());
    };
    for (int round = 0; round < 600; ++round) {
        SceneDraft draft = test::table_4_4();
        draft.sequence = Sequence{-1, 1, 3, {}, round % 3 == 0, false};
        double time = pick({-1e6, -1, 0});
        for (int i = 0; i < 5; ++i) {
            CameraKey key{time, place(), place(), pick({0.01, 40, 170})};
            if (!(glm::length(key.target - key.eye) > 0)) key.target = {5, 5, 5};
            draft.sequence->camera.push_back(key);
            time = std::nextafter(time, 2e6) + pick({0, 1e-12, 1, 1e5});
        }
        if (!validate(draft).ok()) continue;
        const Keys& keys = draft.sequence->camera;
        for (int i = 0; i <= 20; ++i) {
            const double moment =
                keys.front().time + (keys.back().time - keys.front().time) * i / 20;
            SceneDraft still = still_of(draft, *draft.sequence, moment);
            still.time = 0;
            const auto valid = validate(still);
            ASSERT_TRUE(valid.ok()) << valid.error().pointer << ": " << valid.error().message
                                    << " in round " << round << " at " << moment;
        }
    }
}

TEST(CameraKeys, LookAnywhereEvenStraightDown) {
    const Keys keys = {{0, {0, 9, 0}, {0, 0, 0}, 40}, {1, {0, 9, 9}, {0, 0, 9}, 40}};
    for (const double time : {0.0, 0.3, 1.0}) {
        SceneDraft draft = test::table_4_4();
        draft.camera = at(keys, time);
        EXPECT_TRUE(validate(draft).ok());
        const View view = resolve_view(draft.camera, draft.image, {});
        EXPECT_NEAR(view.forward.y, -1, 1e-12);
        EXPECT_NEAR(glm::length(view.right), 1, 1e-12);
    }
}

// --- in a scene

SceneDraft turning() {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 16;
    draft.image.height = 12;
    draft.accuracy.rung = "transport-16";
    draft.sequence = Sequence{0, 2, 3, {}, false, false};
    draft.sequence->camera = {{0, {0, 0, 40}, {0, -1, 0}, 40},
                              {1, {30, 5, 30}, {0, -1, 0}, 40},
                              {2, {40, 0, 0}, {0, -1, 0}, 40}};
    return draft;
}

std::vector<float> picture_of(const SceneDraft& draft, LightCache* lights = nullptr,
                              bool* kept = nullptr) {
    auto rendered = render_scene(test::valid(draft), {nullptr, 1, lights, {}, {}}, {});
    EXPECT_TRUE(rendered.ok());
    if (kept != nullptr) *kept = rendered->light_was_kept;
    return rendered->image.pixels;
}

TEST(CameraKeys, AreWhatEveryPictureIsSeenFrom) {
    SceneDraft draft = turning();
    draft.time = 1;
    SceneDraft alone = draft;
    alone.sequence.reset();
    alone.camera = {false, {30, 5, 30}, {0, -1, 0}, kUp, 40};
    EXPECT_EQ(picture_of(draft), picture_of(alone));
    const std::string one = fingerprint(test::valid(draft));
    draft.time = 1.5;
    EXPECT_NE(fingerprint(test::valid(draft)), one) << "another place";
    EXPECT_EQ(light_fingerprint(test::valid(draft)), light_fingerprint(test::valid(alone)));
    // A frame as render writes it is what a service answers for its time.
    const auto settled = settle(test::valid(draft), Settling::kMeasured, {nullptr, 1}, {});
    ASSERT_TRUE(settled.ok());
    const Frame frame = frame_at(*settled, 1.5);
    auto planned = plan_frame(frame, 1, {}, {});
    const auto rendered =
        render_planned(frame.scene, *std::move(planned), {nullptr, 1, nullptr, {}, {}}, {});
    ASSERT_TRUE(rendered.ok());
    EXPECT_EQ(rendered->image.pixels, picture_of(draft));
}

TEST(CameraKeys, CloudsThatStandAreThoseOfTheFirstFrameAndLitOnce) {
    SceneDraft draft = turning();
    draft.top_level_cubes = false;
    draft.clouds[0].velocity = {3, 0, 0};
    draft.sequence->from = 0.5;
    draft.sequence->clouds_stand = true;
    LightCache lights(64 << 20);
    bool kept = true;
    for (const double time : {0.5, 1.0, 2.0}) {
        draft.time = time;
        SceneDraft alone = draft;
        alone.sequence.reset();
        alone.time = 0.5;
        alone.camera = at(draft.sequence->camera, time);
        EXPECT_EQ(picture_of(draft, &lights, &kept), picture_of(alone)) << time;
        EXPECT_EQ(kept, time > 0.5);
    }
    // The same for clouds that are made for their time.
    draft.clouds.assign(1, Cloud{});
    draft.clouds[0].model = CloudModel::kSpheres;
    draft.clouds[0].spheres = std::make_shared<SpheresCloud>();
    draft.time = 1;
    const std::string light = light_fingerprint(test::valid(draft));
    draft.time = 2;
    EXPECT_EQ(light_fingerprint(test::valid(draft)), light);
    draft.sequence->clouds_stand = false;
    EXPECT_NE(light_fingerprint(test::valid(draft)), light);
}

TEST(CameraKeys, ParticlesOfCloudsThatStandServeAllFrames) {
    SceneDraft draft = turning();
    draft.sequence->clouds_stand = true;
    const Scene scene = test::valid(draft);
    const Settled settled = settle(scene, Settling::kForecast, {nullptr, 1}, {}).value();
    const auto picture = [](const Frame& frame, StandingMatter* matter) {
        auto planned = with_detail_made(frame.scene, plan_frame(frame, 1, {}, {}, matter), 1);
        return render_planned(frame.scene, *std::move(planned), {nullptr, 1, nullptr, {}, {}}, {})
            ->image.pixels;
    };
    StandingMatter matter;
    for (const double time : {0.5, 1.0, 2.0}) {
        const Frame frame = frame_at(settled, time);
        const auto with = picture(frame, &matter);
        ASSERT_TRUE(matter.particles);
        EXPECT_FALSE(matter.particles->detail) << "it is made for each frame's survey";
        EXPECT_EQ(with, picture(frame, nullptr)) << time;
    }
    matter.particles = generate(test::valid(test::balls({{{0, 0, 0}, 2, 3}})), 1, {}).value();
    EXPECT_NE(picture(frame_at(settled, 1), &matter), picture(frame_at(settled, 1), nullptr))
        << "they are what is drawn";
}

TEST(CameraKeys, WhatCannotBeNamesItsPlace) {
    const auto pointer = [](auto change) {
        SceneDraft draft = turning();
        change(draft.sequence->camera);
        auto scene = validate(draft);
        return scene.ok() ? std::string("none") : scene.error().pointer;
    };
    EXPECT_EQ(pointer([](Keys&) {}), "none");
    EXPECT_EQ(pointer([](Keys& k) { k.clear(); }), "none");
    EXPECT_EQ(pointer([](Keys& k) { k[1].time = 0; }), "/sequence/camera/1/time");
    EXPECT_EQ(pointer([](Keys& k) { k[2].time = std::nan(""); }), "/sequence/camera/2/time");
    EXPECT_EQ(pointer([](Keys& k) { k[2].target = k[2].eye; }), "/sequence/camera/2/target");
    EXPECT_EQ(pointer([](Keys& k) { k[0].eye.y = 1e10; }), "/sequence/camera/0/eye/1");
    EXPECT_EQ(pointer([](Keys& k) { k[0].fov = 180; }), "/sequence/camera/0/fov");
    EXPECT_EQ(pointer([](Keys& k) { k.resize(limits::kMaxCameraKeys + 1); }),
              "/sequence/camera/10000");
}

// --- flights

Scene flight(const SceneDraft& draft, const FlightWish& wish) {
    auto scene = flight_of(draft, wish, 1, {});
    if (!scene.ok()) {
        ADD_FAILURE() << scene.error().pointer << ": " << scene.error().message;
        std::abort();
    }
    return *std::move(scene);
}

Bounds bounds_of_scene(const SceneDraft& draft) {
    SceneDraft still = draft;
    still.sequence.reset();
    return bounds_of(*generate(test::valid(still), 1, {}));
}

// How far beyond the picture's edge the farthest corner of the box is, 1: at the edge.
double reach_in_picture(const SceneDraft& scene, double time, const Bounds& bounds) {
    const SceneDraft still = still_of(scene, *scene.sequence, time);
    const View view = resolve_view(still.camera, still.image, bounds);
    double reach = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = glm::dvec3((corner & 1) ? bounds.max.x : bounds.min.x,
                                        (corner & 2) ? bounds.max.y : bounds.min.y,
                                        (corner & 4) ? bounds.max.z : bounds.min.z) -
                             view.eye;
        const double depth = glm::dot(p, view.forward);
        if (!(depth > 0)) return INFINITY;
        reach = std::max(
            {reach, std::abs(glm::dot(p, view.right)) / depth / view.tan_half_fov / view.aspect,
             std::abs(glm::dot(p, view.up)) / depth / view.tan_half_fov});
    }
    return reach;
}

SceneDraft cloud() {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 32;
    draft.image.height = 24;
    draft.accuracy = {};
    return draft;
}

TEST(Flight, AnOrbitKeepsItsDistanceAndTheWholeCloudInThePicture) {
    FlightWish wish;
    wish.frames = 20;
    const Scene scene = flight(cloud(), wish);
    const Sequence& sequence = *scene->sequence;
    ASSERT_EQ(sequence.camera.size(), 20U);
    EXPECT_TRUE(sequence.clouds_stand);
    EXPECT_EQ(scene->accuracy.rung, kFlightRung);
    const Bounds bounds = bounds_of_scene(cloud());
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max);
    const double distance = glm::length(sequence.camera[0].eye - center);
    double fullest = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const CameraKey& key = sequence.camera[static_cast<std::size_t>(i)];
        EXPECT_EQ(key.time, frame_time(sequence, i));
        EXPECT_NEAR(glm::length(key.eye - center), distance, 1e-9);
        EXPECT_LT(glm::length(key.target - center), 1e-9);
        const double reach = reach_in_picture(*scene, key.time, bounds);
        EXPECT_LT(reach, 1);
        fullest = std::max(fullest, reach);
    }
    EXPECT_GT(fullest, 0.9) << "no farther away than it must";
    // One turn, evenly, and not the first place once more at its end.
    const auto angle = [&](std::size_t a, std::size_t b) {
        const glm::dvec3 p = sequence.camera[a].eye - center, q = sequence.camera[b].eye - center;
        return std::atan2(p.z * q.x - p.x * q.z, p.x * q.x + p.z * q.z);
    };
    for (std::size_t i = 0; i < 20; ++i)
        EXPECT_NEAR(angle(i, (i + 1) % 20), std::numbers::pi / 10, 1e-9);
}

TEST(Flight, AnOrbitStaysAboveTheGround) {
    SceneDraft draft = cloud();
    const Bounds bounds = bounds_of_scene(draft);
    draft.ground = Ground{bounds.min.y - 0.5, glm::dvec3(0.2)};
    const Scene scene = flight(draft, {});
    for (const CameraKey& key : scene->sequence->camera) {
        EXPECT_GT(key.eye.y, draft.ground->height);
        EXPECT_LT(reach_in_picture(*scene, key.time, bounds), 1);
    }
}

TEST(Flight, AWayThroughBeginsAndEndsWithTheWholeCloudInThePicture) {
    FlightWish wish;
    wish.frames = 41;
    wish.path = FlightPath::kThrough;
    // Two clouds far apart: their middle is empty.
    SceneDraft two = cloud();
    two.top_level_cubes = false;
    two.clouds.push_back(two.clouds[0]);
    two.clouds[0].translate = {-30, 0, -4};
    two.clouds[1].translate = {30, 2, 5};
    for (const SceneDraft& draft : {cloud(), two}) {
        const Scene scene = flight(draft, wish);
        const Sequence& sequence = *scene->sequence;
        const Bounds bounds = bounds_of_scene(draft);
        EXPECT_LT(reach_in_picture(*scene, sequence.from, bounds), 1);
        EXPECT_LT(reach_in_picture(*scene, sequence.to, bounds), 1);
        const auto sun = sun_direction(scene->sun);
        EXPECT_GE(glm::dot(sequence.camera.front().eye - sequence.camera.back().eye, sun), -1e-9);
        // It passes through matter, and from there to its end it always has some before it.
        bool inside = false;
        for (const CameraKey& key : sequence.camera) {
            const SceneDraft still = still_of(*scene, sequence, key.time);
            const Scene valid = test::valid(still);
            const auto particles = generate(valid, 1, {});
            const auto surveyed = survey(valid, *particles, 1, {});
            ASSERT_TRUE(surveyed.ok());
            inside = inside || surveyed->eye_inside;
            EXPECT_GT(surveyed->covered, 0) << key.time;
        }
        EXPECT_TRUE(inside);
    }
}

// Also of clouds whose grids are as fine as they are large in the picture.
TEST(Flight, OneLightServesAllFrames) {
    SceneDraft draft = cloud();
    draft.image.width = 16;
    draft.image.height = 12;
    draft.top_level_cubes = false;
    draft.clouds.push_back(draft.clouds[0]);
    draft.clouds[1].translate = {90, 0, 20};
    draft.clouds[1].scale = 0.3;
    FlightWish wish;
    wish.frames = 5;
    wish.path = FlightPath::kThrough;
    const Scene scene = flight(draft, wish);
    LightCache lights(64 << 20);
    auto settled = settle(scene, Settling::kMeasured, {&lights, 1}, {});
    ASSERT_TRUE(settled.ok());
    for (std::uint64_t i = 0; i < 5; ++i) {
        settled->is_unmeasured = i > 1;
        const Frame frame = frame_at(*settled, frame_time(*scene->sequence, i));
        auto planned = plan_frame(frame, 1, {}, {});
        ASSERT_TRUE(planned.ok());
        EXPECT_EQ(planned->survey.islands.list.size(), 2U);
        const auto rendered =
            render_planned(frame.scene, *std::move(planned), {nullptr, 1, &lights, {}, {}}, {});
        ASSERT_TRUE(rendered.ok());
        EXPECT_EQ(rendered->light_was_kept, i > 0) << i;
        // Where nobody wants to know, no time is spent on measuring.
        EXPECT_EQ(std::isnan(rendered->stated_error), i > 1);
        EXPECT_EQ(rendered->times.measure_ms > 0, i <= 1);
    }
}

TEST(Flight, ThinMediumAndThickAreOpticalDepths) {
    const double depths[] = {1, 6, 30};
    for (int i = 0; i < 3; ++i) {
        FlightWish wish;
        wish.frames = 2;
        wish.thickness = static_cast<Thickness>(i);
        SceneDraft draft = cloud();
        draft.top_level_cubes = false;
        draft.clouds.push_back(draft.clouds[0]);
        draft.clouds[1].density = 0.7;
        const Scene scene = flight(draft, wish);
        SceneDraft still = still_of(*scene, *scene->sequence, 0);
        const Scene valid = test::valid(still);
        const auto surveyed = survey(valid, *generate(valid, 1, {}), 1, {});
        ASSERT_TRUE(surveyed.ok());
        EXPECT_NEAR(surveyed->optical_depth_zenith, depths[i], 0.01 * depths[i]);
    }
    FlightWish wish;
    wish.thickness = Thickness::kThick;
    SceneDraft empty = cloud();
    empty.clouds[0].cubes.clear();
    EXPECT_FALSE(flight_of(empty, wish, 1, {}).ok());
}

TEST(Flight, GoesWithTheSequenceThatThereIs) {
    SceneDraft draft = turning();
    FlightWish wish;
    wish.frames = 7;
    const Scene own = flight(draft, wish);
    EXPECT_EQ(own->sequence->camera.size(), 3U) << "its own keys";
    EXPECT_EQ(own->sequence->frames, 7U);
    EXPECT_FALSE(own->sequence->clouds_stand);
    wish.path = FlightPath::kOrbit;
    wish.rung = "single";
    // Backwards, too.
    std::swap(draft.sequence->from, draft.sequence->to);
    const Scene orbit = flight(draft, wish);
    EXPECT_EQ(orbit->sequence->camera.size(), 7U);
    EXPECT_EQ(orbit->sequence->from, 2);
    EXPECT_EQ(orbit->accuracy.rung, "single");
    draft.sequence->camera.clear();
    wish.path = FlightPath::kKeys;
    const auto none = flight_of(draft, wish, 1, {});
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().pointer, "/sequence/camera");
}

TEST(Combine, CloudsComeTogetherAndWhatCannotSaysWhy) {
    SceneDraft one = cloud(), two = cloud();
    two.density = 3;
    two.seed = 9;
    EXPECT_FALSE(combine_into(one, two).has_value());
    ASSERT_EQ(one.clouds.size(), 2U);
    EXPECT_EQ(one.clouds[1].density, 3);
    EXPECT_EQ(one.clouds[1].seed, 9U);
    EXPECT_FALSE(one.clouds[0].density);
    EXPECT_TRUE(validate(one).ok());
    two.medium.g = 0.1;
    EXPECT_EQ(combine_into(one, two)->pointer, "/medium");
    two = cloud();
    two.detail = Detail{};
    EXPECT_EQ(combine_into(one, two)->pointer, "/detail");
    two = cloud();
    two.look = Look::kGardner;
    EXPECT_EQ(combine_into(one, two)->pointer, "/look");
}

}  // namespace
}  // namespace awan
