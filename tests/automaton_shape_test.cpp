// How an automaton's probabilities fall off in its ellipsoids, and how cells count in smoothing.
#include <gtest/gtest.h>

#include <cmath>

#include "core/generate/automaton/cells_to_particles.h"
#include "core/generate/automaton/shape.h"
#include "core/generate/keyed_random.h"
#include "tests/automaton_compare.h"

namespace awan {
namespace {

using automaton::AutomatonGrid;
using automaton::CloudBits;
using automaton::DensityPlanes;
using automaton::fall_off_at;
using automaton::fall_off_digits;
using automaton::WeightedSmoother;
using test::busy;
using test::compare;

TEST(AutomatonFallOff, HasItsFormulas) {
    for (const double u : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        EXPECT_DOUBLE_EQ(fall_off_at(AutomatonShape::kLinear, {}, u), 1 - u);
        EXPECT_DOUBLE_EQ(fall_off_at(AutomatonShape::kQuadratic, {}, u), 1 - u * u);
        EXPECT_NEAR(fall_off_at(AutomatonShape::kSmooth, {}, u), 1 - 3 * u * u + 2 * u * u * u,
                    1e-15);
    }
    const std::vector<float> table = {1, 0.5F, 0.75F};
    EXPECT_EQ(fall_off_at(AutomatonShape::kTable, table, 0), 1);
    EXPECT_EQ(fall_off_at(AutomatonShape::kTable, table, 0.25), 0.75);
    EXPECT_EQ(fall_off_at(AutomatonShape::kTable, table, 0.5), 0.5);
    EXPECT_EQ(fall_off_at(AutomatonShape::kTable, table, 0.75), 0.625);
    EXPECT_EQ(fall_off_at(AutomatonShape::kTable, table, 1), 0.75);
}

TEST(AutomatonFallOff, IsThePlainAutomatonOfEveryShape) {
    std::uint64_t clouds[4] = {};
    for (int shape = 0; shape < 4; ++shape)
        for (const AutomatonOverlap overlap :
             {AutomatonOverlap::kDeepest, AutomatonOverlap::kFirst}) {
            AutomatonCloud cloud = busy(130, 6, 9);
            cloud.fall_off = static_cast<AutomatonShape>(shape);
            if (cloud.fall_off == AutomatonShape::kTable) cloud.fall_off_table = {0.2F, 1, 0, 0};
            cloud.overlap = overlap;
            cloud.wind.ellipsoids = {{0, 9, {0.9, 0, 0}}};
            clouds[shape] += compare(cloud, 3, 6, "shape " + std::to_string(shape));
        }
    // 1 - d <= 1 - d^2: more vapour, and less that vanishes.
    EXPECT_GT(clouds[1], clouds[0]);
    EXPECT_GT(clouds[3], 0u);
}

TEST(AutomatonFallOff, ATableOfTheLinearOneIsTheLinearOne) {
    AutomatonCloud cloud = busy(100, 8, 20);
    AutomatonCloud other = cloud;
    other.fall_off = AutomatonShape::kTable;
    other.fall_off_table = {1, 0};
    const auto digits = fall_off_digits(other);
    ASSERT_EQ(digits.size(), 65536u);
    for (std::size_t n = 0; n < digits.size(); ++n) ASSERT_EQ(digits[n], n);
    automaton::AutomatonScratch a, b;
    EXPECT_EQ(automaton::run_automaton(cloud, 2, 8, 1, {}, a)->cld,
              automaton::run_automaton(other, 2, 8, 1, {}, b)->cld);
}

// In the long run a cell at distance d gets vapour with probability `humidity` F(d) a step: counted over many steps of
// an automaton in which vapour is never used up nor kept.
TEST(AutomatonFallOff, ProbabilitiesAreThePrintedOnes) {
    AutomatonCloud cloud;
    cloud.cells = {64, 64, 64};
    cloud.ellipsoids = {{{32, 32, 32}, {30, 30, 30}}};
    cloud.base = 0;
    cloud.humidity = 0.4;
    cloud.activation = 0;
    cloud.fall_off = AutomatonShape::kSmooth;
    const AutomatonGrid grid(cloud.cells);
    double got[10] = {}, wanted[10] = {}, cells[10] = {};
    for (std::uint64_t key = 1; key <= 8; ++key) {
        automaton::AutomatonScratch scratch;
        const auto state = automaton::first_state(cloud, key, 1, {}, scratch);
        for (std::size_t k = 0; k < 64; ++k)
            for (std::size_t j = 0; j < 64; ++j)
                for (std::size_t i = 0; i < 64; ++i) {
                    const double x = static_cast<double>(i) - 31.5,
                                 y = static_cast<double>(j) - 31.5,
                                 z = static_cast<double>(k) - 31.5;
                    const double d = std::sqrt(x * x + y * y + z * z) / 30;
                    if (!(d < 1)) continue;
                    const auto shell = static_cast<std::size_t>(10 * d);
                    got[shell] += static_cast<double>(state->hum[grid.row(j, k)] >> i & 1);
                    wanted[shell] += 0.4 * (1 - 3 * d * d + 2 * d * d * d);
                    cells[shell] += 1;
                }
    }
    for (std::size_t shell = 0; shell < 10; ++shell)
        // Five standard deviations of a binomial.
        EXPECT_NEAR(got[shell], wanted[shell],
                    5 * std::sqrt(wanted[shell] * (1 - wanted[shell] / cells[shell])) + 1)
            << shell;
}

// --- weights

std::vector<std::uint64_t> random_sky(const AutomatonGrid& grid, std::uint64_t key) {
    std::vector<std::uint64_t> sky(grid.all_words());
    for (std::size_t w = 0; w < sky.size(); ++w) {
        sky[w] = keyed(key, w) & keyed(key + 1, w);
        if (w / grid.words % 5 == 0) sky[w] = 0;
        if (w % grid.words == grid.words - 1) sky[w] &= grid.last_mask();
    }
    return sky;
}

// q of Upchurch 2009 as it is printed, with w scaled so that a full sky has density 1: the factor before the sum is 1 /
// ((2i+1)(2j+1)(2k+1)), which is one over the sum of the weights where those are 1.
double printed_density(const AutomatonCloud& cloud, const AutomatonGrid& grid,
                       const std::vector<std::uint64_t>& sky, int x, int y, int z) {
    const auto weight = [&](int n, double reach) {
        const double u = std::abs(n) / (reach + 1);
        switch (cloud.smooth_weight) {
            case AutomatonWeight::kEven:
                return 1.0;
            case AutomatonWeight::kLinear:
                return 1 - u;
            case AutomatonWeight::kQuadratic:
                return 1 - u * u;
            case AutomatonWeight::kSmooth:
                return 1 - 3 * u * u + 2 * u * u * u;
            case AutomatonWeight::kTable:
                break;
        }
        const auto& table = cloud.smooth_weight_table;  // of three values
        return u < 0.5
                   ? std::lerp(static_cast<double>(table[0]), static_cast<double>(table[1]), 2 * u)
                   : std::lerp(static_cast<double>(table[1]), static_cast<double>(table[2]),
                               2 * u - 1);
    };
    double sum = 0, all = 0;
    const auto r = glm::ivec3(cloud.smooth);
    for (int c = -r.z; c <= r.z; ++c)
        for (int b = -r.y; b <= r.y; ++b)
            for (int a = -r.x; a <= r.x; ++a) {
                const double w = weight(a, cloud.smooth.x) * weight(b, cloud.smooth.y) *
                                 weight(c, cloud.smooth.z);
                all += w;
                const glm::ivec3 at(x + a, y + b, z + c);
                if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= static_cast<int>(grid.nx) ||
                    at.y >= static_cast<int>(grid.ny) || at.z >= static_cast<int>(grid.nz))
                    continue;
                const std::size_t row =
                    grid.row(static_cast<std::size_t>(at.y), static_cast<std::size_t>(at.z));
                const auto i = static_cast<std::size_t>(at.x);
                sum += w * static_cast<double>(sky[row * grid.words + i / 64] >> i % 64 & 1);
            }
    return sum / all;
}

TEST(AutomatonWeights, AreThePrintedSum) {
    constexpr double kReaches[][3] = {{0, 0, 0}, {1, 1, 1}, {2, 0, 1}, {4, 4, 4}};
    for (int weight = 0; weight < 5; ++weight)
        for (const auto& reach : kReaches) {
            AutomatonCloud cloud;
            cloud.cells = {70, 6, 7};
            cloud.smooth = {reach[0], reach[1], reach[2]};
            cloud.smooth_weight = static_cast<AutomatonWeight>(weight);
            if (cloud.smooth_weight == AutomatonWeight::kTable)
                cloud.smooth_weight_table = {0.5F, 1, 0.25F};
            const AutomatonGrid grid(cloud.cells);
            const auto sky = random_sky(grid, 5), later = random_sky(grid, 99);
            automaton::CellDensity density;
            density.now = {&sky};
            density.next = {&later};
            density.share_of_next = 0.25;
            DensityPlanes planes(cloud, grid, density);
            double worst = 0;
            for (std::size_t k = 0; k < grid.nz; ++k) {
                planes.go_to(k);
                for (std::size_t j = 0; j < grid.ny; ++j)
                    for (std::size_t i = 0; i < grid.nx; ++i) {
                        const int x = static_cast<int>(i), y = static_cast<int>(j),
                                  z = static_cast<int>(k);
                        const double wanted = 0.75 * printed_density(cloud, grid, sky, x, y, z) +
                                              0.25 * printed_density(cloud, grid, later, x, y, z);
                        const double got = planes.row_is_empty(j) ? 0 : planes(i, j);
                        worst = std::max(worst, std::abs(got - wanted));
                    }
            }
            // Sums of at most 729 floats.
            EXPECT_LT(worst, 1e-5) << "weight " << weight << ", reach " << reach[0];
        }
}

TEST(AutomatonWeights, ParticlesHaveTheSameMassAndBytesForAnyThreads) {
    AutomatonCloud cloud;
    cloud.cells = {64, 10, 80};
    cloud.smooth = {2, 2, 2};
    const AutomatonGrid grid(cloud.cells);
    // Away from the border, where what is smoothed over it is lost.
    std::vector<std::uint64_t> sky(grid.all_words());
    for (std::size_t k = 5; k < 75; ++k)
        for (std::size_t j = 3; j < 7; ++j)
            sky[grid.row(j, k)] = keyed(3, grid.row(j, k)) & 0x00fffffffffff000u;
    automaton::CellDensity density;
    density.now = {&sky};
    double first_mass = 0;
    for (int weight = 0; weight < 4; ++weight) {
        cloud.smooth_weight = static_cast<AutomatonWeight>(weight);
        const auto one = automaton::cells_to_particles(cloud, density, 1u << 20, 1, {});
        const auto four = automaton::cells_to_particles(cloud, density, 1u << 20, 4, {});
        EXPECT_EQ(one->particles.densities, four->particles.densities);
        EXPECT_EQ(one->particles.positions, four->particles.positions);
        double mass = 0;
        for (const float d : one->particles.densities) mass += static_cast<double>(d);
        if (weight == 0)
            first_mass = mass;
        else
            EXPECT_NEAR(mass, first_mass, 1e-5 * first_mass) << weight;
    }
    EXPECT_GT(first_mass, 0);
}

}  // namespace
}  // namespace awan
