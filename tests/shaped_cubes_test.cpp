// Cubes filled in the shapes of clouds: within the cube, keyed, flat below, round above.
#include "core/generate/shaped_cubes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace awan {
namespace {

std::vector<FilledParticle> filled(const Cube& cube, Fill fill, std::uint64_t key,
                                   std::uint64_t count) {
    std::vector<FilledParticle> particles(count);
    fill_cube(cube, fill, key, 0, count, particles.data());
    return particles;
}

Cube cube_of(const glm::dvec3& size, double radius) {
    Cube cube;
    cube.size = size;
    cube.center = {5, -3, 2};
    cube.radius = radius;
    return cube;
}

const glm::dvec3 kSizes[] = {{1, 1, 1},  {7.4, 2, 4},    {100, 1, 100},
                             {1, 30, 2}, {1e-6, 1e6, 1}, {1e9, 1e-9, 1e9}};

TEST(ShapedCubes, StayInTheCube) {
    for (const Fill fill : {Fill::kCumulus, Fill::kStratus})
        for (const glm::dvec3& size : kSizes)
            for (const double radius : {1e-3, 1.0, 1e4}) {
                const Cube cube = cube_of(size, radius);
                for (const FilledParticle& p : filled(cube, fill, 42, 3000)) {
                    const glm::dvec3 d = p.center - cube.center;
                    for (int axis = 0; axis < 3; ++axis) {
                        ASSERT_TRUE(std::isfinite(d[axis]));
                        // What the cube's own centre rounds to, far from small sides.
                        ASSERT_LE(std::abs(d[axis]), size[axis] / 2 * (1 + 1e-12) + 1e-14);
                    }
                    ASSERT_GT(p.radius, 0);
                    ASSERT_LE(p.radius, radius);
                }
            }
}

TEST(ShapedCubes, AParticleDependsOnNoOther) {
    const Cube cube = cube_of({7.4, 2, 4}, 0.8);
    for (const Fill fill : {Fill::kCumulus, Fill::kStratus}) {
        const auto all = filled(cube, fill, 9, 500);
        std::vector<FilledParticle> part(100);
        fill_cube(cube, fill, 9, 300, 400, part.data());
        for (std::size_t i = 0; i < part.size(); ++i) {
            EXPECT_EQ(part[i].center, all[300 + i].center);
            EXPECT_EQ(part[i].radius, all[300 + i].radius);
        }
        EXPECT_NE(filled(cube, fill, 10, 1)[0].center, all[0].center);
    }
}

TEST(ShapedCubes, ACumulusIsFlatBelowAndRoundAbove) {
    const Cube cube = cube_of({8, 3, 6}, 0.5);
    for (const std::uint64_t key : {1, 2, 3, 4, 5}) {
        const auto particles = filled(cube, Fill::kCumulus, key, 20000);
        double top = -9, corner = 9, lowest = 9;
        double high = 0, wide_low = 0, wide_high = 0;
        for (const FilledParticle& p : particles) {
            const glm::dvec3 d = (p.center - cube.center) / cube.size + glm::dvec3(0, 0.5, 0);
            top = std::max(top, d.y);
            lowest = std::min(lowest, d.y * cube.size.y - p.radius / 2);
            // Nothing stands in the four upright edges.
            if (std::abs(d.x) > 0.42 && std::abs(d.z) > 0.42) corner = std::min(corner, d.y);
            const double out = std::hypot(d.x, d.z);
            (d.y < 0.3 ? wide_low : wide_high) =
                std::max(d.y < 0.3 ? wide_low : wide_high, d.y < 0.3 || d.y > 0.7 ? out : 0);
            high += d.y / 20000;
        }
        EXPECT_GT(top, 0.75);
        EXPECT_EQ(corner, 9);
        // The lower sides of particles are level with the base.
        EXPECT_GE(lowest, -1e-9);
        EXPECT_LT(lowest, 0.01);
        EXPECT_GT(wide_low, 0.45);
        EXPECT_LT(wide_high, wide_low - 0.05);
        // More below than above.
        EXPECT_LT(high, 0.45);
    }
}

TEST(ShapedCubes, CloudsOfOtherKeysHaveOtherDomes) {
    const Cube cube = cube_of({8, 3, 6}, 0.5);
    // The highest matter over each of 4 x 4 fields of the base.
    const auto heights = [&](std::uint64_t key) {
        std::vector<double> most(16, 0);
        for (const FilledParticle& p : filled(cube, Fill::kCumulus, key, 20000)) {
            const glm::dvec3 d = (p.center - cube.center) / cube.size + 0.5;
            const auto i = static_cast<std::size_t>(std::min(3.0, std::floor(4 * d.x)) +
                                                    4 * std::min(3.0, std::floor(4 * d.z)));
            most[i] = std::max(most[i], d.y);
        }
        return most;
    };
    const auto a = heights(1), b = heights(2);
    double apart = 0;
    for (std::size_t i = 0; i < 16; ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
    EXPECT_GT(apart, 0.1);
}

TEST(ShapedCubes, AStratusHasRoundCornersAndAThinRim) {
    const Cube cube = cube_of({20, 2, 20}, 0.5);
    double thick_middle = 0, thick_rim = 0;
    for (const FilledParticle& p : filled(cube, Fill::kStratus, 3, 20000)) {
        const glm::dvec3 d = (p.center - cube.center) / cube.size;
        EXPECT_FALSE(std::abs(d.x) > 0.46 && std::abs(d.z) > 0.46);
        const double rim = std::max(std::abs(d.x), std::abs(d.z));
        if (rim < 0.2) thick_middle = std::max(thick_middle, std::abs(d.y));
        if (rim > 0.49) thick_rim = std::max(thick_rim, std::abs(d.y));
    }
    EXPECT_GT(thick_middle, 0.45);
    EXPECT_LT(thick_rim, 0.2);
}

}  // namespace
}  // namespace awan
