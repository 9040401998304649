// Automata as documents and as files of states: what is read, refused, written and resumed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/run.h"
#include "core/generate/automaton/state_file.h"
#include "core/generate/generate.h"
#include "core/generate/models.h"
#include "core/scene/fingerprint.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/random_models_automaton.h"
#include "tests/scene_checks.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// Over every field of it.
std::string all_fields_of(const AutomatonCloud& cloud) {
    return fingerprint_of(table_of<AutomatonCloud>(), &cloud);
}

using automaton::AutomatonScratch;
using automaton::check_starts;
using automaton::read_state;
using automaton::run_automaton;
using automaton::write_state;

using namespace scene_checks;

std::string document(const std::string& fields) {
    return R"({"clouds":[{"model":"automaton","automaton":{)" + fields + "}}]}";
}

AutomatonCloud automaton_of(const std::string& fields) {
    return *draft_of(document(fields)).clouds[0].automaton;
}

TEST(AutomatonDocument, TheSmallestHasEveryDefault) {
    const AutomatonCloud cloud = automaton_of("");
    EXPECT_EQ(all_fields_of(cloud), all_fields_of(AutomatonCloud{}));
    EXPECT_EQ(cloud.cells, glm::dvec3(96, 32, 96));
    EXPECT_FALSE(check_model(cloud, ""));
    EXPECT_GT(random_ellipsoids_of(cloud).count, 0u);
    EXPECT_EQ(
        random_ellipsoids_of(automaton_of(R"("ellipsoids":[{"center":[1,2,3],"radii":[4,5,6]}])"))
            .count,
        0u);
}

TEST(AutomatonDocument, EveryFieldArrivesWhereItBelongs) {
    const AutomatonCloud cloud = automaton_of(R"(
        "cells": [10, 11, 12], "cell": 0.5, "ellipsoids": [
            {"center": [1, 2, 3], "radii": [4, 5, 6]}, {"center": [7, 8, 9], "radii": [1, 1, 1]}],
        "random": {"count": 3, "smallest": [1, 2, 3], "largest": [4, 5, 6], "level": "any"},
        "overlap": "first", "base": 2.5, "humidity": 0.11, "activation": 0.12, "extinction": 0.13,
        "outside_extinction": 0.14, "fall_off": "table", "fall_off_table": [1, 0.5, 0.25],
        "wind": {"direction": 45, "layers": {"constant": 1, "linear": 2, "quadratic": 3,
            "direction": -10, "turn": 4}, "layer_bands": [{"to": 5, "constant": 2, "turn": 1}],
            "ellipsoids": [{"from": 1, "to": 2, "constant": 3, "linear": 4, "quadratic": 5,
            "direction": 200, "turn": -3}, {"constant": 6}],
            "mutation": 0.5}, "smooth_weight": "table", "smooth_weight_table": [1, 0],
        "warm_up": 7, "steps_per_second": 8.5, "steps": 90, "smooth": [0, 1, 2], "smooth_steps": 3,
        "metaball_radius": 2.5, "threshold": 0.25, "most_particles": 1000)");
    EXPECT_EQ(cloud.cells, glm::dvec3(10, 11, 12));
    EXPECT_EQ(cloud.cell, 0.5);
    ASSERT_EQ(cloud.ellipsoids.size(), 2u);
    EXPECT_EQ(cloud.ellipsoids[0].center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.ellipsoids[0].radii, glm::dvec3(4, 5, 6));
    EXPECT_EQ(cloud.ellipsoids[1].center, glm::dvec3(7, 8, 9));
    ASSERT_TRUE(cloud.random);
    EXPECT_EQ(cloud.random->count, 3u);
    EXPECT_EQ(cloud.random->smallest, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.random->largest, glm::dvec3(4, 5, 6));
    EXPECT_FALSE(cloud.random->level);
    EXPECT_EQ(cloud.overlap, AutomatonOverlap::kFirst);
    EXPECT_EQ(cloud.base, 2.5);
    EXPECT_EQ(cloud.humidity, 0.11);
    EXPECT_EQ(cloud.activation, 0.12);
    EXPECT_EQ(cloud.extinction, 0.13);
    EXPECT_EQ(cloud.outside_extinction, 0.14);
    EXPECT_EQ(cloud.fall_off, AutomatonShape::kTable);
    EXPECT_EQ(cloud.fall_off_table, (std::vector<float>{1, 0.5F, 0.25F}));
    EXPECT_EQ(cloud.smooth_weight, AutomatonWeight::kTable);
    EXPECT_EQ(cloud.smooth_weight_table, (std::vector<float>{1, 0}));
    EXPECT_EQ(cloud.wind.direction, 45);
    EXPECT_EQ(cloud.wind.layers, (AutomatonSpeed{1, 2, 3, -10, 4}));
    ASSERT_EQ(cloud.wind.layer_bands.size(), 1u);
    EXPECT_EQ(cloud.wind.layer_bands[0].to, 5);
    EXPECT_EQ(cloud.wind.layer_bands[0].speed, (AutomatonSpeed{2, 0, 0, std::nullopt, 1}));
    ASSERT_EQ(cloud.wind.ellipsoids.size(), 2u);
    EXPECT_EQ(cloud.wind.ellipsoids[0].from, 1);
    EXPECT_EQ(cloud.wind.ellipsoids[0].to, 2);
    EXPECT_EQ(cloud.wind.ellipsoids[0].speed, (AutomatonSpeed{3, 4, 5, 200, -3}));
    EXPECT_EQ(cloud.wind.ellipsoids[1].speed.constant, 6);
    EXPECT_EQ(cloud.wind.mutation, 0.5);
    EXPECT_EQ(cloud.warm_up, 7u);
    EXPECT_EQ(cloud.steps_per_second, 8.5);
    EXPECT_EQ(cloud.steps, 90u);
    EXPECT_EQ(cloud.smooth, glm::dvec3(0, 1, 2));
    EXPECT_EQ(cloud.smooth_steps, 3u);
    EXPECT_EQ(cloud.metaball_radius, 2.5);
    EXPECT_EQ(cloud.threshold, 0.25);
    EXPECT_EQ(cloud.most_particles, 1000u);
    EXPECT_FALSE(check_model(cloud, ""));
}

TEST(AutomatonDocument, WhatIsWrittenReadsBackEqual) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        test::Dice dice(seed);
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.push_back(test::random_automaton(dice, {}));
        const std::string text = scene_to_json(draft);
        const SceneDraft again = draft_of(text);
        ASSERT_TRUE(again.clouds[0].automaton) << text;
        EXPECT_EQ(all_fields_of(*again.clouds[0].automaton),
                  all_fields_of(*draft.clouds[0].automaton))
            << text;
        EXPECT_EQ(fingerprint(test::valid(again)), fingerprint(test::valid(draft))) << text;
    }
    const SceneDraft standard = draft_of(document(""));
    EXPECT_NE(scene_to_json(standard).find(R"("automaton": {})"), std::string::npos);
}

TEST(AutomatonDocument, EveryFigureChangesTheFingerprint) {
    const std::string plain = fingerprint(test::valid(draft_of(document(""))));
    for (const char* fields : {R"("cells":[96,32,97])",
                               R"("cell":6)",
                               R"("ellipsoids":[{"center":[1,2,3],"radii":[4,5,6]}])",
                               R"("random":{"count":31})",
                               R"("random":{"level":6})",
                               R"("random":{"level":"any"})",
                               R"("random":{"smallest":[5,5,6]})",
                               R"("random":{"largest":[16,13,15]})",
                               R"("overlap":"first")",
                               R"("base":4)",
                               R"("humidity":0.2)",
                               R"("activation":0.1)",
                               R"("extinction":0.2)",
                               R"("outside_extinction":0.2)",
                               R"("fall_off":"smooth")",
                               R"("fall_off":"table","fall_off_table":[1,0])",
                               R"("smooth_weight":"smooth")",
                               R"("smooth_weight":"table","smooth_weight_table":[1,0])",
                               R"("wind":{"layers":{"direction":1}})",
                               R"("wind":{"direction":1})",
                               R"("wind":{"layers":{"turn":1}})",
                               R"("wind":{"layer_bands":[{}]})",
                               R"("wind":{"layers":{"constant":1}})",
                               R"("wind":{"layers":{"linear":1}})",
                               R"("wind":{"layers":{"quadratic":1}})",
                               R"("wind":{"ellipsoids":[{}]})",
                               R"("wind":{"ellipsoids":[{"from":1}]})",
                               R"("wind":{"mutation":0.5})",
                               R"("warm_up":41)",
                               R"("steps_per_second":2)",
                               R"("steps":999)",
                               R"("smooth":[1,1,2])",
                               R"("smooth_steps":2)",
                               R"("metaball_radius":2.5)",
                               R"("threshold":0.1)",
                               R"("most_particles":1000)"})
        EXPECT_NE(fingerprint(test::valid(draft_of(document(fields)))), plain) << fields;
    // That the default was given says nothing.
    EXPECT_EQ(fingerprint(test::valid(draft_of(document(R"("random":{})")))), plain);
    EXPECT_EQ(fingerprint(test::valid(draft_of(document(R"("wind":{"layers":{"direction":90}})")))),
              plain);
}

struct Wrong {
    const char* fields;
    const char* pointer;  // behind /clouds/0/automaton
};

TEST(AutomatonDocument, WhatCannotBeIsRefusedByItsPointer) {
    const Wrong kWrong[] = {
        {R"("cells":[0,1,1])", "/cells/0"},
        {R"("cells":[1,1025,1])", "/cells/1"},
        {R"("cells":[1,1,2.5])", "/cells/2"},
        {R"("cells":[1024,65,1024])", "/cells"},
        {R"("cells":[1,2])", "/cells"},
        {R"("cell":0)", "/cell"},
        {R"("cell":1e300)", "/cell"},
        {R"("cell":"big")", "/cell"},
        {R"("ellipsoids":[{"center":[1,2,3]}])", "/ellipsoids/0"},
        {R"("ellipsoids":[{"radii":[1,2,3]}])", "/ellipsoids/0"},
        {R"("ellipsoids":[7])", "/ellipsoids/0"},
        {R"("ellipsoids":[{"center":[1,2e9,3],"radii":[1,2,3]}])", "/ellipsoids/0/center/1"},
        {R"("ellipsoids":[{"center":[1,2,3],"radii":[1,2,0]}])", "/ellipsoids/0/radii/2"},
        {R"("random":{"count":1001})", "/random/count"},
        {R"("random":{"count":-1})", "/random/count"},
        {R"("random":{"smallest":[0,1,1]})", "/random/smallest/0"},
        {R"("random":{"largest":[15,1e9,15]})", "/random/largest/1"},
        {R"("random":{"largest":[15,4,15]})", "/random/largest/1"},
        {R"("random":{"level":1e9})", "/random/level"},
        {R"("random":{"level":"top"})", "/random/level"},
        {R"("overlap":"last")", "/overlap"},
        {R"("base":1e9)", "/base"},
        {R"("humidity":1.01)", "/humidity"},
        {R"("activation":-0.1)", "/activation"},
        {R"("extinction":2)", "/extinction"},
        {R"("outside_extinction":-1)", "/outside_extinction"},
        {R"("wind":{"layers":{"linear":1025}})", "/wind/layers/linear"},
        {R"("wind":{"layers":{"cubic":1}})", "/wind/layers/cubic"},
        {R"("wind":{"ellipsoids":[{},{"from":3,"to":2}]})", "/wind/ellipsoids/1/to"},
        {R"("wind":{"ellipsoids":[{"quadratic":-2000}]})", "/wind/ellipsoids/0/quadratic"},
        {R"("wind":{"mutation":1.5})", "/wind/mutation"},
        {R"("wind":{"direction":1e7})", "/wind/direction"},
        {R"("wind":{"layers":{"turn":361}})", "/wind/layers/turn"},
        {R"("wind":{"layer_bands":[{"from":3,"to":2}]})", "/wind/layer_bands/0/to"},
        {R"("fall_off":"cubic")", "/fall_off"},
        {R"("fall_off":"table")", "/fall_off_table"},
        {R"("fall_off":"table","fall_off_table":[1])", "/fall_off_table"},
        {R"("fall_off":"table","fall_off_table":[1,1.5])", "/fall_off_table/1"},
        {R"("fall_off_table":[1,0])", "/fall_off_table"},
        {R"("smooth_weight":"table")", "/smooth_weight_table"},
        {R"("smooth_weight":"table","smooth_weight_table":[0,1])", "/smooth_weight_table/0"},
        {R"("smooth_weight_table":[1,0])", "/smooth_weight_table"},
        {R"("warm_up":1001)", "/warm_up"},
        {R"("steps_per_second":-1)", "/steps_per_second"},
        {R"("steps":100001)", "/steps"},
        {R"("steps":100000,"cells":[1000,10,1000])", "/steps"},
        {R"("smooth":[5,1,1])", "/smooth/0"},
        {R"("smooth":[1,0.5,1])", "/smooth/1"},
        {R"("smooth_steps":0)", "/smooth_steps"},
        {R"("smooth_steps":9)", "/smooth_steps"},
        {R"("metaball_radius":1)", "/metaball_radius"},
        {R"("threshold":1.5)", "/threshold"},
        {R"("most_particles":0)", "/most_particles"},
        {R"("most_particles":5000000)", "/most_particles"},
        {R"("colour":1)", "/colour"},
    };
    for (const Wrong& wrong : kWrong) {
        auto draft = parse_scene(document(wrong.fields));
        const std::string pointer = [&] {
            if (!draft.ok()) return draft.error().pointer;
            auto scene = validate(*draft);
            return scene.ok() ? "nothing wrong" : scene.error().pointer;
        }();
        EXPECT_EQ(pointer, std::string("/clouds/0/automaton") + wrong.pointer) << wrong.fields;
    }
}

TEST(AutomatonDocument, NotANumberIsRefusedEverywhere) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto expect_refused = [&](auto change) {
        AutomatonCloud cloud;
        cloud.ellipsoids.push_back({});
        cloud.random = RandomEllipsoids{};
        cloud.wind.ellipsoids.push_back({});
        ASSERT_FALSE(check_model(cloud, ""));
        change(cloud);
        EXPECT_TRUE(check_model(cloud, ""));
    };
    for (double AutomatonCloud::*field :
         {&AutomatonCloud::cell, &AutomatonCloud::base, &AutomatonCloud::humidity,
          &AutomatonCloud::activation, &AutomatonCloud::extinction,
          &AutomatonCloud::outside_extinction, &AutomatonCloud::steps_per_second,
          &AutomatonCloud::metaball_radius, &AutomatonCloud::threshold})
        expect_refused([&](AutomatonCloud& c) { c.*field = nan; });
    for (int axis = 0; axis < 3; ++axis) {
        expect_refused([&](AutomatonCloud& c) { c.cells[axis] = nan; });
        expect_refused([&](AutomatonCloud& c) { c.smooth[axis] = nan; });
        expect_refused([&](AutomatonCloud& c) { c.ellipsoids[0].center[axis] = nan; });
        expect_refused([&](AutomatonCloud& c) { c.ellipsoids[0].radii[axis] = nan; });
        expect_refused([&](AutomatonCloud& c) { c.random->smallest[axis] = nan; });
        expect_refused([&](AutomatonCloud& c) { c.random->largest[axis] = nan; });
    }
    expect_refused([&](AutomatonCloud& c) { c.random->level = nan; });
    expect_refused([&](AutomatonCloud& c) { c.wind.layers.constant = nan; });
    expect_refused([&](AutomatonCloud& c) { c.wind.ellipsoids[0].from = nan; });
    expect_refused([&](AutomatonCloud& c) { c.wind.ellipsoids[0].to = nan; });
    expect_refused([&](AutomatonCloud& c) { c.wind.ellipsoids[0].speed.linear = nan; });
    expect_refused([&](AutomatonCloud& c) { c.wind.mutation = nan; });
}

// --- states

AutomatonCloud windy() {
    AutomatonCloud cloud;
    cloud.cells = {70, 12, 30};
    cloud.wind.ellipsoids = {{0, 100, {0.7, 0.01, 0}}};
    cloud.wind.layers.linear = 0.05;
    cloud.smooth_steps = 3;
    cloud.warm_up = 12;
    return cloud;
}

AutomatonState state_at(const AutomatonCloud& cloud, std::uint64_t step, std::uint64_t key = 5) {
    AutomatonScratch scratch;
    return *run_automaton(cloud, key, step, 1, {}, scratch);
}

TEST(AutomatonStates, ARunThatIsResumedIsTheSame) {
    AutomatonCloud cloud = windy();
    for (const std::uint64_t from : {0u, 1u, 2u, 7u, 20u}) {
        AutomatonCloud resumed = cloud;
        auto start = read_state(write_state(state_at(cloud, from)));
        ASSERT_TRUE(start.ok()) << start.error().message;
        resumed.starts = {std::make_shared<const AutomatonState>(*std::move(start))};
        for (const std::uint64_t to : {0u, 7u, 20u, 33u}) {
            EXPECT_EQ(write_state(state_at(resumed, to)), write_state(state_at(cloud, to)))
                << from << " to " << to;
            ModelRequest request;
            request.key = 5;
            request.time = static_cast<double>(to) - 12 + 0.3;
            const auto a = automaton::make_particles(cloud, request, {});
            const auto b = automaton::make_particles(resumed, request, {});
            ASSERT_TRUE(a.ok() && b.ok());
            EXPECT_EQ(a->particles.positions, b->particles.positions);
            EXPECT_EQ(a->particles.densities, b->particles.densities);
        }
    }
}

TEST(AutomatonStates, OfAnotherCloudAreRefused) {
    AutomatonCloud cloud = windy();
    const auto refusal = [&](const AutomatonCloud& other, std::uint64_t key) {
        AutomatonCloud resumed = other;
        resumed.starts = {std::make_shared<const AutomatonState>(state_at(cloud, 4))};
        AutomatonScratch scratch;
        const auto state = run_automaton(resumed, key, 9, 1, {}, scratch);
        return state.ok() ? std::string() : state.error().message;
    };
    EXPECT_EQ(refusal(cloud, 5), "");
    EXPECT_NE(refusal(cloud, 6).find("seed"), std::string::npos);
    AutomatonCloud other = cloud;
    other.humidity = 0.3;
    EXPECT_NE(refusal(other, 5).find("parameters"), std::string::npos);
    // What the bits do not depend on may be another.
    other = cloud;
    other.cell = 1, other.steps_per_second = 9, other.warm_up = 3, other.metaball_radius = 3;
    EXPECT_EQ(refusal(other, 5), "");
    // A file that says the right names and holds something else.
    AutomatonState forged = state_at(cloud, 4);
    forged.ellipsoids.pop_back();
    other = cloud;
    other.starts = {std::make_shared<const AutomatonState>(forged)};
    EXPECT_TRUE(check_starts(other, 5));
    forged = state_at(cloud, 4);
    forged.earlier.clear();
    other.starts = {std::make_shared<const AutomatonState>(forged)};
    EXPECT_TRUE(check_starts(other, 5));
}

TEST(AutomatonStates, DamagedFilesAreRefused) {
    AutomatonCloud cloud = windy();
    cloud.cells = {20, 4, 3};
    const std::string good = write_state(state_at(cloud, 6));
    ASSERT_TRUE(read_state(good).ok());
    for (std::size_t length = 0; length < good.size(); length += length < 100 ? 1 : 7) {
        const auto cut = read_state(std::string_view(good).substr(0, length));
        ASSERT_FALSE(cut.ok()) << length;
        EXPECT_EQ(cut.error().code, ErrorCode::kMalformed);
    }
    EXPECT_FALSE(read_state(good + std::string(8, '\0')).ok());
    EXPECT_FALSE(read_state(good + good).ok());
    for (std::size_t at = 0; at < good.size(); ++at)
        for (const char flip : {char{1}, char{64}}) {
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ flip);
            EXPECT_FALSE(read_state(bad).ok()) << at;
        }
    for (std::size_t word = 1; word < 10; ++word) {  // sizes that ask for all the memory there is
        std::string bad = good;
        std::memset(bad.data() + 8 * word, 0xff, 8);
        EXPECT_FALSE(read_state(bad).ok()) << word;
        std::memset(bad.data() + 8 * word, 0, 8);
        EXPECT_FALSE(read_state(bad).ok()) << word;
    }
}

TEST(AutomatonStates, WhatIsWholeButCannotBeIsRefused) {
    AutomatonState state = state_at(windy(), 6);
    state.cld[1] |= 1ull << 63;  // cell 127 of 70
    EXPECT_NE(read_state(write_state(state)).error().message.find("no cells"), std::string::npos);
    state = state_at(windy(), 6);
    state.ellipsoids[0].radii.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(read_state(write_state(state)).error().message.find("ellipsoid"), std::string::npos);
    state.ellipsoids[0].radii.x = -1;
    EXPECT_FALSE(read_state(write_state(state)).ok());
}

}  // namespace
}  // namespace awan
