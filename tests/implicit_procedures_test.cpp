// Bubbles, Kelvin-Helmholtz billows and Benard cells against the laws that they are said to follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/implicit/field.h"
#include "core/generate/implicit/procedures.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

using implicit::Puff;

bool within(const implicit::Box& box, const Puff& puff) {
    for (int i = 0; i < 3; ++i)
        if (puff.center[i] - puff.radius < box.min[i] - 1e-9 ||
            puff.center[i] + puff.radius > box.max[i] + 1e-9)
            return false;
    return true;
}

TEST(Bubbles, RiseAsTheLapseLetsThemAndGrowWithTheirHeight) {
    ImplicitBubbles b;
    b.most = 30;
    b.knobs = 0;
    b.radius = 10;
    b.spread = {4, 0, 3};
    b.rise = 0.3;
    b.ceiling = 6;
    b.entrainment = 0.2;
    b.rate = 1000;  // all at once
    b.began = 0;
    const auto at = [&](double time) { return implicit::bubbles_at(b, 5, time); };
    const auto young = at(1), old = at(1e5);
    ASSERT_EQ(young.size(), 30u);
    ASSERT_EQ(old.size(), 30u);
    const double dt = 1e-3;
    for (const double time : {2.0, 8.0, 25.0}) {
        const auto before = at(time - dt), now = at(time), after = at(time + dt);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double height = now[i].center.y / b.radius, top = old[i].center.y / b.radius;
            const double speed = (after[i].center.y - before[i].center.y) / (2 * dt) / b.radius;
            // dh/dt = rise (1 - h / ceiling), its own ceiling being where it comes to rest.
            EXPECT_NEAR(speed, b.rise * (1 - height / top), 1e-5);
            EXPECT_LE(top, b.ceiling);
            // Radius and height: r = r0 + entrainment h.
            const double first = now[i].radius / b.radius - b.entrainment * height;
            EXPECT_NEAR(old[i].radius / b.radius - b.entrainment * top, first, 1e-9);
            EXPECT_GE(first, 0.75 - 1e-9);
            EXPECT_LE(first, 1.25 + 1e-9);
        }
    }
}

TEST(Bubbles, LeaveOneAfterAnotherAndStay) {
    ImplicitBubbles b;
    b.most = 25;
    b.rate = 2;
    b.began = -1;
    std::size_t before = 0;
    for (double time = -1; time <= 20; time += 0.5) {
        const auto puffs = implicit::bubbles_at(b, 9, time);
        EXPECT_EQ(puffs.size() % (1 + b.knobs), 0u);
        const std::size_t count = puffs.size() / (1 + b.knobs);
        EXPECT_NEAR(static_cast<double>(count), std::min(25.0, 2 * (time + 1)), 1.0);
        EXPECT_GE(count, before);
        before = count;
        for (const Puff& puff : puffs) {
            EXPECT_TRUE(within(implicit::bubbles_box(b), puff));
            EXPECT_GE(puff.weight, 0);
            EXPECT_LE(puff.weight, b.weight);
        }
    }
    EXPECT_EQ(before, 25u);
}

// The instability itself: a sheet of vortices of unit shear and wavelength grows by e^(pi t) while it is flat.
TEST(Billows, GrowAsLinearTheorySays) {
    const auto sheet = implicit::rolled_sheet(1e-4, 0.02, 10);
    const auto height = [](const implicit::SheetLine& line) {
        double most = 0;
        for (const glm::dvec2& p : line) most = std::max(most, std::abs(p.y));
        return most;
    };
    const double rate = std::log(height(sheet[10]) / height(sheet[4])) / (6 * implicit::kSheetStep);
    EXPECT_NEAR(rate, std::numbers::pi, 0.15 * std::numbers::pi);
    // Without a wave it stays flat.
    EXPECT_LT(height(implicit::rolled_sheet(0, 0.2).back()), 1e-6);
}

TEST(Billows, RollUpRoundTheirMiddles) {
    const auto sheet = implicit::rolled_sheet(0.04, 0.2);
    const implicit::SheetLine& last = sheet.back();
    // Its ends stay, and it is the same turned by half a turn about its middle.
    EXPECT_NEAR(glm::length(last[0]), 0, 1e-9);
    const std::size_t n = last.size();
    for (std::size_t i = 1; i < n; ++i)
        EXPECT_NEAR(glm::length(last[i] + last[n - i] - glm::dvec2(1, 0)), 0, 1e-6);
    // A line up through the middle meets the sheet once at first, and many times when it has rolled up.
    const auto crossings = [](const implicit::SheetLine& line) {
        int count = 0;
        for (std::size_t i = 1; i < line.size(); ++i)
            count += (line[i - 1].x < 0.501) != (line[i].x < 0.501) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(crossings(sheet[0]), 1);
    EXPECT_GE(crossings(last), 5);
    // The vortices' strength lies between two layers: the middle of the sheet's mass does not move.
    glm::dvec2 sum(0);
    for (const glm::dvec2& p : last) sum += p / static_cast<double>(n);
    EXPECT_NEAR(sum.y, 0, 1e-6);
}

TEST(Billows, LieInTheirBoxAndBeginFlat) {
    ImplicitBillows b;
    const auto sheet = implicit::rolled_sheet(b.amplitude, b.smoothing);
    const implicit::Box box = implicit::billows_box(b, sheet);
    for (const double time : {-100.0, 0.0, 40.0, 1e4}) {
        std::vector<implicit::Element> elements;
        implicit::add_billows(b, sheet, 3, time, {}, elements);
        EXPECT_EQ(elements.size(), 64 * b.waves);
        double high = 0;
        for (const implicit::Element& e : elements) {
            high = std::max(high, std::abs(static_cast<double>(e.at.y)));
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(e.box.min[i], box.min[i] - 1e-6);
                EXPECT_LE(e.box.max[i], box.max[i] + 1e-6);
            }
        }
        if (time <= b.began) {
            EXPECT_LE(high, b.amplitude * b.wavelength * 1.001);
        } else if (time >= 40) {
            EXPECT_GT(high, 0.1 * b.wavelength);
        }
    }
    // A flat sheet's density is about its weight.
    ImplicitCloud cloud = test::bare({});
    cloud.primitives.reset();
    cloud.billows = b;
    cloud.billows->amplitude = 0;
    for (const double x : {-110.0, 3.0, 57.0})
        EXPECT_NEAR(test::density(cloud, {x, 0, 10}), 1, 0.02);
}

TEST(Cells, ParcelsStayInTheirCellsAndGoRound) {
    ImplicitCells c;
    c.rings = 2;
    c.parcels = 12;
    c.irregular = 0;
    c.spacing = 100;
    c.depth = 30;
    c.turnover = 40;
    for (const bool open : {false, true}) {
        c.open = open;
        const auto puffs = implicit::cells_at(c, 4, 7);
        ASSERT_EQ(puffs.size(), 19u * 12);
        // 19 middles of a lattice of hexagons: one, six and twelve around it.
        std::size_t in_the_middle = 0;
        for (const Puff& p : puffs) {
            EXPECT_TRUE(within(implicit::cells_box(c), p));
            EXPECT_GE(p.center.y, -1e-9);
            EXPECT_LE(p.center.y, c.depth + 1e-9);
            // Within the hexagon of the middle cell: no farther than half a spacing along any of three directions.
            double most = 0;
            for (int k = 0; k < 3; ++k) {
                const double a = k * std::numbers::pi / 3;
                most =
                    std::max(most, std::abs(p.center.x * std::cos(a) + p.center.z * std::sin(a)));
            }
            in_the_middle += most < 50 ? 1u : 0u;
        }
        EXPECT_EQ(in_the_middle, 12u);
        // After one turnover all is as it was; between, it is not.
        const auto again = implicit::cells_at(c, 4, 7 + c.turnover),
                   half = implicit::cells_at(c, 4, 7 + c.turnover / 2);
        for (std::size_t i = 0; i < puffs.size(); ++i) {
            EXPECT_NEAR(glm::length(again[i].center - puffs[i].center), 0, 1e-6);
            EXPECT_GT(glm::length(half[i].center - puffs[i].center), 20);
        }
    }
}

// Closed: up in the middle, down along the wall, and cloudy in the middle; open: the other way.
TEST(Cells, RiseWhereTheirKindSays) {
    ImplicitCells c;
    c.rings = 0;
    c.parcels = 24;
    c.irregular = 0;
    c.spacing = 2;  // half of it is the wall
    c.turnover = 10;
    for (const bool open : {false, true}) {
        c.open = open;
        double cloud[2] = {0, 0}, rising[2] = {0, 0};
        int count[2] = {0, 0};
        for (double time = 0; time < 10; time += 0.5) {
            const auto now = implicit::cells_at(c, 8, time),
                       next = implicit::cells_at(c, 8, time + 0.01);
            for (std::size_t i = 0; i < now.size(); ++i) {
                const double out = std::hypot(now[i].center.x, now[i].center.z);
                const int outer = out > 0.5 ? 1 : 0;
                cloud[outer] += now[i].weight;
                rising[outer] += next[i].center.y - now[i].center.y;
                ++count[outer];
            }
        }
        const int up = open ? 1 : 0;
        EXPECT_GT(rising[up], 0);
        EXPECT_LT(rising[1 - up], 0);
        EXPECT_GT(cloud[up] / count[up], 2 * cloud[1 - up] / count[1 - up]);
    }
}

TEST(Procedures, TakeThePlaceOfThePresetsShapes) {
    for (int which = 0; which < 3; ++which) {
        ImplicitCloud cloud;
        if (which == 0) cloud.bubbles.emplace();
        if (which == 1) cloud.billows.emplace();
        if (which == 2) cloud.cells.emplace();
        const ImplicitSettings s = resolved(cloud);
        EXPECT_TRUE(s.primitives.empty());
        EXPECT_FALSE(s.base.has_value());
        EXPECT_EQ(s.mean_radius, which == 1 ? 16 : 24);
        const auto field = implicit::prepare_field(cloud, test::kKey, 0);
        double most = 0;
        const implicit::Box box = implicit::box_of(field);
        for (int i = 0; i < 8000; ++i) {
            const double u = (i % 40 + 0.5) / 40, v = (i / 40 % 20 + 0.5) / 20,
                         w = (i / 800 + 0.5) / 10;
            most = std::max(most, implicit::density_at(
                                      field, box.min + (box.max - box.min) * glm::dvec3(u, v, w)));
        }
        EXPECT_GT(most, 0.2) << which;
    }
}

}  // namespace
}  // namespace awan
