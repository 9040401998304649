// Sines, tangents and their inverses (exact_math.h).
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan::exact {
namespace {

// sin(r + low), |r| <= pi / 4, by Taylor's series; the first term left out is below 1e-19.
double sin_series(double r, double low) {
    const double z = r * r;
    double p = 1.0 / 355687428096000.0;
    p = -1.0 / 1307674368000.0 + z * p;
    p = 1.0 / 6227020800.0 + z * p;
    p = -1.0 / 39916800.0 + z * p;
    p = 1.0 / 362880.0 + z * p;
    p = -1.0 / 5040.0 + z * p;
    p = 1.0 / 120.0 + z * p;
    p = -1.0 / 6.0 + z * p;
    return r + (r * (z * p) + low * (1 - 0.5 * z));
}

// cos(r + low). 1 - z / 2 is taken apart so that what it loses by rounding is added again.
double cos_series(double r, double low) {
    const double z = r * r, half = 0.5 * z, first = 1 - half;
    double p = -1.0 / 6402373705728000.0;
    p = 1.0 / 20922789888000.0 + z * p;
    p = -1.0 / 87178291200.0 + z * p;
    p = 1.0 / 479001600.0 + z * p;
    p = -1.0 / 3628800.0 + z * p;
    p = 1.0 / 40320.0 + z * p;
    p = -1.0 / 720.0 + z * p;
    p = 1.0 / 24.0 + z * p;
    return first + (((1 - first) - half) + (z * z * p - r * low));
}

// An angle as a multiple of pi / 2 and high + low, at most pi / 4 in size.
struct Reduced {
    int quarter;
    double high, low;
};
Reduced reduced(double x) {
    if (std::abs(x) <= std::numbers::pi / 4) return {0, x, 0};
    if (std::abs(x) > 1e6) x = std::fmod(x, 2 * std::numbers::pi);
    // pi / 2 in three parts (Cody & Waite 1980): multiples of the first two are exact.
    constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34,
                     kThird = 0x1.3198a2e037073p-69;
    const double n = std::floor(x / (std::numbers::pi / 2) + 0.5);
    const double rest = x - n * kFirst, second = n * kSecond;
    const double high = rest - second;
    return {static_cast<int>(n) & 3, high, ((rest - high) - second) - n * kThird};
}

// What an infinite angle, or none, gives.
bool is_no_angle(double x) {
    return !(std::abs(x) <= std::numeric_limits<double>::max());
}
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// atan(k / 8) in two parts.
constexpr double kArcs[9][2] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

}  // namespace

SinCos turned(const SinCos& of, int quarter) {
    switch (quarter & 3) {
        case 0:
            return of;
        case 1:
            return {of.cos, -of.sin};
        case 2:
            return {-of.sin, -of.cos};
        default:
            return {-of.cos, of.sin};
    }
}

double sin(double x) {
    if (is_no_angle(x)) return kNoNumber;
    if (x == 0) return x;
    const Reduced r = reduced(x);
    const double value =
        (r.quarter & 1) != 0 ? cos_series(r.high, r.low) : sin_series(r.high, r.low);
    return (r.quarter & 2) != 0 ? -value : value;
}

double cos(double x) {
    if (is_no_angle(x)) return kNoNumber;
    const Reduced r = reduced(x);
    const double value =
        (r.quarter & 1) != 0 ? sin_series(r.high, r.low) : cos_series(r.high, r.low);
    return r.quarter == 1 || r.quarter == 2 ? -value : value;
}

double tan(double x) {
    if (is_no_angle(x)) return kNoNumber;
    if (x == 0) return x;
    const Reduced r = reduced(x);
    const SinCos of = turned({sin_series(r.high, r.low), cos_series(r.high, r.low)}, r.quarter);
    return of.sin / of.cos;
}

double atan(double x) {
    if (std::isnan(x)) return x;
    const bool steep = std::abs(x) > 1;
    const double t = steep ? 1 / std::abs(x) : std::abs(x);
    // atan t = atan c + atan((t - c) / (1 + t c)), c the nearest eighth; the rest, at most 1/16, by Taylor's series.
    // The first term left out is below 1e-20.
    const int eighth = static_cast<int>(t * 8 + 0.5);
    const double c = eighth / 8.0, u = (t - c) / (1 + t * c), z = u * u;
    double p = -1.0 / 15;
    p = 1.0 / 13 + z * p;
    p = -1.0 / 11 + z * p;
    p = 1.0 / 9 + z * p;
    p = -1.0 / 7 + z * p;
    p = 1.0 / 5 + z * p;
    p = -1.0 / 3 + z * p;
    const double rest = u + (u * z * p + kArcs[eighth][1]);
    // pi / 2 in two parts.
    constexpr double kHigh = 0x1.921fb54442d18p+0, kLow = 0x1.1a62633145c07p-54;
    const double arc = steep ? (kHigh - kArcs[eighth][0]) - (rest - kLow) : kArcs[eighth][0] + rest;
    return std::copysign(arc, x);
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return kNoNumber;
    const bool back = std::signbit(x);
    if (y == 0) return std::copysign(back ? std::numbers::pi : 0.0, y);
    const double of = std::isinf(x) && std::isinf(y) ? 1 : std::abs(y) / std::abs(x);
    // pi less what rounding took off it.
    constexpr double kLow = 0x1.1a62633145c07p-53;
    const double arc = back ? std::numbers::pi - (atan(of) - kLow) : atan(of);
    return std::copysign(arc, y);
}

double asin(double x) {
    return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double acos(double x) {
    return 2 * atan2(std::sqrt(1 - x), std::sqrt(1 + x));
}

}  // namespace awan::exact
