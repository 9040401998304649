// One walk of the light through the cells, against light whose way is known.
#include "core/light/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/plain_sweep.h"

namespace awan {
namespace {

using test::plain_sweep;
using test::uneven;
using test::Uneven;

// Through empty space light goes straight on: radiance that is linear across the rays stays so, and linear weighted
// diamond differences without matter have it exactly. Sides all differ, so that no two axes may be taken for one
// another.
TEST(Sweep, LightFromBelowGoesStraightThroughEmptySpace) {
    const Ordinates ordinates = make_ordinates();
    SweepGrid grid;
    grid.cells = {5, 3, 4};
    grid.depth.assign(5 * 3 * 4, 0.F);
    // Of the ray through p along d: by where it met the plane y = -2.
    const auto radiance = [](const glm::dvec3& d, const glm::dvec3& p) {
        const glm::dvec3 from = p - (p.y + 2) / d.y * d;
        return 10 + 0.3 * from.x - 0.7 * from.z;
    };
    std::vector<float> source(16 * grid.size()), moments(16 * grid.size());
    SweepSpace space;
    sweep(grid, ordinates, {source}, {}, 2, space, {moments}, radiance);
    std::size_t cell = 0;
    for (int k = 0; k < grid.cells.z; ++k)
        for (int j = 0; j < grid.cells.y; ++j)
            for (int i = 0; i < grid.cells.x; ++i, ++cell)
                for (std::size_t m = 0; m < 16; ++m) {
                    double expected = 0;
                    for (const Ordinates::Octant& octant : ordinates.octants)
                        for (std::size_t d = 0; d < kDirections && octant.sign.y > 0; ++d)
                            expected += static_cast<double>(octant.weighted[d][m]) *
                                        radiance(octant.direction[d], glm::dvec3(i, j, k) + 0.5);
                    EXPECT_NEAR(moments[16 * cell + m], expected, 2e-4)
                        << i << ' ' << j << ' ' << k << ' ' << m;
                }
}

// Without matter the light of every direction is in every cell; its mean is the inflow's.
TEST(Sweep, LightOfEveryDirectionReachesEveryCell) {
    const Ordinates ordinates = make_ordinates();
    SweepGrid grid;
    grid.cells = {4, 5, 3};
    grid.depth.assign(4 * 5 * 3, 0.F);
    const auto radiance = [](const glm::dvec3& d) {
        return 1 + 0.5 * d.x + 0.25 * d.y - 0.125 * d.z;
    };
    std::vector<float> source(16 * grid.size()), moments(16 * grid.size());
    SweepSpace space;
    sweep(grid, ordinates, {source}, radiance, 1, space, {moments});
    const double y0 = std::sqrt(4 * 3.14159265358979), y1 = std::sqrt(4 * 3.14159265358979 / 3);
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
        EXPECT_NEAR(moments[16 * cell], y0, 1e-5);
        // Harmonics 1, 2 and 3 of harmonics.h go with x, y and z.
        EXPECT_NEAR(moments[16 * cell + 1], 0.5 * y1, 1e-5);
        EXPECT_NEAR(moments[16 * cell + 2], 0.25 * y1, 1e-5);
        EXPECT_NEAR(moments[16 * cell + 3], -0.125 * y1, 1e-5);
    }
}

// The mirrored scene has the mirrored light, and the scene with x and z exchanged has it exchanged: azimuths are even.
TEST(Sweep, MirroredScenesHaveMirroredLight) {
    const Ordinates ordinates = make_ordinates();
    const glm::ivec3 cells(6, 5, 4);
    struct Seen {
        glm::ivec3 cells;
        std::vector<float> mean;
        float at(const glm::ivec3& c) const {
            return mean[static_cast<std::size_t>((c.z * cells.y + c.y) * cells.x + c.x)];
        }
    };
    // Matter and its light at (x, y, z) are those of the plain scene at from(x, y, z).
    const auto seen = [&](const glm::ivec3& size, const auto& from) {
        SweepGrid grid;
        grid.cells = size;
        grid.harmonics = 1;
        std::vector<float> source;
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) {
                    const glm::ivec3 c = from(glm::ivec3(i, j, k));
                    const auto kind = static_cast<float>((c.x * 7 + c.y * 5 + c.z * 3) % 11);
                    grid.depth.push_back(0.3F * kind);
                    source.push_back(0.2F * static_cast<float>((c.x + 2 * c.y * c.z) % 5));
                }
        std::vector<float> moments(grid.size());
        SweepSpace space;
        sweep(grid, ordinates, {source}, [](const glm::dvec3&) { return 0.5; }, 1, space,
              {moments});
        return Seen{size, moments};
    };
    const Seen plain = seen(cells, [](const glm::ivec3& c) { return c; });
    const auto expect_plain_at = [&](const Seen& other, const auto& from) {
        for (int k = 0; k < other.cells.z; ++k)
            for (int j = 0; j < other.cells.y; ++j)
                for (int i = 0; i < other.cells.x; ++i)
                    EXPECT_NEAR(other.at({i, j, k}), plain.at(from(glm::ivec3(i, j, k))), 1e-5F);
    };
    for (int axis = 0; axis < 3; ++axis) {
        const auto mirrored = [&](glm::ivec3 c) {
            c[axis] = cells[axis] - 1 - c[axis];
            return c;
        };
        expect_plain_at(seen(cells, mirrored), mirrored);
    }
    const auto exchanged = [](const glm::ivec3& c) { return glm::ivec3(c.z, c.y, c.x); };
    expect_plain_at(seen(exchanged(cells), exchanged), exchanged);
}

// Along any direction a uniform medium takes exp(-tau). The corner between two faces, where the light of one way ends
// and that of another begins, is a kink that cells blur: 2% of the light, within a cell's depth.
TEST(Sweep, ThinMatterTakesItsShareOfTheLight) {
    const Ordinates ordinates = make_ordinates();
    SweepGrid grid;
    grid.cells = {12, 12, 12};
    grid.depth.assign(12 * 12 * 12, 0.05F);
    grid.harmonics = 1;
    // One direction alone, upward; it enters by three faces.
    const glm::dvec3 only = ordinates.octants[0].direction[5];
    std::vector<float> source(grid.size()), moments(grid.size());
    SweepSpace space;
    sweep(grid, ordinates, {source}, [&](const glm::dvec3& d) { return d == only ? 1.0 : 0.0; }, 1,
          space, {moments});
    const auto weight = static_cast<double>(ordinates.octants[0].weighted[5][0]);
    std::size_t cell = 0;
    for (int k = 0; k < 12; ++k)
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i, ++cell) {
                double way = 1e9;
                const glm::dvec3 p = glm::dvec3(i, j, k) + 0.5;
                for (int axis = 0; axis < 3; ++axis)
                    way = std::min(
                        way, (only[axis] > 0 ? p[axis] : 12 - p[axis]) / std::abs(only[axis]));
                EXPECT_NEAR(moments[cell] / weight, std::exp(-0.05 * way), 0.025);
            }
}

TEST(Sweep, IsThePlainSweep) {
    const Ordinates ordinates = make_ordinates();
    const auto radiance = [](const glm::dvec3& d) {
        return 1 + 0.5 * d.x + 0.25 * d.y - 0.3 * d.z;
    };
    for (const int harmonics : {1, 16})
        for (const bool skip_empty : {false, true})
            for (const glm::ivec3& cells :
                 {glm::ivec3(5, 4, 3), glm::ivec3(7, 2, 6), glm::ivec3(1, 1, 1)}) {
                Uneven scene = uneven(cells, harmonics);
                scene.grid.skip_empty = skip_empty;
                SweepSource source{scene.source, scene.scale, scene.even};
                for (std::size_t m = 0; m < 16; ++m)
                    source.weight[m] = 1 - 0.05F * static_cast<float>(m);
                const std::vector<double> plain = plain_sweep(scene, source, ordinates, radiance);
                std::vector<float> moments(plain.size()), from(plain.size()),
                    addition(scene.grid.size());
                SweepSpace space;
                sweep(scene.grid, ordinates, source, radiance, 1, space, {moments});
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_NEAR(moments[i], plain[i], 2e-5)
                        << harmonics << ' ' << skip_empty << ' ' << i;
                // The same, taken away from something.
                for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<float>(i % 13);
                for (std::size_t i = 0; i < addition.size(); ++i)
                    addition[i] = static_cast<float>(i % 3);
                std::vector<float> rest(plain.size());
                sweep(scene.grid, ordinates, source, radiance, 1, space, {rest, from, addition});
                const auto count = static_cast<std::size_t>(harmonics);
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_EQ(rest[i],
                              from[i] + (i % count == 0 ? addition[i / count] : 0.F) - moments[i]);
            }
}

// Threads go through a layer's cells and octants together; none of it shows.
TEST(Sweep, TheSameBytesForEveryNumberOfThreads) {
    const Ordinates ordinates = make_ordinates();
    for (const glm::ivec3& cells : {glm::ivec3(33, 31, 5), glm::ivec3(9, 8, 4)})
        for (const int harmonics : {1, 16}) {
            const Uneven scene = uneven(cells, harmonics);
            const SweepSource source{scene.source, scene.scale, scene.even};
            std::vector<float> one(scene.source.size()), many(one.size());
            SweepSpace space;
            sweep(scene.grid, ordinates, source, {}, 1, space, {one, scene.source});
            for (const int threads : {2, 3, 5, 7, 16}) {
                std::fill(many.begin(), many.end(), -1.F);
                sweep(scene.grid, ordinates, source, {}, threads, space, {many, scene.source});
                EXPECT_EQ(one, many) << threads;
            }
        }
}

}  // namespace
}  // namespace awan
