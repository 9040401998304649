// Wind over an automaton in any horizontal direction (core/generate/automaton/wind.h).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/wind.h"
#include "tests/automaton_compare.h"

namespace awan {
namespace {

using automaton::AutomatonGrid;
using automaton::first_ellipsoids;
using automaton::move_ellipsoids;
using automaton::shift_layers;
using automaton::wind_on_ellipsoids;
using automaton::wind_on_layers;
using test::busy;
using test::compare;

TEST(AutomatonWindDirection, IsAnAzimuthAsTheSuns) {
    AutomatonWind wind;
    wind.layers.constant = 2;
    const auto along = [&](double degrees) {
        wind.direction = degrees;
        return wind_on_layers(wind, 7);
    };
    // Exact, so that what blows along x does not drift along z.
    EXPECT_EQ(along(90), glm::dvec2(2, 0));
    EXPECT_EQ(along(0), glm::dvec2(0, 2));
    EXPECT_EQ(along(-90), glm::dvec2(-2, 0));
    EXPECT_EQ(along(180), glm::dvec2(0, -2));
    for (const double degrees : {17.0, 133.0, 291.5}) {
        const double a = degrees * std::numbers::pi / 180;
        EXPECT_NEAR(along(degrees).x, 2 * std::sin(a), 1e-14);
        EXPECT_NEAR(along(degrees).y, 2 * std::cos(a), 1e-14);
    }
}

TEST(AutomatonWindDirection, TurnsWithHeightAndBandsHaveTheirOwn) {
    AutomatonWind wind;
    wind.direction = 30;
    wind.layers = {1, 0.5, 0.25, std::nullopt, 4};
    wind.layer_bands = {{2, 5, {3, 0, 0, 0.0, 0}}};
    wind.ellipsoids = {{0, 5, {0, 1, 0, std::nullopt, 0}}, {4, 9, {2, 0, 0, 180.0, -10}}};
    const auto expect = [](const glm::dvec2& v, double x, double z) {
        EXPECT_NEAR(v.x, x, 1e-13);
        EXPECT_NEAR(v.y, z, 1e-13);
    };
    const auto rad = [](double degrees) { return degrees * std::numbers::pi / 180; };
    // v(y) = 1 + y/2 + y^2/4 towards 30 + 4 y; the band's 3 towards +z on top of it, from 2 to 5.
    const double fast = 1 + 1.5 + 2.25;
    expect(wind_on_layers(wind, 3), fast * std::sin(rad(42)), fast * std::cos(rad(42)) + 3);
    expect(wind_on_layers(wind, 0), std::sin(rad(30)), std::cos(rad(30)));
    expect(wind_on_ellipsoids(wind, 3), 3 * std::sin(rad(30)), 3 * std::cos(rad(30)));
    expect(wind_on_ellipsoids(wind, 4.5), 4.5 * std::sin(rad(30)) + 2 * std::sin(rad(135)),
           4.5 * std::cos(rad(30)) + 2 * std::cos(rad(135)));
    expect(wind_on_ellipsoids(wind, 10), 0, 0);
}

TEST(AutomatonWindDirection, IsThePlainAutomatonWhateverTheWayAndTheHeight) {
    for (const double degrees : {0.0, 45.0, 90.0, 200.0, 305.0})
        for (const double speed : {0.4, 1.0, 63.5, 300.0}) {
            AutomatonCloud cloud = busy(130, 5, 12);
            cloud.wind.direction = degrees;
            cloud.wind.layers = {speed, 0.1, -0.01, std::nullopt, 25};
            cloud.wind.layer_bands = {{1, 3, {-0.7, 0, 0, 10.0, 0}}};
            cloud.wind.ellipsoids = {{0, 3, {1.3, 0, 0, std::nullopt, 0}},
                                     {2, 5, {-2, 0.1, 0.5, 240.0, 7}}};
            compare(cloud, 5, 4, std::to_string(degrees) + " degrees, " + std::to_string(speed));
        }
}

// Dobashi et al. 2000 and Upchurch 2009 turn the simulation for other winds: bits moved along z are those moved along x
// in a grid that is turned.
TEST(AutomatonWindDirection, AlongZIsAlongXInATurnedGrid) {
    const AutomatonGrid wide(glm::dvec3(90, 3, 40)), deep(glm::dvec3(40, 3, 90));
    std::vector<std::uint64_t> of_wide(wide.all_words()), of_deep(deep.all_words());
    const auto word = [](const AutomatonGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
        return grid.row(j, k) * grid.words + i / 64;
    };
    for (std::size_t n = 0; n < 90; n += 3)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t m = (7 * n + 5 * j) % 40;
            of_wide[word(wide, n, j, m)] |= 1ull << n % 64;
            of_deep[word(deep, m, j, n)] |= 1ull << m % 64;
        }
    AutomatonWind wind;
    wind.layers = {1.7, -1.1, 0};
    AutomatonWind turned = wind;
    turned.direction = 0;
    for (std::uint64_t step = 0; step < 20; ++step) {
        std::vector<std::uint64_t> other_wide(of_wide), other_deep(of_deep), third(of_wide),
            fourth(of_deep);
        std::vector<std::uint8_t> lives_wide(wide.rows(), 1), lives_deep(deep.rows(), 1);
        shift_layers(wind, step, wide, {&of_wide, &other_wide, &third}, lives_wide);
        shift_layers(turned, step, deep, {&of_deep, &other_deep, &fourth}, lives_deep);
        EXPECT_EQ(of_deep, other_deep);
        int differ = 0, set = 0;
        for (std::size_t n = 0; n < 90; ++n)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t m = 0; m < 40; ++m) {
                    const bool a = (of_wide[word(wide, n, j, m)] >> n % 64 & 1) != 0;
                    const bool b = (of_deep[word(deep, m, j, n)] >> m % 64 & 1) != 0;
                    differ += a != b;
                    set += a;
                }
        EXPECT_EQ(differ, 0) << step;
        if (step < 10) {
            EXPECT_GT(set, 0) << step;
        }
    }
}

TEST(AutomatonWindDirection, EllipsoidsComeBackAtTheSideOppositeToThatByWhichTheyLeft) {
    AutomatonCloud cloud = busy(100, 30, 60);
    cloud.random->count = 60;
    cloud.random->smallest = {3, 2, 3};
    cloud.random->largest = {10, 6, 10};
    // So fast along z that, in a grid of that shape, as many leave by z as by x: 5/100 and 3/60 of a side a step.
    const double degrees = 180 - std::atan2(5.0, 3.0) * 180 / std::numbers::pi;
    cloud.wind.direction = degrees;
    cloud.wind.ellipsoids = {{-1000, 1000, {std::sqrt(34.0), 0, 0}}};
    const glm::dvec2 speed = wind_on_ellipsoids(cloud.wind, 5);
    EXPECT_NEAR(speed.x, 5, 1e-12);
    EXPECT_NEAR(speed.y, -3, 1e-12);
    const auto first = first_ellipsoids(cloud, 4);
    auto now = first;
    int by_x = 0, by_z = 0;
    for (std::uint64_t step = 0; step < 400; ++step) {
        const auto before = now;
        ASSERT_TRUE(move_ellipsoids(cloud, first, 4, step, now));
        for (std::size_t n = 0; n < now.size(); ++n) {
            const glm::dvec3 r = now[n].radii, c = now[n].center;
            if (r == before[n].radii) {
                EXPECT_DOUBLE_EQ(c.x, before[n].center.x + speed.x);
                EXPECT_DOUBLE_EQ(c.z, before[n].center.z + speed.y);
                EXPECT_LT(c.x - r.x, 100);
                EXPECT_GT(c.z + r.z, 0);
            } else if (c.x == r.x) {
                EXPECT_GE(before[n].center.x + speed.x - before[n].radii.x, 100 - 1e-9);
                ++by_x;
            } else {
                EXPECT_LE(before[n].center.z + speed.y + before[n].radii.z, 1e-9);
                EXPECT_DOUBLE_EQ(c.z, 60 - r.z);
                ++by_z;
            }
        }
    }
    // The wind's own share of either side; four standard deviations of a coin.
    EXPECT_GT(by_x + by_z, 500);
    EXPECT_NEAR(by_x, (by_x + by_z) / 2.0, 2 * std::sqrt(by_x + by_z));
}

}  // namespace
}  // namespace awan
