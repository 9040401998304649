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
           "growth": "down",
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
                                   R"("morph": {"steps": 3})"};
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
    wrong(R"("ratio_min": 0)", "/ratio_min", {"0.05", "0.9"});
    wrong(R"("ratio_max": 1)", "/ratio_max", {"0.05", "0.9"});
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
          R"("ratio_min": 0.05, "ratio_max": 0.05)", R"("ratio_min": 0.9, "ratio_max": 0.9)",
          R"("shift_min": 0, "shift_max": 0)", R"("shift_min": 1, "shift_max": 1)",
          R"("morph": {"duration": 1e-3, "steps": 100000})"}) {
        EXPECT_TRUE(read(spheres_with(members)).ok()) << members;
    }
}

}  // namespace
}  // namespace awan
