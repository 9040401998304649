// Exponentials, logarithms and roots; angles are in exact_angles.cpp.
#include "core/base/exact_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>

namespace awan::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// ln 2 in two parts: an integer below 2^21 times the first is exact.
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

// A number as an unevaluated sum, |low| at most half a unit in the last place of high.
struct Two {
    double high, low;
};
// Dekker 1971: the exact sum where |a| >= |b|, of any two, and the exact product (of numbers below 1e300).
Two sum_of_ordered(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}
Two sum_of(double a, double b) {
    const double sum = a + b, of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}
// By multiplying with 2^27 + 1.
Two halves_of(double a) {
    constexpr double kHalf = 134217729.0;
    const double big = a * kHalf;
    const double high = big - (big - a);
    return {high, a - high};
}
Two product_of(double a, double b) {
    const double product = a * b;
    const Two x = halves_of(a), y = halves_of(b);
    return {product,
            ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

// x 2^n, |n| up to 2000.
double scaled(double x, int n) {
    if (n < -1000 || n > 1000) return std::ldexp(x, n);
    return x * std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

// 2^(i / 32), the nearest number and what it lacks.
constexpr Two kRootsOfTwo[] = {
    {0x1.0000000000000p+0, 0x0.0p+0},
    {0x1.059b0d3158574p+0, 0x1.d73e2a475b465p-55},
    {0x1.0b5586cf9890fp+0, 0x1.8a62e4adc610bp-54},
    {0x1.11301d0125b51p+0, -0x1.6c51039449b3ap-54},
    {0x1.172b83c7d517bp+0, -0x1.19041b9d78a76p-55},
    {0x1.1d4873168b9aap+0, 0x1.e016e00a2643cp-54},
    {0x1.2387a6e756238p+0, 0x1.9b07eb6c70573p-54},
    {0x1.29e9df51fdee1p+0, 0x1.612e8afad1255p-55},
    {0x1.306fe0a31b715p+0, 0x1.6f46ad23182e4p-55},
    {0x1.371a7373aa9cbp+0, -0x1.63aeabf42eae2p-54},
    {0x1.3dea64c123422p+0, 0x1.ada0911f09ebcp-55},
    {0x1.44e086061892dp+0, 0x1.89b7a04ef80d0p-59},
    {0x1.4bfdad5362a27p+0, 0x1.d4397afec42e2p-56},
    {0x1.5342b569d4f82p+0, -0x1.07abe1db13cadp-55},
    {0x1.5ab07dd485429p+0, 0x1.6324c054647adp-54},
    {0x1.6247eb03a5585p+0, -0x1.383c17e40b497p-54},
    {0x1.6a09e667f3bcdp+0, -0x1.bdd3413b26456p-54},
    {0x1.71f75e8ec5f74p+0, -0x1.16e4786887a99p-55},
    {0x1.7a11473eb0187p+0, -0x1.41577ee04992fp-55},
    {0x1.82589994cce13p+0, -0x1.d4c1dd41532d8p-54},
    {0x1.8ace5422aa0dbp+0, 0x1.6e9f156864b27p-54},
    {0x1.93737b0cdc5e5p+0, -0x1.75fc781b57ebcp-57},
    {0x1.9c49182a3f090p+0, 0x1.c7c46b071f2bep-56},
    {0x1.a5503b23e255dp+0, -0x1.d2f6edb8d41e1p-54},
    {0x1.ae89f995ad3adp+0, 0x1.7a1cd345dcc81p-54},
    {0x1.b7f76f2fb5e47p+0, -0x1.5584f7e54ac3bp-56},
    {0x1.c199bdd85529cp+0, 0x1.11065895048ddp-55},
    {0x1.cb720dcef9069p+0, 0x1.503cbd1e949dbp-56},
    {0x1.d5818dcfba487p+0, 0x1.2ed02d75b3707p-55},
    {0x1.dfc97337b9b5fp+0, -0x1.1a5cd4f184b5cp-54},
    {0x1.ea4afa2a490dap+0, -0x1.e9c23179c2893p-54},
    {0x1.f50765b6e4540p+0, 0x1.9d3e12dd8a18bp-54},
};

// e^(r + low) - 1 by Taylor's series, |r| <= ln 2 / 64: the first term left out is below 4e-18.
double small_expm1(double r, double low) {
    const double z = r * r;
    const double bend =
        (0.5 + r * (1.0 / 6)) + z * ((1.0 / 24 + r * (1.0 / 120)) + z * (1.0 / 720));
    return r + (low + z * bend);
}

// 2^(k / 32) (1 + more), |k| up to 60,000.
double times_roots(double more, int k) {
    const Two& root = kRootsOfTwo[k & 31];
    return scaled(root.high + (root.low + root.high * more), k >> 5);
}

// (e^r - 1 - r) / r^2 by Taylor's series; |r| <= .35: the first term left out is below 1e-18.
double exp_rest(double r) {
    double p = 1.0 / 87178291200.0;
    for (const double term : {6227020800.0, 479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0,
                              5040.0, 720.0, 120.0, 24.0, 6.0, 2.0})
        p = 1.0 / term + r * p;
    return p;
}

// The nearest integer, |x| < 2^51: what is added leaves no room for a fraction.
double nearest(double x) {
    constexpr double kShift = 0x1.8p52;
    return (x + kShift) - kShift;
}

// e^(x + low), low up to the size of x's last place.
double exp_of(double x, double low) {
    if (std::isnan(x)) return x;
    if (x > 709.79) return kInfinity;
    if (x < -745.2) return 0;
    // x = k ln 2 / 32 + r + what r lost by rounding, |r| <= ln 2 / 64 (Cody & Waite 1980; Tang 1989).
    const double k = nearest(x * (32 * std::numbers::log2e));
    const double rest = x - k * (kLn2High / 32), second = k * (kLn2Low / 32);
    const double r = rest - second;
    low += (rest - r) - second;
    return times_roots(small_expm1(r, low), static_cast<int>(k));
}

// x = m 2^e, m from sqrt(1/2) to sqrt(2); x positive and finite.
struct Parts {
    double m;
    int e;
};
Parts parts_of(double x) {
    Parts parts{};
    parts.m = std::frexp(x, &parts.e);
    if (parts.m < std::numbers::sqrt2 / 2) {
        parts.m *= 2;
        --parts.e;
    }
    return parts;
}

// With s = f / (2 + f): log(1 + f) = 2 artanh(s) = 2 s + s (2/3 s^2 + 2/5 s^4 + ...); this is what is in brackets, z =
// s^2 <= .0295. The first term left out is below 1e-19.
double artanh_rest(double z) {
    double p = 2.0 / 25;
    p = 2.0 / 23 + z * p;
    p = 2.0 / 21 + z * p;
    p = 2.0 / 19 + z * p;
    p = 2.0 / 17 + z * p;
    p = 2.0 / 15 + z * p;
    p = 2.0 / 13 + z * p;
    p = 2.0 / 11 + z * p;
    p = 2.0 / 9 + z * p;
    p = 2.0 / 7 + z * p;
    p = 2.0 / 5 + z * p;
    return z * (2.0 / 3 + z * p);
}

// log(1 + f) as f less what is small beside it, so that only the last difference rounds (Ng 1993).
double log_of_near_one(double f, double e_low) {
    const double s = f / (2 + f), half = 0.5 * f * f;
    return half - (s * (half + artanh_rest(s * s)) + e_low);
}

// log x, 1e-19 of its size or of 1, whichever is smaller, off; x positive and finite.
Two log_in_two(double x) {
    const Parts parts = parts_of(x);
    const double f = parts.m - 1;
    const Two below = sum_of_ordered(2, f);
    const double s = f / below.high;
    const Two back = product_of(s, below.high);
    const double s_low = (((f - back.high) - back.low) - s * below.low) / below.high;
    const Two sum = sum_of(parts.e * kLn2High, 2 * s);
    return sum_of_ordered(sum.high,
                          sum.low + (2 * s_low + s * artanh_rest(s * s) + parts.e * kLn2Low));
}

// What a logarithm of no positive finite number is.
double log_of_special(double x) {
    return x == 0 ? -kInfinity : x > 0 ? x : kNan;
}
bool is_special(double x) {
    return !(x > 0 && x < kInfinity);
}

// pow for x > 0, both finite.
double pow_of_positive(double x, double y) {
    // Beyond this power whatever is not 1 is 0 or infinite.
    const double power = std::fmax(-1e25, std::fmin(y, 1e25));
    const Two log = log_in_two(x);
    const Two product = product_of(power, log.high);
    return exp_of(product.high, product.low + power * log.low);
}

}  // namespace

double exp(double x) {
    return exp_of(x, 0);
}

double exp2(double x) {
    if (std::isnan(x)) return x;
    if (x > 1024.5) return kInfinity;
    if (x < -1076) return 0;
    const double k = nearest(32 * x);
    return times_roots(small_expm1((x - k / 32) * std::numbers::ln2, 0), static_cast<int>(k));
}

double expm1(double x) {
    if (x == 0) return x;
    if (std::abs(x) < 0.35) return x + x * x * exp_rest(x);
    return exp(x) - 1;
}

double log(double x) {
    if (is_special(x)) return log_of_special(x);
    const Parts parts = parts_of(x);
    const double f = parts.m - 1;
    return parts.e * kLn2High - (log_of_near_one(f, parts.e * kLn2Low) - f);
}

double log2(double x) {
    if (is_special(x)) return log_of_special(x);
    const Parts parts = parts_of(x);
    const double f = parts.m - 1;
    return parts.e + (f - log_of_near_one(f, 0)) / std::numbers::ln2;
}

double log10(double x) {
    if (is_special(x)) return log_of_special(x);
    const Two log = log_in_two(x);
    // 1 / ln 10 in two parts.
    constexpr double kHigh = 0x1.bcb7b1526e50ep-2, kLow = 0x1.95355baaafad3p-57;
    const Two product = product_of(log.high, kHigh);
    return product.high + (product.low + log.high * kLow + log.low * kHigh);
}

double log1p(double x) {
    if (!(x > -1) || x == kInfinity) return log_of_special(x + 1);
    if (x == 0) return x;
    const Two sum = sum_of(1, x);
    return log(sum.high) + sum.low / sum.high;
}

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (std::isnan(x) || std::isnan(y)) return kNan;
    const bool whole = std::floor(y) == y, odd = whole && std::fmod(y, 2) != 0;
    const double sign = std::signbit(x) && odd ? -1 : 1, size = std::abs(x);
    if (std::isinf(y)) return size == 1 ? 1 : (size > 1) == (y > 0) ? kInfinity : 0;
    if (x == 0) return sign * (y > 0 ? 0 : kInfinity);
    if (std::isinf(x)) return sign * (y > 0 ? kInfinity : 0);
    if (x < 0 && !whole) return kNan;
    return sign * pow_of_positive(size, y);
}

double sinh(double x) {
    if (std::abs(x) > 700) return std::copysign(exp(std::abs(x) - std::numbers::ln2), x);
    const double part = expm1(std::abs(x));
    return std::copysign(0.5 * (part + part / (1 + part)), x);
}

double cbrt(double x) {
    if (is_special(std::abs(x))) return x;
    const double size = std::abs(x);
    // A guess of 23 bits, whose square is exact, and a step of Halley's.
    const double guess = exp(log(size) / 3);
    const auto bits =
        (std::bit_cast<std::uint64_t>(guess) + (1u << 29)) & ~((std::uint64_t{1} << 30) - 1);
    const double t = std::bit_cast<double>(bits);
    const double u = size / (t * t);
    return std::copysign(t + t * ((u - t) / (t + t + u)), x);
}

double hypot(double x, double y) {
    return std::sqrt(x * x + y * y);
}
double hypot(double x, double y, double z) {
    return std::sqrt(x * x + y * y + z * z);
}

double erf(double x) {
    const double size = std::abs(x);
    if (!(size < 2)) return std::isnan(x) ? x : std::copysign(1 - erfc(size), x);
    // Abramowitz & Stegun 1964, 7.1.6: all terms are positive. So many that the last is below 1e-18.
    double term = x, sum = x;
    for (int n = 1; n < 40; ++n) {
        term *= 2 * x * x / (2 * n + 1);
        sum += term;
    }
    return 2 * std::numbers::inv_sqrtpi * exp(-x * x) * sum;
}

double erfc(double x) {
    if (std::isnan(x)) return x;
    if (x < 0) return 2 - erfc(-x);
    if (x < 2) return 1 - erf(x);
    if (x > 27.3) return 0;
    // Abramowitz & Stegun 1964, 7.1.14: a continued fraction, from its far end.
    double below = x;
    for (int n = 60; n > 0; --n) below = x + 0.5 * n / below;
    return std::numbers::inv_sqrtpi * exp(-x * x) / below;
}

}  // namespace awan::exact
