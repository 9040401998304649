// Warps, key frames and bounds of implicit clouds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/generate/implicit/field.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

using implicit::Box;
using implicit::box_of;
using implicit::density_at;
using implicit::elements_near;
using implicit::ImplicitField;
using implicit::prepare_field;
using implicit::row_densities;

using test::all_over;
using test::ball;
using test::bare;
using test::density;
using test::printed_cubic;

// Of mean radius 1, taller than broad.
ImplicitCloud tower() {
    return bare({ball({0, 0, 0}, 1), ball({0, 1, 0}, 1.2), ball({0.3, 2, 0}, 0.8)});
}

void expect_equal(const ImplicitCloud& a, const ImplicitCloud& b, double time = 0) {
    all_over({0, 1, 0}, 2.5, 300,
             [&](glm::dvec3 p) { EXPECT_EQ(density(a, p, time), density(b, p, time)); });
}

TEST(Warps, WithoutStrengthTheyAreTheIdentity) {
    ImplicitCloud cloud = tower();
    cloud.attractors = {{{0.5, 1, 0}, 0, 2}};
    cloud.flow = ImplicitFlow{{-1, -1, -1}, {1, 1, 1}, {1, 1, 1}, {{0, 0, 0}}};
    expect_equal(cloud, tower());
    // Rotations by nothing go through sines: equal but for floats.
    cloud.vortices = {{{0.5, 1, 0}, {0, 1, 0}, 0, 2}};
    all_over({0, 1, 0}, 2.5, 300,
             [&](glm::dvec3 p) { EXPECT_NEAR(density(cloud, p), density(tower(), p), 2e-6); });
}

TEST(Warps, AnAttractorShowsWhatIsFartherOut) {
    ImplicitCloud cloud = tower();
    const glm::dvec3 at(0.5, 1.2, 0.1);
    for (const double strength : {-0.9, -0.3, 0.7, 3.0, 10.0}) {
        cloud.attractors = {{at, strength, 1.4}};
        all_over({0, 1, 0}, 2.5, 200, [&](glm::dvec3 p) {
            const double h = printed_cubic(glm::distance(p, at) / 1.4);
            EXPECT_NEAR(density(cloud, p), density(tower(), p + strength * h * (p - at)), 1e-5);
        });
    }
}

TEST(Warps, AVortexTurnsItsMiddleByItsAngleAndNothingOutside) {
    ImplicitCloud cloud = bare({ball({0.02, 0, 0}, 0.05), ball({5, 0, 0}, 1.95)});
    cloud.vortices = {{{0, 0, 0}, {0, 3, 0}, 90, 2}};
    // From +x by 90 degrees about +y: to -z; at .02 of 2 the angle is 90 (1 - 22/9 .0001).
    EXPECT_NEAR(density(cloud, {0, 0, -0.02}), 1, 1e-3);
    EXPECT_NEAR(density(cloud, {5, 0.1, 0}), printed_cubic(0.1 / 1.95), 1e-5);
    // A full turn in the middle leaves distances from the axis: a ball around it stays.
    ImplicitCloud round = bare({ball({0, 0, 0}, 1)});
    round.vortices = {{{0, 0, 0}, {1, 2, -1}, 770, 1.5}};
    all_over({0, 0, 0}, 1, 200, [&](glm::dvec3 p) {
        EXPECT_NEAR(density(round, p), printed_cubic(glm::length(p)), 1e-5);
    });
}

TEST(Warps, AFlowTableMovesMatterByItsVectors) {
    ImplicitCloud cloud = tower();
    const glm::dvec3 v(0.4, -0.2, 0.7);
    cloud.flow = ImplicitFlow{{-1, -1, -1}, {1, 1, 1}, {2, 1, 1}, {v, v}};
    all_over({0, 1, 0}, 2.5, 200,
             [&](glm::dvec3 p) { EXPECT_NEAR(density(cloud, p), density(tower(), p - v), 1e-6); });
    // Trilinear: at a table's points its vectors, halfway their mean, outside those of the face.
    ImplicitFlow flow{{-1, 0, -1}, {1, 2, 1}, {2, 3, 2}, {}};
    for (int i = 0; i < 12; ++i) flow.vectors.emplace_back(0.05 * i, 0.3 - 0.04 * i, 0.01 * i * i);
    cloud.flow = flow;
    const auto seen = [&](glm::dvec3 p, glm::dvec3 by) {
        EXPECT_NEAR(density(cloud, p), density(tower(), p - by), 1e-6);
    };
    const std::vector<glm::dvec3>& w = flow.vectors;
    seen({-1, 0, -1}, w[0]);
    seen({1, 1, -1}, w[3]);
    seen({-1, 2, 1}, w[10]);
    seen({0, 1, -1}, (w[2] + w[3]) / 2.0);
    seen({0, 0.5, 0}, (w[0] + w[1] + w[2] + w[3] + w[6] + w[7] + w[8] + w[9]) / 8.0);
    seen({1.4, -0.7, -1.3}, w[1]);
}

TEST(Warps, TheJetStreamBlowsTheTopAndNotTheBottom) {
    ImplicitCloud cloud = tower();
    cloud.jet = glm::dvec3(1.5, 0, -0.5);  // mean radii, here units
    ASSERT_NEAR(resolved(cloud).mean_radius, 1, 1e-12);
    const double bottom = -1, top = 2.8;  // of the primitives
    all_over({0, 1, 0}, 3, 300, [&](glm::dvec3 p) {
        const double height = std::clamp((p.y - bottom) / (top - bottom), 0.0, 1.0);
        EXPECT_NEAR(density(cloud, p), density(tower(), p - height * *cloud.jet), 1e-5);
    });
}

TEST(Warps, ComeInBetweenTheirTimes) {
    ImplicitCloud cloud = tower();
    cloud.jet = glm::dvec3(1, 0, 0);
    cloud.attractors = {{{0, 1, 0}, 0.5, 2}};
    cloud.warp_from = 10;
    cloud.warp_to = 20;
    cloud.swirl = 0;
    ImplicitCloud full = cloud;
    full.warp_from = full.warp_to = 0;
    ImplicitCloud none = tower();
    none.jet = glm::dvec3(0);
    expect_equal(cloud, none, 3);
    expect_equal(cloud, full, 20);
    expect_equal(cloud, full, 1e6);
    // Halfway smoothstep is a half.
    ImplicitCloud half = full;
    half.jet = glm::dvec3(0.5, 0, 0);
    half.attractors[0].strength = 0.25;
    expect_equal(cloud, half, 15);
}

TEST(Keys, HoldAtTheirTimesAndBeforeAndAfter) {
    ImplicitPrimitive moving = ball({9, 9, 9}, 1);
    moving.keys.resize(3);
    moving.keys[0].time = 1, moving.keys[0].center = glm::dvec3(0), moving.keys[0].weight = 2.0;
    moving.keys[1].time = 3, moving.keys[1].radius = 1.5;
    moving.keys[2].time = 5, moving.keys[2].center = glm::dvec3(2, 0, 0);
    moving.keys[2].radius = 0.5, moving.keys[2].weight = 1.0;
    ImplicitCloud cloud = bare({moving});
    const auto expect = [&](double time, glm::dvec3 center, double radius, double weight) {
        for (const double a : {0.0, 0.3, 0.7, 0.99})
            EXPECT_NEAR(density(cloud, center + glm::dvec3(0, a * radius, 0), time),
                        weight * printed_cubic(a), 2e-5)
                << time << " " << a;
    };
    for (const bool smooth : {false, true}) {
        cloud.linear_keys = !smooth;
        for (const double before : {-1e6, 0.0, 1.0}) expect(before, {0, 0, 0}, 1.5, 2);
        expect(3, {1, 0, 0}, 1.5, 1.5);  // halfway in both; the radius' only key so far
        for (const double after : {5.0, 7.0, 1e6}) expect(after, {2, 0, 0}, 0.5, 1);
    }
    // A quarter of the way, and of the radius' half.
    cloud.linear_keys = true;
    expect(2, {0.5, 0, 0}, 1.5, 1.75);
    expect(4, {1.5, 0, 0}, 1.0, 1.25);
    cloud.linear_keys = false;
    const double eased = 3 * 0.0625 - 2 * 0.015625;
    expect(2, {2 * eased, 0, 0}, 1.5, 2 - eased);
}

// Everything at once, different for every number.
ImplicitCloud busy(int number) {
    ImplicitCloud cloud;
    cloud.preset = static_cast<ImplicitPreset>(number % 5);
    cloud.jet = glm::dvec3(number % 3 - 1, 0.2 * (number % 4), 0.7);
    cloud.jet_turbulence = number % 2;
    cloud.diagonal = number % 3 == 0;
    const double size = 250;
    if (number % 2)
        cloud.attractors = {{{size * 0.3, 0, 0}, 2.0 - number % 4, size},
                            {{-size, 0.2 * size, 0}, 8, size / 2}};
    if (number % 3)
        cloud.vortices = {{{0, 0, size / 4}, {1, 1, 0}, 300, size},
                          {{size / 2, 0, 0}, {0, 1, 0}, -100, size / 3}};
    if (number % 4 == 1)
        cloud.flow = ImplicitFlow{
            {-size, -size, -size}, {size, size, size}, {2, 1, 1}, {{100, -40, 0}, {-60, 90, 10}}};
    return cloud;
}

TEST(Bounds, HoldAllDensityUnderEveryWarp) {
    for (int number = 0; number < 12; ++number) {
        const ImplicitField field = prepare_field(busy(number), 5, 0);
        const Box box = box_of(field);
        const glm::dvec3 middle = (box.min + box.max) / 2.0;
        const double half = glm::length(box.max - box.min);
        int outside = 0, inside = 0;
        all_over(middle, half, 8000, [&](glm::dvec3 p) {
            const double d = density_at(field, p);
            const glm::dvec3 clamped = glm::clamp(p, box.min, box.max);
            inside += d > 0;
            outside += d > 0 && clamped != p;
        });
        EXPECT_EQ(outside, 0) << number;
        EXPECT_GT(inside, 0) << number;
    }
}

TEST(Bounds, ElementsFarFromABlockMakeNoDifference) {
    std::size_t left_out = 0;
    for (int number = 0; number < 12; ++number) {
        const ImplicitField field = prepare_field(busy(number), 5, 0);
        const Box box = box_of(field);
        std::vector<std::uint32_t> all(field.elements.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        all_over({0, 0, 0}, 1, 200, [&](glm::dvec3 unit) {
            const glm::dvec3 first = box.min + (unit * 0.5 + 0.5) * (box.max - box.min);
            const double step = (box.max.x - box.min.x) / 60;
            Box block;
            block.add(first);
            block.add(first + glm::dvec3(7 * step, 0, 0));
            const std::vector<std::uint32_t> near = elements_near(field, block);
            left_out += all.size() - near.size();
            float some[8], every[8];
            row_densities(field, near, {first, step, 8}, some);
            row_densities(field, all, {first, step, 8}, every);
            for (int i = 0; i < 8; ++i) EXPECT_EQ(some[i], every[i]) << number;
        });
    }
    EXPECT_GT(left_out, 1000u);
}

TEST(Displacement, AsPrintedItShiftsTheWholeCloudAndNowItDoesNot) {
    // Centre of mass of a ball under many keys.
    const auto shift = [](bool diagonal) {
        ImplicitCloud cloud = bare({ball({0, 0, 0}, 1)});
        cloud.displacement = 0.7;
        cloud.diagonal = diagonal;
        glm::dvec3 moment(0);
        double mass = 0;
        for (std::uint64_t key = 0; key < 40; ++key) {
            const ImplicitField field = prepare_field(cloud, key, 0);
            all_over({0, 0, 0}, 2, 400, [&](glm::dvec3 p) {
                const double d = density_at(field, p);
                moment += d * p;
                mass += d;
            });
        }
        return moment / mass;
    };
    // Turbulence of six octaves has a mean of .2195 (2 - 1/32) = .43: by .7 times that along (-1, 1, -1), less where it
    // is cut at 1.
    const glm::dvec3 printed = shift(true), ours = shift(false);
    EXPECT_NEAR(printed.x, -0.3, 0.06);
    EXPECT_NEAR(printed.y, 0.3, 0.06);
    EXPECT_NEAR(printed.z, -0.3, 0.06);
    EXPECT_LT(glm::length(ours), 0.06);  // 40 balls, each moved by .2 or so at random
}

}  // namespace
}  // namespace awan
