// The elementary functions of core/base/exact_math.h: beside the library's in long double, and to the bit.
#include "core/base/exact_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace awan {
namespace {

using Function = double (*)(double);
using Reference = long double (*)(long double);

// A function, what it should be, where it is tried and the largest relative error that its declaration allows.
struct Case {
    const char* name;
    Function function;
    Reference reference;
    double from, to, error;
};
#define AWAN_CASE(name, from, to, error)                                                         \
    Case {                                                                                       \
#name,                                                                                   \
            [](double x) { return exact::name(x); },                                             \
                                                  [](long double x) { return std::name(x); },    \
                                                                                           from, \
                                                                                           to,   \
                                                                                           error \
    }
const Case kCases[] = {
    AWAN_CASE(exp, -700, 700, 4e-16),     AWAN_CASE(exp, -1, 1, 4e-16),
    AWAN_CASE(exp2, -1000, 1000, 4e-16),  AWAN_CASE(expm1, -40, 40, 1e-15),
    AWAN_CASE(expm1, -1, 1, 1e-15),       AWAN_CASE(expm1, -1e-5, 1e-5, 4e-16),
    AWAN_CASE(log, 1e-9, 3, 4e-16),       AWAN_CASE(log, 0.9, 1.1, 4e-16),
    AWAN_CASE(log, 1, 1e300, 4e-16),      AWAN_CASE(log2, 0.01, 100, 4e-16),
    AWAN_CASE(log10, 0.01, 1e4, 4e-16),   AWAN_CASE(log1p, -0.9, 1, 4e-16),
    AWAN_CASE(log1p, -1e-6, 1e-6, 4e-16), AWAN_CASE(log1p, 1, 1e6, 4e-16),
    AWAN_CASE(sin, -10, 10, 4e-16),       AWAN_CASE(sin, -1e6, 1e6, 4e-16),
    AWAN_CASE(cos, -10, 10, 4e-16),       AWAN_CASE(cos, -1e6, 1e6, 4e-16),
    AWAN_CASE(tan, -1.57, 1.57, 1e-15),   AWAN_CASE(asin, -1, 1, 1e-15),
    AWAN_CASE(acos, -1, 1, 1e-15),        AWAN_CASE(acos, 0.9999, 1, 1e-15),
    AWAN_CASE(atan, -1, 1, 4e-16),        AWAN_CASE(atan, -1000, 1000, 4e-16),
    AWAN_CASE(sinh, -3, 3, 2e-15),        AWAN_CASE(cbrt, -1e6, 1e6, 4e-16),
    AWAN_CASE(cbrt, 0, 1e-300, 4e-16),    AWAN_CASE(erf, -4, 4, 1.5e-15),
    AWAN_CASE(erfc, -4, 2, 1e-12),        AWAN_CASE(erfc, 2, 26, 1e-12),
};
#undef AWAN_CASE

TEST(ExactMath, IsWithinItsErrorOfTheLibrary) {
    std::mt19937_64 random(1);
    for (const Case& c : kCases) {
        std::uniform_real_distribution<double> some(c.from, c.to);
        for (int i = 0; i < 5000; ++i) {
            const double x = some(random);
            const long double truth = c.reference(static_cast<long double>(x));
            const long double error = (static_cast<long double>(c.function(x)) - truth) / truth;
            ASSERT_LT(std::abs(static_cast<double>(error)), c.error) << c.name << "(" << x << ")";
        }
    }
    std::uniform_real_distribution<double> base(0, 1000), power(-40, 40), side(-1, 1);
    for (int i = 0; i < 20000; ++i) {
        const double x = base(random), y = power(random), a = side(random), b = side(random);
        const long double truth =
            std::pow(static_cast<long double>(x), static_cast<long double>(y));
        ASSERT_LT(std::abs(static_cast<double>(exact::pow(x, y) / truth - 1)), 4e-16)
            << x << "^" << y;
        const long double arc =
            std::atan2(static_cast<long double>(a), static_cast<long double>(b));
        ASSERT_LT(std::abs(static_cast<double>(exact::atan2(a, b) / arc - 1)), 4e-16)
            << a << " " << b;
        ASSERT_DOUBLE_EQ(exact::hypot(a, b), std::hypot(a, b));
        ASSERT_DOUBLE_EQ(exact::hypot(a, b, y), std::hypot(a, b, y));
    }
    for (const double huge : {1e9, -1e18, 1e300}) EXPECT_LE(std::abs(exact::sin(huge)), 1);
}

TEST(ExactMath, WhatCanBeExactIs) {
    for (int k = -1022; k < 1024; ++k) {
        const double power = std::ldexp(1.0, k);
        ASSERT_EQ(exact::exp2(static_cast<double>(k)), power);
        ASSERT_EQ(exact::pow(2, k), power);
        ASSERT_EQ(exact::log2(power), k);
    }
    for (int k = 0; k <= 22; ++k) {
        // Products of fives up to 5^22 have 53 bits.
        double power = 1;
        for (int i = 0; i < k; ++i) power *= 10;
        ASSERT_EQ(exact::pow(10, k), power);
        ASSERT_EQ(exact::log10(power), k);
    }
    for (int n = 1; n < 2000; ++n) {
        const double x = n;
        ASSERT_EQ(exact::pow(x, 2), x * x);
        ASSERT_EQ(exact::pow(-x, 3), -x * x * x);
        ASSERT_EQ(exact::pow(x * x, 0.5), x);
        ASSERT_EQ(exact::cbrt(x * x * x), x);
    }
    for (int quarter = -8; quarter <= 8; ++quarter) {
        const exact::SinCos both = exact::sincos_degrees(90.0 * quarter);
        EXPECT_EQ(std::abs(both.sin) + std::abs(both.cos), 1) << quarter;
    }
    EXPECT_EQ(exact::exp(0.0), 1);
    EXPECT_EQ(exact::hypot(3, 4), 5);
    EXPECT_EQ(exact::acos(-1.0), std::numbers::pi);
    EXPECT_EQ(exact::atan2(1.0, 0.0), std::numbers::pi / 2);
}

TEST(ExactMath, SpecialValuesAreThoseOfTheLibrary) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double special[] = {0.0,    -0.0,  1,      -1, kInfinity, -kInfinity, std::nan(""),
                              5e-324, 1e308, -1e308, 2,  -2,        3,          -0.5,
                              -746,   710,   -1.5};
    const auto same = [](double a, double b) {
        if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
        return std::signbit(a) == std::signbit(b) &&
               (a == b || std::abs(a - b) <= 1e-12 * std::abs(b) + 1e-323);
    };
    for (const Case& c : kCases)
        for (const double x : special) {
            // Large angles are reduced by a rounded 2 pi.
            const std::string name = c.name;
            if (std::abs(x) == 1e308 && (name == "sin" || name == "cos" || name == "tan")) continue;
            const auto truth = static_cast<double>(c.reference(static_cast<long double>(x)));
            EXPECT_TRUE(same(c.function(x), truth))
                << name << "(" << x << ") is " << c.function(x) << ", not " << truth;
        }
    for (const double x : special)
        for (const double y : special) {
            EXPECT_TRUE(same(exact::pow(x, y), std::pow(x, y)))
                << x << "^" << y << " is " << exact::pow(x, y) << ", not " << std::pow(x, y);
            EXPECT_TRUE(same(exact::atan2(x, y), std::atan2(x, y))) << x << " " << y;
        }
}

TEST(ExactMath, SeededFunctionsAreRougher) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> wide(-1000, 1000);
    for (int i = 0; i < 10000; ++i) {
        const double x = wide(random);
        ASSERT_NEAR(exact::seeded_sin(x), std::sin(x), 1e-12) << x;
        const exact::SinCos both = exact::sincos_degrees(x);
        ASSERT_NEAR(both.sin, std::sin(x * std::numbers::pi / 180), 1e-13) << x;
        ASSERT_NEAR(both.cos, std::cos(x * std::numbers::pi / 180), 1e-13) << x;
    }
    for (double x = 0; x > -690; x -= 0.37)
        ASSERT_NEAR(exact::seeded_exp(x) / std::exp(x), 1, 2e-14) << x;
    EXPECT_EQ(exact::seeded_exp(0), 1);
    EXPECT_EQ(exact::seeded_exp(-std::numeric_limits<double>::infinity()), 0);
}

TEST(ExactMath, FloatsAreRoundedDoubles) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<float> some(0.01f, 10);
    for (int i = 0; i < 1000; ++i) {
        const float x = some(random), y = some(random);
        ASSERT_EQ(exact::exp(-x), static_cast<float>(exact::exp(-static_cast<double>(x))));
        ASSERT_EQ(exact::pow(x, y),
                  static_cast<float>(exact::pow(static_cast<double>(x), static_cast<double>(y))));
        ASSERT_FLOAT_EQ(exact::log(x), std::log(x));
    }
}

// FNV-1a of all results. The figure is what x86-64 gives, with fused multiply-adds in the system's library and without,
// and ARM: it may change when a function is written anew, and never between machines.
TEST(ExactMath, HasTheSameBitsOnEveryMachine) {
    std::uint64_t hash = 14695981039346656037u, state = 1;
    const auto unit = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-53;
    };
    const auto add = [&](double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    };
    for (const Case& c : kCases)
        for (int i = 0; i < 2000; ++i) add(c.function(c.from + (c.to - c.from) * unit()));
    for (int i = 0; i < 2000; ++i) {
        const double x = 100 * unit(), y = 20 * unit() - 10;
        add(exact::pow(x, y));
        add(exact::atan2(y, x));
        add(exact::hypot(x, y));
        const exact::SinCos both = exact::sincos_degrees(37 * y);
        add(both.sin);
        add(both.cos);
        add(exact::seeded_sin(y));
        add(exact::seeded_exp(-x));
    }
    EXPECT_EQ(hash, 0x1ed06c996170ad1eu) << std::hex << hash;
}

}  // namespace
}  // namespace awan
