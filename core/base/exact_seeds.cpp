// The functions that particles hang on to the bit (exact_math.h).
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan::exact {
namespace {

// Taylor series by Horner's rule, from the highest term down. On |x| <= pi/2 the first term left out is below 5e-14
// (sin), and on |x| <= pi/4 below 1e-19 (both).
double sin_series(double x) {
    const double y = x * x;
    // The term of x^17, 1/17!.
    double p = 1.0 / 355687428096000.0;
    p = -1.0 / 1307674368000.0 + y * p;
    p = 1.0 / 6227020800.0 + y * p;
    p = -1.0 / 39916800.0 + y * p;
    p = 1.0 / 362880.0 + y * p;
    p = -1.0 / 5040.0 + y * p;
    p = 1.0 / 120.0 + y * p;
    p = -1.0 / 6.0 + y * p;
    return x + x * y * p;
}

double cos_series(double x) {
    const double y = x * x;
    // The term of x^16, 1/16!.
    double p = 1.0 / 20922789888000.0;
    p = -1.0 / 87178291200.0 + y * p;
    p = 1.0 / 479001600.0 + y * p;
    p = -1.0 / 3628800.0 + y * p;
    p = 1.0 / 40320.0 + y * p;
    p = -1.0 / 720.0 + y * p;
    p = 1.0 / 24.0 + y * p;
    p = -0.5 + y * p;
    return 1.0 + y * p;
}

}  // namespace

double seeded_sin(double x) {
    using std::numbers::pi;
    // The remainder itself is exact by IEEE 754; only 2 pi is rounded.
    double r = std::fmod(x, 2 * pi);
    if (r > pi) r -= 2 * pi;
    if (r < -pi) r += 2 * pi;
    if (r > pi / 2) r = pi - r;
    if (r < -pi / 2) r = -pi - r;
    return sin_series(r);
}

SinCos sincos_degrees(double degrees) {
    double r = std::fmod(degrees, 360.0);
    if (r < 0) r += 360.0;
    // The nearest multiple of a right angle, 0..4.
    const int quarter = static_cast<int>(std::floor(r / 90.0 + 0.5));
    const double x = (r - 90.0 * quarter) * (std::numbers::pi / 180.0);
    return turned({sin_series(x), cos_series(x)}, quarter);
}

double seeded_exp(double x) {
    if (!(x > -700)) return 0;
    // x = n ln 2 + r, |r| <= ln 2 / 2; ln 2 in two parts, so that n times the first is exact.
    const double n = std::floor(x / std::numbers::ln2 + 0.5);
    const double r = (x - n * 0x1.62e42feep-1) - n * 0x1.a39ef35793c76p-33;
    // Taylor's series by Horner's rule; the first term left out is below 1e-17.
    double p = 1;
    for (int k = 13; k > 0; --k) p = 1 + p * r / k;
    return std::ldexp(p, static_cast<int>(n));
}

}  // namespace awan::exact
