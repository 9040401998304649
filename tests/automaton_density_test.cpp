// From an automaton's bits to Gaussians: smoothing, metaballs, blocks, interpolation (core/generate/automaton).
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/generate/automaton/cells_to_particles.h"
#include "core/generate/automaton/metaball.h"
#include "core/generate/automaton/run.h"
#include "core/generate/automaton/smooth.h"
#include "core/generate/generate.h"
#include "core/generate/keyed_random.h"
#include "tests/gaussian_sums.h"
#include "tests/random_models_automaton.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using automaton::AutomatonGrid;
using automaton::CellDensity;
using automaton::cells_to_particles;
using automaton::CloudBits;
using automaton::kMetaballIntegral;
using automaton::kMetaballVariance;
using automaton::metaball;
using automaton::PlaneSmoother;

std::vector<std::uint64_t> random_sky(const AutomatonGrid& grid, std::uint64_t key, bool sparse) {
    std::vector<std::uint64_t> sky(grid.all_words());
    for (std::size_t w = 0; w < sky.size(); ++w) {
        sky[w] = keyed(key, w) & keyed(key + 1, w);
        if (sparse && keyed(key + 2, w / grid.words) % 3 != 0) sky[w] = 0;
        if (w % grid.words == grid.words - 1) sky[w] &= grid.last_mask();
    }
    return sky;
}

int bit(const AutomatonGrid& grid, const std::vector<std::uint64_t>& sky, int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= static_cast<int>(grid.nx) ||
        j >= static_cast<int>(grid.ny) || k >= static_cast<int>(grid.nz))
        return 0;
    const std::size_t row = grid.row(static_cast<std::size_t>(j), static_cast<std::size_t>(k));
    return static_cast<int>(sky[row * grid.words + static_cast<std::size_t>(i) / 64] >> (i % 64) &
                            1);
}

TEST(AutomatonSmoothing, IsTheDirectSum) {
    constexpr double kSizes[][3] = {{1, 1, 1}, {70, 5, 9}, {64, 3, 2}, {129, 2, 6}};
    constexpr std::size_t kReaches[][3] = {{0, 0, 0}, {1, 1, 1}, {2, 0, 1}, {4, 4, 4}, {0, 3, 2}};
    for (const auto& size : kSizes)
        for (const auto& reach : kReaches)
            for (const std::size_t steps : {1u, 3u, 8u}) {
                const AutomatonGrid grid(glm::dvec3(size[0], size[1], size[2]));
                std::vector<std::vector<std::uint64_t>> skies;
                std::vector<CloudBits> fields;
                for (std::size_t n = 0; n < steps; ++n)
                    skies.push_back(random_sky(grid, 10 * n + 1, n % 2 == 1));
                for (const auto& sky : skies) fields.push_back(&sky);
                PlaneSmoother smoother(grid, fields, {reach[0], reach[1], reach[2]});
                const int ri = static_cast<int>(reach[0]), rj = static_cast<int>(reach[1]);
                const int rk = static_cast<int>(reach[2]);
                EXPECT_EQ(smoother.most(),
                          (2 * ri + 1) * (2 * rj + 1) * (2 * rk + 1) * static_cast<double>(steps));
                int differ = 0;
                for (std::size_t k = 0; k < grid.nz; ++k) {
                    const auto plane = smoother.plane(k);
                    for (std::size_t j = 0; j < grid.ny; ++j)
                        for (std::size_t i = 0; i < grid.nx; ++i) {
                            int sum = 0;
                            for (const auto& sky : skies)
                                for (int c = -rk; c <= rk; ++c)
                                    for (int b = -rj; b <= rj; ++b)
                                        for (int a = -ri; a <= ri; ++a)
                                            sum += bit(grid, sky, static_cast<int>(i) + a,
                                                       static_cast<int>(j) + b,
                                                       static_cast<int>(k) + c);
                            const int got =
                                plane.rows[j] != 0 ? plane.counts[j * plane.stride + i] : 0;
                            differ += got != sum;
                        }
                }
                EXPECT_EQ(differ, 0) << size[0] << " wide, reach " << ri << rj << rk;
            }
}

TEST(AutomatonMetaball, HasTheIntegralOf736Over2835PiAndNotThePrintedOne) {
    // Gauss would be exact; the midpoint rule of 10,000 is good to 1e-8.
    double volume = 0, square = 0;
    constexpr int kCount = 10000;
    for (int n = 0; n < kCount; ++n) {
        const double a = (n + 0.5) / kCount;
        volume += 4 * std::numbers::pi * a * a * metaball(a) / kCount;
        square += 4 * std::numbers::pi * a * a * a * a * metaball(a) / kCount;
    }
    EXPECT_NEAR(volume, kMetaballIntegral, 1e-7);
    EXPECT_NEAR(volume, 736.0 / 2835 * std::numbers::pi, 1e-7);
    // As Upchurch 2009 has it, at R = 1.
    EXPECT_GT(748.0 / 405 * std::numbers::pi / volume, 7);
    EXPECT_NEAR(square / volume, 3 * kMetaballVariance, 1e-7);
    EXPECT_EQ(metaball(0), 1);
    EXPECT_NEAR(metaball(0.5), 0.5, 1e-12);  // Wyvill's: a half at the half
    EXPECT_NEAR(metaball(1 - 1e-9), 0, 1e-8);
    EXPECT_EQ(metaball(1.1), 0);
}

double mass(const ReadyParticles& particles) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.positions.size(); ++i) {
        const double s = static_cast<double>(particles.radii[i]) / 2;
        sum += static_cast<double>(particles.densities[i]) * std::pow(2 * std::numbers::pi, 1.5) *
               s * s * s;
    }
    return sum;
}

struct Sky {
    explicit Sky(const AutomatonCloud& cloud, std::uint64_t key)
        : grid(cloud.cells), bits(random_sky(grid, key, false)) {
        density.now = {&bits};
    }
    AutomatonGrid grid;
    std::vector<std::uint64_t> bits;
    CellDensity density;
};

AutomatonCloud small() {
    AutomatonCloud cloud;
    cloud.cells = {24, 12, 20};
    cloud.cell = 2;
    return cloud;
}

TEST(AutomatonParticles, AFullSkyHasDensityOneInItsMiddle) {
    AutomatonCloud cloud = small();
    Sky sky(cloud, 1);
    for (std::size_t w = 0; w < sky.bits.size(); ++w) sky.bits[w] = sky.grid.last_mask();
    const auto made = cells_to_particles(cloud, sky.density, 1u << 20, 1, {});
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->particles.positions.size(), 24u * 12 * 20);
    EXPECT_EQ(made->error, 0);
    // A lattice of Gaussians of s = .645 h: 6 exp(-2 pi^2 s^2/h^2) = .0016 of ripple, and float32.
    for (const glm::dvec3 p :
         {glm::dvec3(0, 12, 0), glm::dvec3(1, 13, 1), glm::dvec3(0.5, 12.3, -1)})
        EXPECT_NEAR(test::extinction_at(made->particles, p), 1, 0.002);
    // The grid stands on y = 0, its middle at x = z = 0.
    EXPECT_EQ(made->particles.positions.front(), glm::dvec3(-23, 1, -19));
    EXPECT_EQ(made->particles.positions.back(), glm::dvec3(23, 23, 19));
}

TEST(AutomatonParticles, MassIsThatOfTheBitsHoweverTheyAreSmoothedOrMerged) {
    AutomatonCloud cloud = small();
    Sky sky(cloud, 7);
    // Nothing within two cells of the border: no smoothing loses any.
    double count = 0;
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 12; ++j) {
            std::uint64_t& row =
                sky.bits[sky.grid.row(static_cast<std::size_t>(j), static_cast<std::size_t>(k))];
            if (k < 2 || k >= 18 || j < 2 || j >= 10) row = 0;
            row &= 0x3ffffcu;
            count += std::popcount(row);
        }
    ASSERT_GT(count, 200);
    for (const double reach : {0.0, 1.0, 2.0})
        for (const double metaball_radius : {1.5, 2.0, 5.0}) {
            cloud.smooth = glm::dvec3(reach);
            cloud.metaball_radius = metaball_radius;
            glm::dvec3 middle(0);
            for (const std::uint64_t most : {100000, 700, 100, 20, 1}) {
                const auto made = cells_to_particles(cloud, sky.density, most, 1, {});
                ASSERT_TRUE(made.ok());
                const ReadyParticles& particles = made->particles;
                EXPECT_LE(particles.positions.size(), most);
                EXPECT_EQ(made->error > 0, made->block > 1);
                // Eight units^3 a cell; radii and densities are float32.
                EXPECT_NEAR(mass(particles), count * 8, count * 8 * 1e-5);
                glm::dvec3 now(0);
                double variance = 0;
                for (std::size_t i = 0; i < particles.positions.size(); ++i) {
                    const double s = static_cast<double>(particles.radii[i]) / 2;
                    const double own = static_cast<double>(particles.densities[i]) * s * s * s *
                                       std::pow(2 * std::numbers::pi, 1.5) / (count * 8);
                    now += own * particles.positions[i];
                    variance += own * (3 * s * s +
                                       glm::dot(particles.positions[i], particles.positions[i]));
                }
                static double first_variance;
                if (most == 100000) middle = now, first_variance = variance;
                EXPECT_NEAR(glm::distance(now, middle), 0, 1e-4);
                // The second moment's trace stays as well: a block's Gaussian is as wide as what it stands for.
                EXPECT_NEAR(variance, first_variance, 1e-4 * first_variance);
            }
        }
}

TEST(AutomatonParticles, BetweenStepsDensityIsTheMean) {
    AutomatonCloud cloud = small();
    Sky now(cloud, 3), next(cloud, 4);
    CellDensity density = now.density;
    density.next = {&next.bits};
    const auto a = cells_to_particles(cloud, now.density, 1u << 20, 1, {});
    const auto b = cells_to_particles(cloud, next.density, 1u << 20, 1, {});
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        density.share_of_next = share;
        const auto mixed = cells_to_particles(cloud, density, 1u << 20, 1, {});
        for (const glm::dvec3 p :
             {glm::dvec3(0, 12, 0), glm::dvec3(5, 8, -7), glm::dvec3(-20, 2, 3)})
            EXPECT_NEAR(test::extinction_at(mixed->particles, p),
                        (1 - share) * test::extinction_at(a->particles, p) +
                            share * test::extinction_at(b->particles, p),
                        1e-5);  // float32
    }
}

TEST(AutomatonParticles, TheThresholdLeavesOutThinCells) {
    AutomatonCloud cloud = small();
    Sky sky(cloud, 3);
    const auto all = cells_to_particles(cloud, sky.density, 1u << 20, 1, {});
    cloud.threshold = 0.3;
    const auto some = cells_to_particles(cloud, sky.density, 1u << 20, 1, {});
    EXPECT_LT(some->particles.positions.size(), all->particles.positions.size());
    EXPECT_GT(some->particles.positions.size(), 0u);
    cloud.threshold = 1;
    EXPECT_TRUE(
        cells_to_particles(cloud, sky.density, 1u << 20, 1, {})->particles.positions.empty());
}

// --- through generate()

SceneDraft scene_of(const AutomatonCloud& automaton, double time = 0) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud cloud;
    cloud.model = CloudModel::kAutomaton;
    cloud.automaton = std::make_shared<const AutomatonCloud>(automaton);
    draft.clouds.push_back(cloud);
    draft.time = time;
    return draft;
}

ParticleSet particles_of(const SceneDraft& draft, int threads = 1, bool coarse = false) {
    auto set = generate(test::valid(draft), threads, {}, coarse);
    if (!set.ok()) {
        ADD_FAILURE() << set.error().pointer << ": " << set.error().message;
        return {};
    }
    return *std::move(set);
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

bool same(const ParticleSet& a, const ParticleSet& b) {
    return same_bytes(a.center, b.center) && same_bytes(a.radius, b.radius) &&
           same_bytes(a.density, b.density);
}

TEST(AutomatonCloudTest, TheDefaultIsACloudAndTheSameForAllThreads) {
    const SceneDraft draft = scene_of({});
    const ParticleSet one = particles_of(draft);
    EXPECT_GT(one.size(), 10000u);
    EXPECT_LT(one.size(), 200000u);
    EXPECT_TRUE(same(one, particles_of(draft, 2)));
    EXPECT_TRUE(same(one, particles_of(draft, 7)));
    SceneDraft other = draft;
    other.seed = 2;
    EXPECT_FALSE(same(one, particles_of(other)));
}

TEST(AutomatonCloudTest, TimeIsStepsWithinTheirEnds) {
    AutomatonCloud cloud = small();
    cloud.warm_up = 6;
    cloud.steps = 10;
    cloud.steps_per_second = 2;
    const auto at = [&](double time) { return particles_of(scene_of(cloud, time)); };
    EXPECT_EQ(at(-3).size(), 0u);  // step 0: a clear sky
    EXPECT_EQ(at(-1e6).size(), 0u);
    EXPECT_FALSE(same(at(0), at(0.5)));
    EXPECT_FALSE(same(at(0.5), at(0.75)));
    EXPECT_TRUE(same(at(2), at(5)));
    EXPECT_TRUE(same(at(2), at(1e6)));
    const ParticleSet later = at(1);
    cloud.warm_up = 8;
    EXPECT_TRUE(same(at(0), later));
}

TEST(AutomatonCloudTest, ACoarseOneIsFastAndLiesWhereTheCloudDoes) {
    AutomatonCloud cloud;
    cloud.cells = {512, 32, 512};  // too much to be grown for its bounds
    cloud.random = RandomEllipsoids{};
    cloud.random->count = 80;
    const ParticleSet fine = particles_of(scene_of(cloud), 2),
                      coarse = particles_of(scene_of(cloud), 1, true);
    EXPECT_LE(coarse.size(), 80u * 7);
    const Bounds a = bounds_of(fine), b = bounds_of(coarse);
    for (int axis = 0; axis < 3; ++axis) {
        // A few cells beside 512: what ellipsoids' edges hold is thin.
        const double allowed = 8 * cloud.cell;
        EXPECT_NEAR(a.min[axis], b.min[axis], allowed);
        EXPECT_NEAR(a.max[axis], b.max[axis], allowed);
    }
    const AutomatonCloud small_one;  // is grown
    const Bounds c = bounds_of(particles_of(scene_of(small_one)));
    const ParticleSet quick = particles_of(scene_of(small_one), 1, true);
    EXPECT_LE(quick.size(), 400u);
    const Bounds d = bounds_of(quick);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(c.min[axis], d.min[axis], 8 * small_one.cell);
        EXPECT_NEAR(c.max[axis], d.max[axis], 8 * small_one.cell);
    }
}

TEST(AutomatonCloudTest, RandomOnesAreFiniteBoundedAndDeterministic) {
    std::size_t clouds_with_matter = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        test::Dice dice(seed);
        SceneDraft draft;
        draft.top_level_cubes = false;
        test::Whereabouts where;
        where.size = dice.log_between(0.1, 100);
        where.middle = where.size * dice.any_vector(10);
        draft.clouds.push_back(test::random_automaton(dice, where));
        draft.time = dice.chance(0.3) ? 0 : dice.any(limits::kMaxTime);
        const AutomatonCloud& cloud = *draft.clouds[0].automaton;
        const ParticleSet one = particles_of(draft, 1), two = particles_of(draft, 2);
        EXPECT_TRUE(same(one, two)) << seed;
        EXPECT_LE(one.size(), most_particles(cloud)) << seed;
        clouds_with_matter += one.size() > 0;
        const double reach = cloud.cell * glm::length(cloud.cells) * 1.001;
        for (std::size_t i = 0; i < one.size(); ++i) {
            ASSERT_LE(glm::distance(one.center[i], draft.clouds[0].translate), reach) << seed;
            ASSERT_GE(one.radius[i], static_cast<float>(limits::kMinRadius)) << seed;
            ASSERT_LE(one.radius[i], static_cast<float>(limits::kMaxRadius)) << seed;
            ASSERT_TRUE(std::isfinite(one.density[i]) && one.density[i] >= 0) << seed;
        }
        const ParticleSet coarse = particles_of(draft, 1, true);
        for (std::size_t i = 0; i < coarse.size(); ++i)
            ASSERT_TRUE(std::isfinite(coarse.radius[i]) && std::isfinite(coarse.center[i].x))
                << seed;
    }
    EXPECT_GT(clouds_with_matter, 150u);
}

}  // namespace
}  // namespace awan
