// Cellular automata: their bits against a plain automaton, their randomness, their winds (core/generate/automaton).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/random_bits.h"
#include "core/generate/automaton/run.h"
#include "tests/automaton_compare.h"

namespace awan {
namespace {

using automaton::AutomatonGrid;
using automaton::AutomatonScratch;
using automaton::chance_of;
using automaton::FallOff;
using automaton::first_ellipsoids;
using automaton::first_state;
using automaton::kDistancePlanes;
using automaton::lanes_that_happen;
using automaton::make_fall_off;
using automaton::move_ellipsoids;
using automaton::run_automaton;
using automaton::step_automaton;

using test::busy;
using test::compare;

TEST(Automaton, IsThePlainOneBitByBitOverSeedsAndOddSizes) {
    constexpr double kSizes[][3] = {{1, 1, 1},  {2, 3, 1},  {5, 4, 7},   {63, 3, 4},
                                    {64, 4, 3}, {65, 5, 4}, {127, 4, 5}, {130, 6, 3}};
    for (const auto& size : kSizes) {
        std::uint64_t clouds = 0;
        for (std::uint64_t key = 1; key <= 3; ++key)
            clouds += compare(busy(size[0], size[1], size[2]), key * 977, 5,
                              std::to_string(size[0]) + " cells wide, key " + std::to_string(key));
        if (size[0] > 4) {
            EXPECT_GT(clouds, 0u) << size[0];
        }
    }
}

TEST(Automaton, IsThePlainOneWithBothWindsAndEitherOverlap) {
    for (const double speed : {0.4, 1.0, -0.7, 63.5, 64.0, -65.0, 300.0}) {
        AutomatonCloud cloud = busy(130, 5, 4);
        cloud.wind.layers = {speed, 0.1, -0.01};
        cloud.wind.ellipsoids = {{0, 3, {1.3, 0, 0}}, {2, 5, {-2, 0.1, 0.5}}};
        compare(cloud, 5, 4, "wind " + std::to_string(speed));
        cloud.overlap = AutomatonOverlap::kFirst;
        compare(cloud, 6, 4, "wind, first wins, " + std::to_string(speed));
    }
}

TEST(Automaton, IsThePlainOneAtTheEndsOfProbability) {
    for (const double humidity : {0.0, 1.0, 0.25})
        for (const double activation : {0.0, 1.0, 1e-4})
            for (const double extinction : {0.0, 1.0}) {
                AutomatonCloud cloud = busy(70, 4, 4);
                cloud.humidity = humidity;
                cloud.activation = activation;
                cloud.extinction = cloud.outside_extinction = extinction;
                compare(cloud, 11, 4, "ends");
            }
}

TEST(Automaton, BitsDoNotDependOnTheNumberOfThreads) {
    AutomatonCloud cloud = busy(256, 12, 256);
    cloud.random->count = 60;
    cloud.random->largest = {20, 6, 20};
    cloud.wind.layers.constant = 0.3;
    cloud.wind.ellipsoids = {{0, 12, {0.7, 0.1, 0}}};
    cloud.smooth_steps = 3;
    std::array<AutomatonState, 3> states;
    constexpr std::array<int, 3> kThreads = {1, 2, 7};
    for (std::size_t n = 0; n < 3; ++n) {
        AutomatonScratch scratch;
        states[n] = *run_automaton(cloud, 3, 12, kThreads[n], {}, scratch);
    }
    for (std::size_t n = 1; n < 3; ++n) {
        EXPECT_EQ(states[n].hum, states[0].hum);
        EXPECT_EQ(states[n].act, states[0].act);
        EXPECT_EQ(states[n].cld, states[0].cld);
        EXPECT_EQ(states[n].earlier, states[0].earlier);
    }
}

// --- randomness

TEST(AutomatonRandom, EventsHaveTheirProbability) {
    // Chi-square with one degree of freedom: (count - n p)^2 / (n p (1-p)). Its sum over 12 independent keys has mean
    // 12 and variance 24; 35 is exceeded by chance once in 2,000 times, and keys do not change.
    constexpr std::uint64_t kWords = 20000;
    for (const double p : {1e-4, 0.001, 0.013, 0.1, 1.0 / 3, 0.5, 0.75, 0.999}) {
        double chi = 0;
        for (std::uint64_t key = 1; key <= 12; ++key) {
            double count = 0;
            for (std::uint64_t word = 0; word < kWords; ++word)
                count += std::popcount(lanes_that_happen(~0ull, chance_of(p), key * 31, word));
            const double n = kWords * 64.0;
            chi += (count - n * p) * (count - n * p) / (n * p * (1 - p));
        }
        EXPECT_LT(chi, 35) << p;
    }
}

TEST(AutomatonRandom, NothingAndEverythingAreExact) {
    for (std::uint64_t word = 0; word < 1000; ++word) {
        EXPECT_EQ(lanes_that_happen(~0ull, chance_of(0), 5, word), 0u);
        EXPECT_EQ(lanes_that_happen(~0ull, chance_of(1), 5, word), ~0ull);
        // Once in 2^53 cells at most.
        EXPECT_EQ(lanes_that_happen(~0ull, chance_of(1e-17), 5, word), 0u);
        EXPECT_EQ(lanes_that_happen(~0ull, chance_of(1 - 0x1p-53), 5, word), ~0ull);
    }
    EXPECT_EQ(chance_of(1e-300).digits, 0u);
    EXPECT_EQ(chance_of(0.5).digits, 1ull << 63);
}

TEST(AutomatonRandom, EveryLaneHasItsOwnAnswerWhateverOthersAreAsked) {
    for (std::uint64_t word = 0; word < 200; ++word) {
        const std::uint64_t all = lanes_that_happen(~0ull, chance_of(0.2), 9, word);
        std::uint64_t single = 0;
        for (int lane = 0; lane < 64; ++lane)
            single |= lanes_that_happen(1ull << lane, chance_of(0.2), 9, word);
        EXPECT_EQ(all, single);
    }
}

TEST(AutomatonRandom, LanesAndWordsAreIndependent) {
    // Pairs that both happen at p = 1/4: neighbours in a word, in the next word, in the next key. n/16 each; 5 standard
    // deviations of a binomial.
    constexpr std::uint64_t kWords = 20000;
    double in_word = 0, next_word = 0, next_key = 0;
    for (std::uint64_t word = 0; word < kWords; ++word) {
        const std::uint64_t a = lanes_that_happen(~0ull, chance_of(0.25), 77, word);
        in_word += std::popcount(a & (a >> 1));
        next_word += std::popcount(a & lanes_that_happen(~0ull, chance_of(0.25), 77, word + 1));
        next_key += std::popcount(a & lanes_that_happen(~0ull, chance_of(0.25), 78, word));
    }
    const double sigma = std::sqrt(kWords * 64 / 16.0 * 15 / 16);
    EXPECT_NEAR(in_word, kWords * 63 / 16.0, 5 * sigma);
    EXPECT_NEAR(next_word, kWords * 64 / 16.0, 5 * sigma);
    EXPECT_NEAR(next_key, kWords * 64 / 16.0, 5 * sigma);
}

TEST(AutomatonRandom, DistanceIsLinearAlongARadius) {
    AutomatonCloud cloud;
    cloud.cells = {100, 3, 3};
    const AutomatonGrid grid(cloud.cells);
    FallOff fall_off;
    const std::vector<AutomatonEllipsoid> one = {{{20.5, 1.5, 1.5}, {40, 1.2, 1.2}}};
    ASSERT_FALSE(make_fall_off(grid, one, cloud.overlap, 0, 1, {}, fall_off));
    const std::size_t row = grid.row(1, 1) * grid.words;
    for (std::size_t i = 0; i < 100; ++i) {
        const std::size_t word = row + i / 64;
        const double d = std::abs(static_cast<double>(i) - 20) / 40;
        const bool inside = (fall_off.inside[word] >> (i % 64) & 1) != 0;
        EXPECT_EQ(inside, d < 1) << i;
        double digits = 0;
        for (std::size_t plane = 0; plane < kDistancePlanes; ++plane)
            digits =
                2 * digits + static_cast<double>(
                                 fall_off.distance[word * kDistancePlanes + plane] >> (i % 64) & 1);
        // Sixteen digits, cut off, of a float.
        if (inside) {
            EXPECT_NEAR(digits / 65536, d, 1.1 / 65536) << i;
        }
    }
    // Other rows lie outside: 1 cell / 1.2 radii, and the corner's is more.
    EXPECT_EQ(fall_off.row_inside[grid.row(0, 0)], 0);
    EXPECT_EQ(fall_off.row_inside[grid.row(0, 1)], 1);
}

// --- ellipsoids and wind

TEST(AutomatonEllipsoids, RandomOnesLieInTheGrid) {
    AutomatonCloud cloud = busy(100, 30, 60);
    cloud.random->count = 500;
    cloud.random->smallest = {3, 2, 3};
    cloud.random->largest = {80, 14, 20};  // wider than the grid in x: narrowed
    const auto ellipsoids = first_ellipsoids(cloud, 4);
    ASSERT_EQ(ellipsoids.size(), 500u);
    for (const AutomatonEllipsoid& one : ellipsoids)
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(one.center[axis] - one.radii[axis], -1e-9);
            EXPECT_LE(one.center[axis] + one.radii[axis], cloud.cells[axis] + 1e-9);
            EXPECT_GE(one.radii[axis], cloud.random->smallest[axis]);
        }
    cloud.random->level = 7;
    for (const AutomatonEllipsoid& one : first_ellipsoids(cloud, 4)) EXPECT_EQ(one.center.y, 7);
    // One more leaves the others as they were.
    cloud.random->count = 501;
    const auto more = first_ellipsoids(cloud, 4);
    cloud.random->level.reset();
    EXPECT_EQ(more[17].radii, first_ellipsoids(cloud, 4)[17].radii);
}

TEST(AutomatonEllipsoids, ThoseThatLeaveComeBackAtTheUpwindSide) {
    for (const double speed : {3.0, -3.0, 500.0}) {
        AutomatonCloud cloud = busy(100, 30, 60);
        cloud.random->count = 40;
        cloud.random->smallest = {3, 2, 3};
        cloud.random->largest = {10, 6, 10};
        cloud.wind.ellipsoids = {{-1000, 1000, {speed, 0, 0}}};
        cloud.wind.mutation = 0.4;
        const auto first = first_ellipsoids(cloud, 4);
        auto now = first;
        int came_back = 0;
        for (std::uint64_t step = 0; step < 300; ++step) {
            const auto before = now;
            EXPECT_TRUE(move_ellipsoids(cloud, first, 4, step, now));
            for (std::size_t n = 0; n < now.size(); ++n) {
                const glm::dvec3 r = now[n].radii, c = now[n].center;
                if (r == before[n].radii && c.y == before[n].center.y) {
                    EXPECT_DOUBLE_EQ(c.x, before[n].center.x + speed);
                } else {
                    ++came_back;
                    EXPECT_DOUBLE_EQ(c.x, speed > 0 ? r.x : 100 - r.x);
                }
                EXPECT_GT(c.x + r.x, 0);
                EXPECT_LT(c.x - r.x, 100);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(r[axis], first[n].radii[axis] * 0.6 - 1e-9);
                    EXPECT_LE(r[axis], first[n].radii[axis] * 1.4 + 1e-9);
                    if (axis > 0) {
                        EXPECT_GE(c[axis], r[axis] - 1e-9);
                        EXPECT_LE(c[axis], cloud.cells[axis] - r[axis] + 1e-9);
                    }
                }
            }
        }
        EXPECT_GT(came_back, 40);
    }
}

TEST(AutomatonEllipsoids, BandsMoveThoseInTheirRangeByTheSum) {
    AutomatonCloud cloud = busy(1000, 30, 60);
    cloud.random->count = 0;
    cloud.ellipsoids = {
        {{100, 5, 30}, {4, 4, 4}}, {{100, 15, 30}, {4, 4, 4}}, {{100, 25, 30}, {4, 4, 4}}};
    cloud.wind.ellipsoids = {{0, 15, {1, 0.1, 0.01}}, {15, 20, {2, 0, 0}}};
    auto now = cloud.ellipsoids;
    EXPECT_TRUE(move_ellipsoids(cloud, cloud.ellipsoids, 1, 0, now));
    EXPECT_DOUBLE_EQ(now[0].center.x, 100 + 1 + 0.1 * 5 + 0.01 * 25);
    EXPECT_DOUBLE_EQ(now[1].center.x, 100 + 1 + 0.1 * 15 + 0.01 * 225 + 2);
    EXPECT_EQ(now[2].center.x, 100);
    cloud.wind.ellipsoids.clear();
    EXPECT_FALSE(move_ellipsoids(cloud, cloud.ellipsoids, 1, 0, now));
}

TEST(AutomatonWind, LayersOfWholeCellsAndSavedUpFractions) {
    // Nothing but a full layer that the wind carries: no supply, no extinction.
    AutomatonCloud cloud = busy(200, 2, 1);
    cloud.humidity = cloud.activation = cloud.extinction = cloud.outside_extinction = 0;
    cloud.wind.layers = {0.25, 0.5, 0};  // .5 and 1 a step
    AutomatonScratch scratch;
    auto state = *first_state(cloud, 1, 1, {}, scratch);
    const AutomatonGrid grid(cloud.cells);
    state.cld[grid.row(0, 0) * grid.words] = 1;
    state.cld[grid.row(1, 0) * grid.words] = 1;
    scratch.row_lives.clear();
    for (int n = 0; n < 150; ++n) ASSERT_FALSE(step_automaton(cloud, 1, {}, scratch, state));
    const auto place = [&](std::size_t j) {
        for (std::size_t i = 0; i < 200; ++i)
            if ((state.cld[grid.row(j, 0) * grid.words + i / 64] >> (i % 64) & 1) != 0) return i;
        return std::size_t{999};
    };
    EXPECT_EQ(place(0), 75u);
    EXPECT_EQ(place(1), 150u);
    for (int n = 0; n < 60; ++n) ASSERT_FALSE(step_automaton(cloud, 1, {}, scratch, state));
    EXPECT_EQ(place(1), 999u);  // out at the border
}

TEST(AutomatonGrowth, CloudsStayOverTheirBaseAndVanishWithoutVapour) {
    AutomatonCloud cloud = busy(64, 16, 64);
    cloud.base = 6;
    AutomatonScratch scratch;
    auto state = *run_automaton(cloud, 1, 20, 1, {}, scratch);
    const AutomatonGrid grid(cloud.cells);
    std::uint64_t below = 0, above = 0;
    for (std::size_t k = 0; k < grid.nz; ++k)
        for (std::size_t j = 0; j < grid.ny; ++j) {
            const auto bits = static_cast<std::uint64_t>(std::popcount(state.cld[grid.row(j, k)]));
            (j < 6 ? below : above) += bits;
        }
    EXPECT_EQ(below, 0u);
    EXPECT_GT(above, 500u);
    cloud.humidity = cloud.activation = 0;
    cloud.extinction = cloud.outside_extinction = 1;
    cloud.ellipsoids = {};
    cloud.random->count = 0;
    scratch = {};
    state.ellipsoids.clear();
    // Those that are active still become clouds, one step later they are gone.
    for (int n = 0; n < 40; ++n) ASSERT_FALSE(step_automaton(cloud, 1, {}, scratch, state));
    EXPECT_TRUE(
        std::all_of(state.cld.begin(), state.cld.end(), [](auto word) { return word == 0; }));
}

}  // namespace
}  // namespace awan
