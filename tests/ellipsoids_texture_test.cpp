// Gardner's texturing function: its maximum, its period, what blur leaves of it, and what is wrong in print.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/generate/ellipsoids/sine_sums.h"
#include "core/generate/ellipsoids/texture.h"
#include "tests/random_scenes.h"

namespace awan {
namespace {

using ellipsoids::blur_of_blob;
using ellipsoids::opacity;
using ellipsoids::sin_turns;
using ellipsoids::texture_at;
using ellipsoids::texture_function;
using ellipsoids::TextureFunction;
using ellipsoids::TextureValue;

using std::numbers::pi;
using test::Dice;

// As the equations stand, with the library's sines and in radians; k apart.
double by_the_equations(const SineTexture& texture, double x, double y, double z, bool in_space,
                        bool zero_below) {
    double a = 0, b = 0, c = 1, fx = texture.frequency_x, fy = texture.frequency_z;
    for (std::uint64_t i = 0; i < texture.terms; ++i) {
        const double height = in_space ? pi * std::sin(fx * z / 2) : 0;
        const double px = pi / 2 * std::sin(fy / 2 * y) + height;
        const double py = pi / 2 * std::sin(fx / 2 * x) + height;
        a += c * (std::sin(fx * x + px) + texture.offset);
        b += c * (std::sin(fy * y + py) + texture.offset);
        fx *= 2;
        fy *= 2;
        c *= 0.707;
    }
    if (zero_below) a = std::max(a, 0.0), b = std::max(b, 0.0);
    return a * b;
}

double sum_of_coefficients(std::uint64_t terms) {
    double sum = 0, c = 1;
    for (std::uint64_t i = 0; i < terms; ++i, c *= 0.707) sum += c;
    return sum;
}

SineTexture texture_with(std::uint64_t terms, double offset) {
    SineTexture texture;
    texture.terms = terms;
    texture.offset = offset;
    texture.frequency_x = 0.7;
    texture.frequency_z = 1.3;
    return texture;
}

TEST(GardnerTexture, IsTheEquationsOfTheSource) {
    Dice dice(1);
    for (const bool in_space : {false, true})
        for (int i = 0; i < 2000; ++i) {
            const SineTexture texture =
                texture_with(1 + static_cast<std::uint64_t>(dice.below(8)), dice.between(0, 2));
            const TextureFunction function = texture_function(texture, in_space);
            const glm::dvec3 p(dice.between(-30, 30), dice.between(-30, 30), dice.between(-30, 30));
            // Gardner's X, Y, Z are our x, z, y.
            const double expected =
                function.scale * by_the_equations(texture, p.x, p.z, p.y, in_space, true);
            // Our sine is within 1e-9 of the library's, a dozen of them in either factor.
            ASSERT_NEAR(texture_at(function, p).mean, expected, 1e-7);
            ASSERT_EQ(texture_at(function, p).variance, 0);
        }
}

TEST(GardnerTexture, SineIsWithinItsBound) {
    for (int i = -4000; i <= 4000; ++i) {
        const double turns = i * 0.00137;
        ASSERT_NEAR(sin_turns(turns), std::sin(2 * pi * turns), 1e-9);
    }
}

// The largest T that 60,000 places and a climb from the best 20 of them find: random, so it shares nothing with the
// search.
double largest_found(const TextureFunction& texture, std::uint64_t seed) {
    Dice dice(seed);
    struct Found {
        glm::dvec3 at;
        double value;
    };
    std::vector<Found> best;
    const double period_x = 1 / texture.turns_x, period_z = 1 / texture.turns_z;
    for (int i = 0; i < 60000; ++i) {
        const glm::dvec3 p(period_x * dice.uniform(), period_x * dice.uniform(),
                           period_z * dice.uniform());
        best.push_back({p, texture_at(texture, p).mean});
    }
    std::partial_sort(best.begin(), best.begin() + 20, best.end(),
                      [](const Found& a, const Found& b) { return a.value > b.value; });
    double most = 0;
    for (std::size_t i = 0; i < 20; ++i) {
        Found& one = best[i];
        for (double step = period_x / 500; step > period_x / 1e7; step /= 1.5)
            for (int tries = 0; tries < 20; ++tries) {
                const glm::dvec3 p = one.at + step * dice.on_sphere();
                const double value = texture_at(texture, p).mean;
                if (value > one.value) one = {p, value};
            }
        most = std::max(most, one.value);
    }
    return most;
}

TEST(GardnerTexture, ItsMaximumIsOne) {
    std::uint64_t seed = 0;
    for (const std::uint64_t terms : {1, 2, 4, 5, 6, 7, 8})
        for (const double offset : {0.0, 0.5, 1.0, 5.0})
            for (const bool in_space : {false, true}) {
                const TextureFunction texture =
                    texture_function(texture_with(terms, offset), in_space);
                const double most = largest_found(texture, ++seed);
                // Never above (rounding apart), and near: random climbs reach 94% of the peak even where eight terms
                // in space make it a needle.
                EXPECT_LE(most, 1 + 1e-6)
                    << terms << " terms, offset " << offset << ", " << in_space;
                EXPECT_GE(most, 0.85) << terms << " terms, offset " << offset << ", " << in_space;
            }
}

TEST(GardnerTexture, TheSumOfTheCoefficientsIsNoMaximum) {
    // The k that one reads off the formula leaves the largest T well below 1, and more so with more terms.
    for (const std::uint64_t terms : {4, 7}) {
        const TextureFunction texture = texture_function(texture_with(terms, 0.5), false);
        const double highest = 1.5 * sum_of_coefficients(terms);
        const double naive = 1 / (highest * highest);
        EXPECT_LT(naive / texture.scale, 0.9) << terms;
        EXPECT_GT(naive / texture.scale, 0.4) << terms;
    }
}

TEST(GardnerTexture, TwoNegativeFactorsMakeNoCloud) {
    // At T0 = 0 as printed, T is positive where both sums are negative.
    SineTexture texture = texture_with(5, 0);
    Dice dice(3);
    int ghosts = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = dice.between(0, 20), y = dice.between(0, 20);
        const double raw = by_the_equations(texture, x, y, 0, false, false);
        const double clean = by_the_equations(texture, x, y, 0, false, true);
        if (raw > 0 && clean == 0) ++ghosts;
        EXPECT_GE(clean, 0);
    }
    // A quarter of the plane, where the signs of the two are about independent.
    EXPECT_NEAR(ghosts / 20000.0, 0.25, 0.05);
    const TextureFunction function = texture_function(texture, true);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p(dice.between(0, 20), dice.between(0, 20), dice.between(0, 20));
        EXPECT_GE(texture_at(function, p).mean, 0);
    }
}

TEST(GardnerTexture, PrintedPhasesForgetTheHeight) {
    // Sunar et al. 2005 (4.6): where sin(FY y / 2) = 0 the phase PX is 0, and pi sin(PX Z/2) with it, for every term:
    // the first sum does not change with height at all. With the frequency, as Gardner has it, it does.
    SineTexture texture = texture_with(6, 1);
    const auto range_of = [&](TextureForm form) {
        texture.form = form;
        const TextureFunction function = texture_function(texture, true);
        double low = 1e9, high = -1e9;
        for (int i = 0; i < 200; ++i) {
            // x = z = 0: both phases are 0.
            const double value = texture_at(function, {0, 0.1 * i, 0}).mean;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        return high - low;
    };
    EXPECT_LT(range_of(TextureForm::kPrinted), 1e-12);
    EXPECT_GT(range_of(TextureForm::kClean), 0.3);
}

TEST(GardnerTexture, PrintedStaysWithinOne) {
    SineTexture texture = texture_with(6, 0.3);
    texture.form = TextureForm::kPrinted;
    const TextureFunction function = texture_function(texture, true);
    Dice dice(5);
    double least = 1;
    for (int i = 0; i < 100000; ++i) {
        const double value = texture_at(function, {dice.between(-99, 99), dice.between(-99, 99),
                                                   dice.between(-99, 99)})
                                 .mean;
        ASSERT_LE(value, 1);
        ASSERT_GE(value, -1);
        least = std::min(least, value);
    }
    EXPECT_LT(least, 0) << "as printed, a factor may be negative";
}

TEST(GardnerTexture, HasItsPeriodAlongEveryAxisAndIsContinuous) {
    const TextureFunction function = texture_function(texture_with(7, 0.8), true);
    const double period_x = 4 * pi / 0.7, period_z = 4 * pi / 1.3;
    Dice dice(6);
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p(dice.between(-9, 9), dice.between(-9, 9), dice.between(-9, 9));
        const double here = texture_at(function, p).mean;
        // A period is rounded: 1e-15 of a turn, 2^7 times as much in the last term.
        ASSERT_NEAR(texture_at(function, p + glm::dvec3(period_x, 0, 0)).mean, here, 1e-10);
        ASSERT_NEAR(texture_at(function, p + glm::dvec3(0, period_x, 0)).mean, here, 1e-10);
        ASSERT_NEAR(texture_at(function, p + glm::dvec3(0, 0, 3 * period_z)).mean, here, 1e-10);
        // Slopes: no term is steeper than C F (1 + pi/4 + pi/2), 64 * .125 * 1.3 * 3.4 = 35 for the last, 90 in all,
        // times the other factor over the peak: 50.
        const glm::dvec3 near = p + 1e-6 * dice.on_sphere();
        ASSERT_NEAR(texture_at(function, near).mean, here, 100 * 1e-6);
    }
}

TEST(GardnerTexture, DriftMovesIt) {
    const SineTexture texture = texture_with(6, 1);
    const glm::dvec3 shift(1.5, -0.25, 3);
    const TextureFunction still = texture_function(texture, true);
    const TextureFunction moved = texture_function(texture, true, shift);
    const glm::dvec3 p(0.3, 0.7, -2);
    EXPECT_NEAR(texture_at(moved, p + shift).mean, texture_at(still, p).mean, 1e-12);
}

TEST(GardnerTexture, FiniteAtTheEndsOfItsRanges) {
    Dice dice(7);
    for (int i = 0; i < 4000; ++i) {
        SineTexture texture;
        texture.form = dice.chance(0.5) ? TextureForm::kClean : TextureForm::kPrinted;
        texture.terms = 1 + static_cast<std::uint64_t>(dice.below(8));
        texture.frequency_x =
            dice.either({limits::kMinTextureFrequency, 1, limits::kMaxTextureFrequency});
        texture.frequency_z =
            dice.either({limits::kMinTextureFrequency, 1, limits::kMaxTextureFrequency});
        texture.offset = dice.either({0, 1, limits::kMaxTextureOffset});
        const TextureFunction function =
            texture_function(texture, dice.chance(0.5), dice.any_vector(1e12));
        const double blur = dice.either({0, 1e-9, 1, 1e30, 1e60});
        const TextureValue value = texture_at(function, dice.any_vector(1e15), blur, blur);
        ASSERT_TRUE(value.mean >= -1 && value.mean <= 1 + 1e-6) << value.mean;
        ASSERT_TRUE(value.variance >= 0 && value.variance < 1) << value.variance;
        for (const double range : {limits::kMinTextureRange, limits::kMaxTextureRange}) {
            const double opaque = opacity(value, dice.between(-10, 10), range);
            ASSERT_TRUE(opaque >= 0 && opaque <= 1);
        }
    }
}

// --- blur

TEST(GardnerTexture, BlurIsTheMeanAndTheVarianceOverABlob) {
    // Against 4,000 points of a Gaussian blob, at places of all kinds.
    const SineTexture texture = texture_with(6, 1);
    const TextureFunction function = texture_function(texture, true);
    Dice dice(8);
    const auto normal = [&] {  // the sum of 12 evens: good to 1% out to 2.5 sigma
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += dice.uniform();
        return sum;
    };
    for (const double sigma : {0.05, 0.2, 0.6}) {
        double wrong = 0, spread = 0, said = 0;
        for (int k = 0; k < 40; ++k) {
            const glm::dvec3 p(dice.between(-9, 9), dice.between(-9, 9), dice.between(-9, 9));
            double sum = 0, squares = 0;
            constexpr int kPoints = 4000;
            for (int i = 0; i < kPoints; ++i) {
                const double x = normal(), y = normal(), z = normal();
                const double value = texture_at(function, p + sigma * glm::dvec3(x, y, z)).mean;
                sum += value / kPoints;
                squares += value * value / kPoints;
            }
            const TextureValue value = texture_at(function, p, blur_of_blob(function, false, sigma),
                                                  blur_of_blob(function, true, sigma));
            wrong += (value.mean - sum) * (value.mean - sum) / 40;
            spread += (squares - sum * sum) / 40;
            said += value.variance / 40;
        }
        // Slopes of phases enter by their mean square, and the two sums as if they were independent, which below they
        // are not wholly: the mean is right within half of the spread there is, and the spread within a factor of 2.
        EXPECT_LT(std::sqrt(wrong), 0.5 * std::sqrt(spread)) << sigma;
        EXPECT_GT(said, 0.5 * spread) << sigma;
        EXPECT_LT(said, 2 * spread) << sigma;
    }
}

// What blur takes from the mean is in the variance: the mean of the square over all places stays. And no axis is
// another's.
TEST(GardnerTexture, BlurMovesWhatItTakesIntoTheVariance) {
    SineTexture texture = texture_with(3, 2);  // an offset that no sum of sines falls below
    texture.frequency_z = texture.frequency_x;
    const TextureFunction function = texture_function(texture, false);
    Dice dice(5);
    double plain = 0, blurred = 0, taken = 0;
    constexpr int kPlaces = 200'000;
    for (int i = 0; i < kPlaces; ++i) {
        const glm::dvec3 p(dice.between(-900, 900), 0, dice.between(-900, 900));
        const double sharp = texture_at(function, p).mean;
        const TextureValue value = texture_at(function, p, 0.4, 0.7);
        plain += sharp * sharp / kPlaces;
        blurred += (value.mean * value.mean + value.variance) / kPlaces;
        taken += value.variance / kPlaces;
        if (i < 1000) {
            const TextureValue turned = texture_at(function, {p.z, 0, p.x}, 0.7, 0.4);
            EXPECT_NEAR(turned.mean, value.mean, 1e-9);
            EXPECT_NEAR(turned.variance, value.variance, 1e-9);
        }
    }
    EXPECT_GT(taken, 0.02 * plain);
    EXPECT_NEAR(blurred / plain, 1, 0.004);  // the places' chance
}

TEST(GardnerTexture, OpacityIsTheSourcesWithoutBlurAndAMeanWithIt) {
    for (const double t : {-0.1, 0.0, 0.3, 0.35, 0.4, 0.5, 0.7, 1.2}) {
        // 1 - TR, TR = clamp(1 - (It - T1)/D, 0, 1), T1 = .3, D = .4.
        const double through = std::clamp(1 - (t - 0.3) / 0.4, 0.0, 1.0);
        EXPECT_DOUBLE_EQ(opacity({t, 0}, 0.3, 0.4), 1 - through);
        EXPECT_NEAR(opacity({t, 1e-18}, 0.3, 0.4), 1 - through, 1e-8);
    }
    for (const double variance : {1e-4, 0.01, 0.2})
        for (const double mean : {0.1, 0.3, 0.42, 0.7, 0.9}) {
            double sum = 0;
            constexpr int kPoints = 20001;
            const double half = std::sqrt(3 * variance);
            for (int i = 0; i < kPoints; ++i) {
                const double t = mean + half * (2 * (i + 0.5) / kPoints - 1);
                sum += std::clamp((t - 0.3) / 0.4, 0.0, 1.0) / kPoints;
            }
            EXPECT_NEAR(opacity({mean, variance}, 0.3, 0.4), sum, 1e-6);
        }
}

}  // namespace
}  // namespace awan
