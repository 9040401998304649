// States of automata that are kept for other frames (core/generate/automaton/kept_states.h).
#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/generate/automaton/kept_states.h"
#include "core/generate/automaton/run.h"
#include "core/generate/automaton/state_file.h"
#include "core/generate/generate.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using automaton::AutomatonScratch;
using automaton::bytes_of;
using automaton::KeptStates;
using automaton::rules_key;
using automaton::run_automaton;
using automaton::write_state;

AutomatonCloud windy() {
    AutomatonCloud cloud;
    cloud.cells = {70, 12, 30};
    cloud.wind.direction = 30;
    cloud.wind.ellipsoids = {{0, 100, {0.7, 0.01, 0}}};
    cloud.wind.layers.linear = 0.05;
    cloud.smooth_steps = 3;
    return cloud;
}

AutomatonState state_at(const AutomatonCloud& cloud, std::uint64_t step, std::uint64_t key = 5) {
    AutomatonScratch scratch;
    return *run_automaton(cloud, key, step, 1, {}, scratch);
}

TEST(AutomatonKeptStates, AnyFrameInAnyOrderHasTheBytesOfOneByItself) {
    const AutomatonCloud plain = windy();
    AutomatonCloud keeping = plain;
    keeping.kept = std::make_shared<KeptStates>(std::size_t{1} << 20);
    for (const std::uint64_t step : {40u, 41u, 3u, 200u, 199u, 0u, 64u, 120u, 121u, 122u, 7u})
        EXPECT_EQ(write_state(state_at(keeping, step)), write_state(state_at(plain, step))) << step;
    EXPECT_GT(keeping.kept->states(), 2u);
}

TEST(AutomatonKeptStates, AFrameFarOnIsMadeFromOneCloseBefore) {
    AutomatonCloud cloud = windy();
    const std::size_t one = bytes_of(state_at(cloud, 10));
    // Room for ten.
    cloud.kept = std::make_shared<KeptStates>(10 * one + one / 2);
    const auto latest = [&](std::uint64_t step) {
        const auto state = cloud.kept->latest(rules_key(cloud), 5, step);
        return state ? static_cast<std::int64_t>(state->step) : -1;
    };
    EXPECT_EQ(latest(1000), -1);
    state_at(cloud, 300);
    EXPECT_LE(cloud.kept->bytes_in_use(), 10 * one + one / 2);
    EXPECT_GE(cloud.kept->states(), 4u);
    EXPECT_EQ(latest(300), 300);
    EXPECT_EQ(latest(100000), 300);
    // Evenly over all that was run: ten states over 300 steps are at most 64 apart.
    for (std::int64_t step = 64; step < 300; ++step) {
        EXPECT_LE(step - latest(static_cast<std::uint64_t>(step)), 64) << step;
        EXPECT_NE(latest(static_cast<std::uint64_t>(step)), -1) << step;
    }
    // Played on, each frame is made from the one before.
    for (std::uint64_t step = 301; step < 320; ++step) {
        EXPECT_EQ(latest(step), static_cast<std::int64_t>(step) - 1);
        state_at(cloud, step);
        EXPECT_EQ(latest(step), static_cast<std::int64_t>(step));
        EXPECT_LE(cloud.kept->bytes_in_use(), 10 * one + one / 2);
    }
}

TEST(AutomatonKeptStates, OthersAreNotMistakenAndTheOldestGo) {
    AutomatonCloud cloud = windy();
    const std::size_t one = bytes_of(state_at(cloud, 10));
    const auto kept = std::make_shared<KeptStates>(6 * one);
    cloud.kept = kept;
    AutomatonCloud other = cloud;
    other.humidity = 0.3;
    state_at(cloud, 20);
    state_at(other, 20);
    state_at(cloud, 20, 6);
    for (const AutomatonCloud& c : {cloud, other})
        for (const std::uint64_t key : {5u, 6u}) {
            AutomatonCloud plain = c;
            plain.kept = nullptr;
            EXPECT_EQ(write_state(state_at(c, 23, key)), write_state(state_at(plain, 23, key)));
        }
    EXPECT_LE(kept->bytes_in_use(), 6 * one);
    for (std::uint64_t key = 10; key < 40; ++key) {
        state_at(cloud, 9, key);
        EXPECT_LE(kept->bytes_in_use(), 6 * one);
    }
    EXPECT_EQ(kept->latest(rules_key(cloud), 5, 1000), nullptr);
    EXPECT_NE(kept->latest(rules_key(cloud), 39, 1000), nullptr);
}

TEST(AutomatonKeptStates, WhatDoesNotFitIsNotKept) {
    AutomatonCloud cloud = windy();
    cloud.kept = std::make_shared<KeptStates>(1000);
    state_at(cloud, 20);
    EXPECT_EQ(cloud.kept->states(), 0u);
    EXPECT_EQ(cloud.kept->bytes_in_use(), 0u);
    // One only: that which was asked for last.
    cloud.kept = std::make_shared<KeptStates>(bytes_of(state_at(cloud, 10)) + 100);
    for (const std::uint64_t step : {20u, 21u, 22u}) {
        state_at(cloud, step);
        ASSERT_EQ(cloud.kept->states(), 1u);
        EXPECT_EQ(cloud.kept->latest(rules_key(cloud), 5, 1000)->step, step);
    }
}

TEST(AutomatonKeptStates, ThreadsShareThem) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.push_back({});
    draft.clouds[0].model = CloudModel::kAutomaton;
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(windy());
    const auto kept = std::make_shared<KeptStates>(std::size_t{1} << 18);
    std::vector<ParticleSet> alone(24), shared(24);
    for (const bool keeping : {false, true}) {
        if (keeping) automaton::keep_states(draft, kept);
        parallel_for(4, 24, [&](std::size_t n) {
            SceneDraft own = draft;
            own.time = 0.3 * static_cast<double>(n * 17 % 24);
            (keeping ? shared : alone)[n] = *generate(test::valid(own), 1, {});
        });
    }
    for (std::size_t n = 0; n < 24; ++n) {
        EXPECT_EQ(alone[n].center, shared[n].center) << n;
        EXPECT_EQ(alone[n].density, shared[n].density) << n;
    }
    EXPECT_GT(kept->states(), 0u);
}

}  // namespace
}  // namespace awan
