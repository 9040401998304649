// The elementary functions, the same to the last bit on every machine. A library's differ in it from one processor to
// the next (with fused multiply-adds and without, x86 and ARM: one result in a thousand), and a last bit may become
// another pixel. These are plain IEEE double arithmetic (the compiler may not contract it, see CMakeLists.txt); sqrt,
// floor, fmod, frexp, ldexp and round are exact everywhere, and are left to <cmath>.
//
// Arguments, special values and results are those of <cmath>; relative errors are below 4e-16, two units in the last
// place, where nothing else is said. Of floats: computed in double and rounded.
#pragma once

#include <type_traits>

namespace awan::exact {

double exp(double x);
double exp2(double x);
double log(double x);
double log2(double x);
double log10(double x);
double log1p(double x);
double pow(double x, double y);
double cbrt(double x);
// Radians. Beyond a million the error of reducing by a rounded 2 pi shows: 1e-7 at 1e9.
double sin(double x);
double cos(double x);
double atan(double x);
double atan2(double y, double x);
// Relative error < 1e-15.
double expm1(double x);
double tan(double x);
double asin(double x);
double acos(double x);
// Relative error < 2e-15.
double sinh(double x);
double erf(double x);
// Relative error < 1e-12.
double erfc(double x);
// sqrt(x^2 + y^2). |x|, |y| below 1e150; what is below 1e-150 may be taken for 0.
double hypot(double x, double y);
double hypot(double x, double y, double z);

struct SinCos {
    double sin, cos;
};
// Of an angle that is so many right angles larger.
SinCos turned(const SinCos& of, int quarter);
// Of an angle in degrees; multiples of 90 give exactly 0 and +-1. As seeded_sin it stays as it is.
SinCos sincos_degrees(double degrees);

// What particles of a seed are made with, older and rougher than sin and exp: whoever changed a bit of these would
// change everybody's clouds. Absolute error < 1e-12 for |x| < 1e3; e^x for x <= 0, 0 below -700, relative error
// < 2e-14.
double seeded_sin(double x);
double seeded_exp(double x);

// clang-format off
inline float exp(float x) { return static_cast<float>(exp(static_cast<double>(x))); }
inline float exp2(float x) { return static_cast<float>(exp2(static_cast<double>(x))); }
inline float expm1(float x) { return static_cast<float>(expm1(static_cast<double>(x))); }
inline float log(float x) { return static_cast<float>(log(static_cast<double>(x))); }
inline float log2(float x) { return static_cast<float>(log2(static_cast<double>(x))); }
inline float log1p(float x) { return static_cast<float>(log1p(static_cast<double>(x))); }
inline float sin(float x) { return static_cast<float>(sin(static_cast<double>(x))); }
inline float cos(float x) { return static_cast<float>(cos(static_cast<double>(x))); }
inline float tan(float x) { return static_cast<float>(tan(static_cast<double>(x))); }
inline float asin(float x) { return static_cast<float>(asin(static_cast<double>(x))); }
inline float acos(float x) { return static_cast<float>(acos(static_cast<double>(x))); }
inline float atan(float x) { return static_cast<float>(atan(static_cast<double>(x))); }
inline float cbrt(float x) { return static_cast<float>(cbrt(static_cast<double>(x))); }
// clang-format on
inline float pow(float x, float y) {
    return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
}
inline float atan2(float y, float x) {
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float hypot(float x, float y) {
    return static_cast<float>(hypot(static_cast<double>(x), static_cast<double>(y)));
}

// Of two kinds of numbers, or of integers: as doubles.
template <typename A, typename B>
requires(std::is_arithmetic_v<A>&& std::is_arithmetic_v<B>) double pow(A x, B y) {
    return pow(static_cast<double>(x), static_cast<double>(y));
}
template <typename A, typename B>
requires(std::is_arithmetic_v<A>&& std::is_arithmetic_v<B>) double hypot(A x, B y) {
    return hypot(static_cast<double>(x), static_cast<double>(y));
}

}  // namespace awan::exact
