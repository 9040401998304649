// The growing particle system of implicit clouds.
#include "core/generate/implicit/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace awan {
namespace {

using implicit::Box;
using implicit::Element;
using implicit::element_of;
using implicit::grown;
using implicit::GrownParticle;
using implicit::growth_box;
using implicit::kGrowthReach;

void expect_same(const GrownParticle& a, const GrownParticle& b) {
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.share, b.share);
    EXPECT_EQ(a.key, b.key);
    EXPECT_EQ(a.dormant, b.dormant);
}

TEST(Growth, TwelveSeedsBecomeAboutFifty) {
    double sum = 0;
    ImplicitGrowth growth;
    growth.most = 500;  // of itself, without a limit in its way
    for (std::uint64_t key = 0; key < 20; ++key) {
        EXPECT_EQ(grown(growth, key, 0).size(), 12u);
        const auto count = static_cast<double>(grown(growth, key, growth.duration).size());
        EXPECT_GT(count, 15);
        sum += count;
    }
    // Ebert 2002, figure 9.9: "approximately 50".
    EXPECT_NEAR(sum / 20, 50, 10);
    const ImplicitGrowth standard;
    EXPECT_LE(grown(standard, 1, 1e9).size(), 50u);
}

TEST(Growth, FiveSeedsCanBecomeAHundredAndFifty) {
    ImplicitGrowth growth;
    growth.seeds = 5;
    growth.most = 150;
    growth.rate = 1;
    for (std::uint64_t key = 0; key < 5; ++key) EXPECT_EQ(grown(growth, key, 60).size(), 150u);
}

// Full-grown halfway through the life; seeds have lived a fifth of theirs when all begins.
TEST(Growth, IsFullHalfwayThroughTheLife) {
    ImplicitGrowth growth;
    growth.rate = 0;
    for (const double part : {0.0, 0.1, 0.2, 0.28, 0.31, 0.5}) {
        const double lived = 0.2 + part;
        for (const GrownParticle& seed : grown(growth, 3, part * growth.lifetime)) {
            if (lived > 0.5) {
                EXPECT_GT(seed.share, 0.99) << part;
            } else {
                // Half of it is there after a quarter of the life.
                EXPECT_EQ(seed.share > 0.5, lived > 0.25) << part;
            }
        }
    }
}

TEST(Growth, NobodyDiesAndWhoRestsStays) {
    const ImplicitGrowth growth;
    std::vector<GrownParticle> before = grown(growth, 7, 0);
    for (double time = 0.4; time < 70; time += 1.3) {
        const std::vector<GrownParticle> now = grown(growth, 7, time);
        ASSERT_GE(now.size(), before.size()) << time;
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_EQ(now[i].key, before[i].key);
            EXPECT_GE(now[i].share, before[i].share);
            if (before[i].dormant) {
                EXPECT_TRUE(now[i].dormant);
                EXPECT_EQ(now[i].position, before[i].position);
            }
        }
        before = now;
    }
    EXPECT_TRUE(before[0].dormant);
}

TEST(Growth, MovesAndGrowsWithoutJumps) {
    const ImplicitGrowth growth;
    const double step = 0.03;
    std::vector<GrownParticle> before = grown(growth, 3, 10);
    for (double time = 10 + step; time < 14; time += step) {
        const std::vector<GrownParticle> now = grown(growth, 3, time);
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_LT(glm::distance(now[i].position, before[i].position), step * 1.0) << time;
            EXPECT_LT(std::abs(now[i].share - before[i].share), step * 0.2) << time;
        }
        // Who is born shows nothing yet.
        for (std::size_t i = before.size(); i < now.size(); ++i) EXPECT_LT(now[i].share, 0.01);
        before = now;
    }
}

TEST(Growth, AnyTimeAloneIsTheSameAsGoingThere) {
    // The answer has no memory: in any order, and beyond its ends, the same bytes.
    const ImplicitGrowth growth;
    const std::vector<double> times = {50, 3.3, 17, 0, 59.99, 17.01};
    std::vector<std::vector<GrownParticle>> once;
    for (const double time : times) once.push_back(grown(growth, 5, time));
    for (std::size_t k = times.size(); k-- > 0;) {
        const std::vector<GrownParticle> again = grown(growth, 5, times[k]);
        ASSERT_EQ(again.size(), once[k].size());
        for (std::size_t i = 0; i < again.size(); ++i) expect_same(again[i], once[k][i]);
    }
    // At the steps themselves it is the state that the steps between them start from: 15 s are 60 steps of a quarter.
    const std::vector<GrownParticle> at = grown(growth, 5, 15), after = grown(growth, 5, 15.0001);
    for (std::size_t i = 0; i < at.size(); ++i)
        EXPECT_LT(glm::distance(at[i].position, after[i].position), 1e-3);
    const std::vector<GrownParticle> end = grown(growth, 5, 60), never = grown(growth, 5, 1e6),
                                     early = grown(growth, 5, -100), start = grown(growth, 5, 0);
    ASSERT_EQ(end.size(), never.size());
    for (std::size_t i = 0; i < end.size(); ++i) expect_same(end[i], never[i]);
    for (std::size_t i = 0; i < start.size(); ++i) expect_same(start[i], early[i]);
}

TEST(Growth, ChildrenComeWhereTheTurbulenceIsStrong) {
    // The more turbulent its place, the more children: with rate 0 none, and the first-born's parents sit in stronger
    // turbulence than the rest on the mean over many keys (their fertility is its integral).
    ImplicitGrowth growth;
    growth.rate = 0;
    EXPECT_EQ(grown(growth, 1, 60).size(), 12u);
    growth.rate = 0.1;
    const std::size_t some = grown(growth, 1, 60).size();
    growth.rate = 0.2;
    EXPECT_GT(grown(growth, 1, 60).size(), some);
}

TEST(Growth, TheExtremesStayInBounds) {
    ImplicitGrowth growth;
    growth.seeds = 3;
    growth.most = 500;
    growth.force = {10, -10, 10};
    growth.velocity = {10, 10, -10};
    growth.turbulence = 10;
    growth.rate = 1000;
    growth.lifetime = growth.duration = 1e5;
    for (const double drag : {0.0, 10.0}) {
        growth.drag = drag;
        const std::vector<GrownParticle> all = grown(growth, 2, 1e5);
        EXPECT_EQ(all.size(), 500u);
        for (const GrownParticle& p : all)
            for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(p.position[i]), kGrowthReach);
    }
}

TEST(Growth, ItsBoxHoldsAllOfThemAtAllTimes) {
    const ImplicitGrowth growth;
    const Box box = growth_box(growth, 9);
    for (const double time : {0.0, 11.3, 30.0, 60.0})
        for (const GrownParticle& p : grown(growth, 9, time)) {
            const Element e = element_of(p, {growth.center, growth.radius, growth.weight}, {});
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(e.box.min[i], box.min[i] - 1e-9);
                EXPECT_LE(e.box.max[i], box.max[i] + 1e-9);
            }
        }
}

}  // namespace
}  // namespace awan
