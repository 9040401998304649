// Documents of clouds of spheres: what is read, written and refused, and where.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/scene/fingerprint.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "core/scene/spheres.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/random_models_spheres.h"
#include "tests/scene_checks.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// Over every field of it.
std::string all_fields_of(const SpheresCloud& cloud) {
    const SpheresCloud all = cloud;
    return fingerprint_of(table_of<SpheresCloud>(), &all);
}

using namespace scene_checks;

std::string spheres_with(const std::string& members) {
    return cloud_with(R"("model": "spheres", "spheres": {)" + members + "}");
}

TEST(SpheresJson, AnEmptyObjectIsACloudOfDefaults) {
    const SceneDraft draft = draft_of(spheres_with(""));
    ASSERT_EQ(draft.clouds.size(), 1u);
    EXPECT_EQ(draft.clouds[0].model, CloudModel::kSpheres);
    ASSERT_TRUE(draft.clouds[0].spheres);
    EXPECT_EQ(all_fields_of(*draft.clouds[0].spheres), all_fields_of(SpheresCloud{}));
    EXPECT_TRUE(validate(draft).ok());
}

TEST(SpheresJson, EveryFieldArrivesWhereItBelongs) {
    const SceneDraft draft = draft_of(spheres_with(
        R"("kind": "cirrus", "levels": 4, "size": [1, 2, 3], "visual_range": 5, "ratio_min": 0.1,
           "ratio_max": 0.2, "shift_min": 0.3, "shift_max": 0.4, "scaling": "every",
           "growth": "down", "parts": 7, "places": "dome", "ratio_law": "falling",
           "shift_law": "ends", "turning": 6,
           "poses": [{"time": 1}, {"time": 2.5, "shift": [1, 2, 3], "turn": [4, 5, 6], "scale": 2}],
           "bump": {"height": 0.2, "texture": "puff", "repeat": 3,
                    "waves": [{"amplitude": -0.5, "around": 3, "down": 1.5, "phase": 0.25}]},
           "morph": {"seed": 18446744073709551615, "duration": 7, "steps": 8})"));
    const SpheresCloud& cloud = *draft.clouds[0].spheres;
    EXPECT_EQ(cloud.kind, SpheresKind::kCirrus);
    EXPECT_EQ(cloud.levels, 4u);
    EXPECT_EQ(cloud.size, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.visual_range, 5);
    EXPECT_EQ(cloud.ratio_min, 0.1);
    EXPECT_EQ(cloud.ratio_max, 0.2);
    EXPECT_EQ(cloud.shift_min, 0.3);
    EXPECT_EQ(cloud.shift_max, 0.4);
    EXPECT_EQ(cloud.scaling, SpheresScaling::kEvery);
    EXPECT_EQ(cloud.growth, SpheresGrowth::kDown);
    EXPECT_EQ(cloud.parts, 7u);
    EXPECT_EQ(cloud.places, SpheresPlaces::kDome);
    EXPECT_EQ(cloud.ratio_law, SpheresLaw::kFalling);
    EXPECT_EQ(cloud.shift_law, SpheresLaw::kEnds);
    EXPECT_EQ(cloud.turning, 6);
    ASSERT_EQ(cloud.poses.size(), 2u);
    EXPECT_EQ(cloud.poses[0].scale, glm::dvec3(1));
    EXPECT_EQ(cloud.poses[1].time, 2.5);
    EXPECT_EQ(cloud.poses[1].shift, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.poses[1].turn, glm::dvec3(4, 5, 6));
    EXPECT_EQ(cloud.poses[1].scale, glm::dvec3(2));
    ASSERT_TRUE(cloud.bump);
    EXPECT_EQ(cloud.bump->height, 0.2);
    EXPECT_EQ(cloud.bump->texture, "puff");
    EXPECT_EQ(cloud.bump->repeat, 3u);
    ASSERT_EQ(cloud.bump->waves.size(), 1u);
    EXPECT_EQ(cloud.bump->waves[0].amplitude, -0.5);
    EXPECT_EQ(cloud.bump->waves[0].around, 3u);
    EXPECT_EQ(cloud.bump->waves[0].down, 1.5);
    EXPECT_EQ(cloud.bump->waves[0].phase, 0.25);
    ASSERT_TRUE(cloud.morph);
    EXPECT_EQ(cloud.morph->seed, UINT64_MAX);
    EXPECT_EQ(cloud.morph->duration, 7);
    EXPECT_EQ(cloud.morph->steps, 8u);
    EXPECT_TRUE(draft_of(spheres_with(R"("morph": {})")).clouds[0].spheres->morph);
    EXPECT_FALSE(draft_of(spheres_with(R"("morph": "none")")).clouds[0].spheres->morph);
}

TEST(SpheresJson, WhatIsWrittenIsReadAgain) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        test::Dice dice(seed);
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.push_back(test::random_spheres(dice, {glm::dvec3(1, 2, 3), 10}));
        const Scene scene = test::valid(draft);
        const std::string text = scene_to_json(*scene);
        const Result<Scene> again = read(text);
        ASSERT_TRUE(again.ok()) << text << again.error().message;
        EXPECT_EQ(fingerprint(scene), fingerprint(*again)) << text;
        EXPECT_EQ(scene_to_json(**again), text);
    }
}

TEST(SpheresJson, EveryFigureShowsInTheFingerprint) {
    const auto print = [](const std::string& members) {
        const Result<Scene> scene = read(spheres_with(members));
        EXPECT_TRUE(scene.ok()) << members;
        return scene.ok() ? fingerprint(*scene) : "";
    };
    std::set<std::string> prints = {print("")};
    const char* const changes[] = {R"("kind": "cirrus")",
                                   R"("levels": 5)",
                                   R"("size": [500, 300, 401])",
                                   R"("visual_range": 5)",
                                   R"("ratio_min": 0.25)",
                                   R"("ratio_max": 0.75)",
                                   R"("shift_min": 0.8)",
                                   R"("shift_max": 0.95)",
                                   R"("scaling": "every")",
                                   R"("growth": "down")",
                                   R"("morph": {})",
                                   R"("morph": {"seed": 3})",
                                   R"("morph": {"seed": 18446744073709551615})",
                                   R"("morph": {"seed": 18446744073709551614})",
                                   R"("morph": {"duration": 3})",
                                   R"("morph": {"steps": 3})",
                                   R"("parts": 6)",
                                   R"("places": "turned")",
                                   R"("places": "row")",
                                   R"("ratio_law": "middle")",
                                   R"("shift_law": "middle")",
                                   R"("turning": 1)",
                                   R"("poses": [{"time": 0}])",
                                   R"("poses": [{"time": 0, "turn": [0, 1, 0]}])",
                                   R"("poses": [{"time": 0, "scale": 2}])",
                                   R"("bump": {})",
                                   R"("bump": {"height": 0.1})",
                                   R"("bump": {"texture": "puff"})",
                                   R"("bump": {"texture": "torn"})",
                                   R"("bump": {"waves": [{}]})",
                                   R"("bump": {"waves": [{"down": 1}]})"};
    for (const char* const change : changes) {
        EXPECT_TRUE(prints.insert(print(change)).second) << change;
    }
    // What only says the default is the same scene.
    EXPECT_EQ(print(R"("kind": "cumulus", "ratio_max": 0.76, "shift_min": 0.9)"), print(""));
}

TEST(SpheresJson, RefusesWhatCannotBe) {
    const auto wrong = [](const std::string& members, const std::string& pointer,
                          std::initializer_list<const char*> words) {
        expect_error(spheres_with(members), ErrorCode::kInvalidScene, "/clouds/0/spheres" + pointer,
                     words);
    };
    wrong(R"("levels": 11)", "/levels", {"0", "10", "11"});
    wrong(R"("levels": 2.5)", "/levels", {"integer"});
    wrong(R"("levels": -1)", "/levels", {"integer"});
    wrong(R"("size": [1, 0, 1])", "/size/1", {"1e-05", "1e+06"});
    wrong(R"("size": [1, 1, 1e7])", "/size/2", {"1e+06"});
    wrong(R"("size": 3)", "/size", {"three numbers"});
    wrong(R"("visual_range": 0)", "/visual_range", {"4e-06", "1e+09"});
    wrong(R"("visual_range": -4)", "/visual_range", {"-4"});
    wrong(R"("ratio_min": -0.1)", "/ratio_min", {"from 0 to 1"});
    wrong(R"("ratio_max": 1.1)", "/ratio_max", {"0.01", "1"});
    wrong(R"("ratio_min": 0, "ratio_max": 0)", "/ratio_max", {"0.01"});
    wrong(R"("parts": 1)", "/parts", {"2", "12"});
    wrong(R"("parts": 13)", "/parts", {"2", "12"});
    wrong(R"("parts": 12, "levels": 7)", "/levels", {"9765625", "12 parts", "6 levels"});
    wrong(R"("parts": 6, "levels": 9)", "/levels", {"8 levels"});
    wrong(R"("places": "star")", "/places", {"cross", "dome"});
    wrong(R"("ratio_law": "bell")", "/ratio_law", {"uniform", "middle"});
    wrong(R"("turning": -1)", "/turning", {"3600"});
    wrong(R"("poses": [{}])", "/poses/0", {"time"});
    wrong(R"("poses": [{"time": 1}, {"time": 1}])", "/poses/1/time", {"later"});
    wrong(R"("poses": [{"time": 1, "scale": 0}])", "/poses/0/scale/0", {"0.001"});
    wrong(R"("poses": [{"time": 1, "scale": [1, 900, 1]}], "size": [1, 1e4, 1])", "/poses/0/scale/1", {"side"});
    wrong(R"("bump": {"texture": "nothing"})", "/bump/texture", {"puff", "uploaded"});
    wrong(R"("bump": {"height": 2})", "/bump/height", {"1"});
    wrong(R"("bump": {"repeat": 0})", "/bump/repeat", {"1", "64"});
    wrong(R"("bump": {"waves": [{"around": 65}]})", "/bump/waves/0/around", {"64"});
    wrong(R"("ratio_min": 0.8)", "/ratio_min", {"upper end", "0.76"});
    wrong(R"("shift_max": 1.5)", "/shift_max", {"from 0 to 1"});
    wrong(R"("shift_max": 0.5)", "/shift_min", {"upper end"});
    wrong(R"("kind": "stratus")", "/kind", {"cumulus", "cirrus"});
    wrong(R"("scaling": "all")", "/scaling", {"first", "every"});
    wrong(R"("growth": "left")", "/growth", {"up", "down"});
    wrong(R"("morph": {"duration": 0})", "/morph/duration", {"0.001"});
    wrong(R"("morph": {"steps": 0})", "/morph/steps", {"1", "100000"});
    wrong(R"("morph": {"seed": -1})", "/morph/seed", {"integer"});
    wrong(R"("morph": true)", "/morph", {"none"});
    wrong(R"("morph": {"to": 1})", "/morph/to", {"seed", "duration"});
    wrong(R"("color": 1)", "/color", {"levels"});
}

// Values that no document can hold, from C++.
TEST(SpheresJson, NotANumberIsInNoRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto pointer = [](auto change) {
        SpheresCloud cloud;
        cloud.morph.emplace();
        change(cloud);
        const Status wrong = check_model(cloud, "");
        return wrong ? wrong->pointer : "nothing";
    };
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.size.y = nan; }), "/size/1");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.visual_range = nan; }), "/visual_range");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.ratio_min = nan; }), "/ratio_min");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.ratio_max = nan; }), "/ratio_max");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.shift_min = nan; }), "/shift_min");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.shift_max = nan; }), "/shift_max");
    EXPECT_EQ(pointer([&](SpheresCloud& c) { c.morph->duration = nan; }), "/morph/duration");
    EXPECT_EQ(pointer([](SpheresCloud&) {}), "nothing");
}

TEST(SpheresJson, TheLimitsThemselvesAreAllowed) {
    for (const char* const members :
         {R"("levels": 0)", R"("levels": 10)", R"("size": [1e-5, 1e-5, 1e-5])",
          R"("size": [1e6, 1e-5, 1e6])", R"("visual_range": 4e-6)", R"("visual_range": 1e9)",
          R"("ratio_min": 0, "ratio_max": 1)", R"("ratio_min": 1, "ratio_max": 1)", R"("parts": 2)",
          R"("parts": 12, "levels": 6)", R"("parts": 5, "levels": 10)",
          R"("shift_min": 0, "shift_max": 0)", R"("shift_min": 1, "shift_max": 1)",
          R"("morph": {"duration": 1e-3, "steps": 100000})"}) {
        EXPECT_TRUE(read(spheres_with(members)).ok()) << members;
    }
}

}  // namespace
}  // namespace awan
