// The noise of implicit clouds, their vector maths, and the path that moves the noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/implicit/field.h"
#include "core/generate/implicit/noise.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

namespace lanes = implicit::lanes;
using implicit::kMeanAbsNoise;
using implicit::kRmsNoise;
using implicit::noise;
using implicit::noise3;
using implicit::NoiseLattice;
using implicit::Octaves;
using implicit::octaves_of;
using implicit::swirl_path;
using implicit::SwirlPath;
using implicit::turbulence;

using test::all_over;

lanes::Vec everywhere(glm::dvec3 p) {
    const glm::vec3 f(p);
    return {lanes::all(f.x), lanes::all(f.y), lanes::all(f.z)};
}
double noise_at(const NoiseLattice& lattice, glm::dvec3 p) {
    return static_cast<double>(noise(lattice, everywhere(p))[3]);
}
NoiseLattice lattice_of(std::uint64_t key) {
    return octaves_of(key, 1, 1, 0, 0, 0, 0).lattice[0];
}

TEST(Noise, HasItsMeanItsSizeAndItsBound) {
    double sum = 0, absolute = 0, squares = 0, largest = 0;
    int count = 0;
    for (std::uint64_t key = 0; key < 20; ++key)
        all_over({0, 0, 0}, 300, 5000, [&](glm::dvec3 p) {
            const double n = noise_at(lattice_of(key), p);
            sum += n, absolute += std::abs(n), squares += n * n, ++count;
            largest = std::max(largest, std::abs(n));
        });
    // A hundred thousand samples: three standard errors are .0025.
    EXPECT_NEAR(sum / count, 0, 0.003);
    EXPECT_NEAR(absolute / count, kMeanAbsNoise, 0.003);
    EXPECT_NEAR(std::sqrt(squares / count), kRmsNoise, 0.003);
    EXPECT_LE(largest, 1.05);
    EXPECT_GT(largest, 0.8);
}

TEST(Noise, IsContinuousAndZeroAtLatticePoints) {
    NoiseLattice lattice = lattice_of(3);
    lattice.part_x = lattice.part_y = lattice.part_z = 0;
    for (int i = -20; i < 20; ++i) EXPECT_EQ(noise_at(lattice, {i, 3 * i + 1, 7 - i}), 0) << i;
    // The steepest slope is below 4; across cells too.
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 p = -3.0 + 0.0015 * i * glm::dvec3(1, 0.9, 1.1), step(0.0015, 0, 0);
        EXPECT_LT(std::abs(noise_at(lattice, p + step) - noise_at(lattice, p)), 0.0015 * 4 + 1e-6);
    }
}

TEST(Noise, VariesAlikeAlongEveryAxisAndDiagonal) {
    const auto structure =
        [](glm::dvec3 direction) {  // mean square of differences half a cell apart
            double sum = 0;
            int count = 0;
            for (std::uint64_t key = 0; key < 10; ++key)
                all_over({5, 5, 5}, 100, 3000, [&](glm::dvec3 p) {
                    const double d = noise_at(lattice_of(key), p + 0.5 * direction) -
                                     noise_at(lattice_of(key), p);
                    sum += d * d, ++count;
                });
            return sum / count;
        };
    const double x = structure({1, 0, 0}), y = structure({0, 1, 0}), z = structure({0, 0, 1});
    const double diagonal = structure(glm::normalize(glm::dvec3(1, 1, 1)));
    // 30,000 samples with a relative scatter of 2 or so each: 4% is more than three standard errors. A lattice favours
    // its diagonals by some per cent.
    EXPECT_NEAR(y / x, 1, 0.04);
    EXPECT_NEAR(z / x, 1, 0.04);
    EXPECT_NEAR(diagonal / x, 1, 0.15);
}

TEST(Noise, KeysAndComponentsHaveNothingToDoWithEachOther) {
    double keys = 0, xy = 0, yz = 0, squares = 0;
    all_over({0, 0, 0}, 100, 20000, [&](glm::dvec3 p) {
        const double a = noise_at(lattice_of(1), p), b = noise_at(lattice_of(2), p);
        const lanes::Vec v = noise3(lattice_of(1), everywhere(p));
        keys += a * b, squares += a * a;
        xy += static_cast<double>(v.x[0] * v.y[0]), yz += static_cast<double>(v.y[0] * v.z[0]);
    });
    EXPECT_LT(std::abs(keys / squares), 0.03);
    EXPECT_LT(std::abs(xy / squares), 0.03);
    EXPECT_LT(std::abs(yz / squares), 0.03);
}

TEST(Noise, FarOffsetsAreExact) {
    // A lattice moved by whole cells is the same noise elsewhere, and the same again after 2^32 of them.
    NoiseLattice here = lattice_of(9), there = here;
    there.shift_x += 1000, there.shift_z -= 77;
    all_over({0, 0, 0}, 10, 100, [&](glm::dvec3 p) {
        EXPECT_NEAR(noise_at(there, p), noise_at(here, p + glm::dvec3(1000, 0, -77)), 2e-4);
    });
    const Octaves near = octaves_of(4, 6, 0.5, 0, 0, 0, 0),
                  far = octaves_of(4, 6, 0.5, 0, 4294967296.0, -4294967296.0, 0);
    all_over({0, 0, 0}, 10, 100, [&](glm::dvec3 p) {
        // A double keeps a place in a cell to 2^-15 there, in the finest octave.
        EXPECT_NEAR(turbulence(near, everywhere(p))[0], turbulence(far, everywhere(p))[0], 1e-4);
    });
}

TEST(Noise, IsFiniteAnywhere) {
    for (const double far : {1e6, 1e12, 1e30, -1e38}) {
        const lanes::Vec v = noise3(lattice_of(1), everywhere({far, 0.5, -far}));
        EXPECT_TRUE(std::isfinite(v.x[0]) && std::isfinite(v.z[0])) << far;
    }
}

TEST(Turbulence, OctavesTooFineForTheCellsLeaveTheirMean) {
    const Octaves all = octaves_of(4, 8, 0.5, 0, 0, 0, 0);
    const Octaves coarse = octaves_of(4, 8, 0.5, 0.05, 0, 0, 0);  // the fourth is 2.5 cells
    EXPECT_EQ(all.count, 8);
    EXPECT_EQ(all.rest, 0);
    EXPECT_EQ(coarse.count, 4);
    double sum_all = 0, sum_coarse = 0;
    all_over({0, 0, 0}, 100, 20000, [&](glm::dvec3 p) {
        sum_all += static_cast<double>(turbulence(all, everywhere(p))[0]);
        sum_coarse += static_cast<double>(turbulence(coarse, everywhere(p))[0]);
    });
    EXPECT_NEAR(sum_coarse / sum_all, 1, 0.01);
    // 1/f: the mean of the sum is that of a geometric series.
    EXPECT_NEAR(sum_all / 20000, static_cast<double>(kMeanAbsNoise) * (2 - 1.0 / 128), 0.01);
}

TEST(Lanes, TheirFunctionsKeepTheirErrors) {
    for (double x = -40; x < 40; x += 0.0371) {
        const auto f = static_cast<float>(x);
        EXPECT_NEAR(lanes::sin_turns(lanes::all(f))[0],
                    std::sin(2 * std::numbers::pi * static_cast<double>(f)), 6e-6);
        EXPECT_NEAR(lanes::exp2(lanes::all(f))[0] / std::exp2(static_cast<double>(f)), 1, 1e-6);
        const float power = std::exp2(f);
        EXPECT_NEAR(lanes::log2(lanes::all(power))[0], std::log2(static_cast<double>(power)),
                    1e-6 * (1 + std::abs(x)));
        EXPECT_EQ(lanes::floor_int(lanes::all(f))[7], static_cast<int>(std::floor(x)));
    }
}

TEST(SwirlPath, AsPrintedAndAsItIsNow) {
    for (const double frame : {0.0, 1.0, 150.0, 450.0, 1234.0}) {
        const double theta = std::fmod(frame, 600) * 0.01047196;  // as printed
        const SwirlPath printed = swirl_path(frame, true), steady = swirl_path(frame, false);
        EXPECT_NEAR(printed.offset.x, -std::sin(theta) * 0.005 * frame, 1e-3);
        EXPECT_NEAR(printed.offset.y, -0.01215 * frame, 1e-9);
        EXPECT_NEAR(printed.offset.z, std::sin(theta) * 0.0035 * frame, 1e-3);
        EXPECT_NEAR(printed.scale.x, 0.5 + 0.01 * frame, 1e-9);
        EXPECT_NEAR(printed.scale.z, -0.0073 * frame, 1e-9);
        EXPECT_EQ(steady.offset.y, printed.offset.y);
        EXPECT_EQ(steady.scale, glm::dvec3(0.5, 0.5, 0));
        EXPECT_LE(std::abs(steady.offset.x), 0.5);
        EXPECT_LE(std::abs(steady.offset.z), 0.7);
    }
    EXPECT_EQ(swirl_path(0, true).offset, swirl_path(0, false).offset);
}

}  // namespace
}  // namespace awan
