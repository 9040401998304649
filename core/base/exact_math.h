// Sines and powers of e that are the same to the last bit everywhere. A library's may round differently from one
// machine to the next; these are polynomials in plain IEEE double arithmetic (the compiler may not contract it, see
// CMakeLists.txt).
#pragma once

namespace awan {

// sin(x), x in radians, any finite x. Absolute error < 1e-12 for |x| < 1e3; for larger x the error
// of reducing by a rounded 2 pi grows in proportion (1e-7 at 1e9), which a pseudo-random phase does
// not notice.
double exact_sin(double x);

struct SinCos {
    double sin, cos;
};
// Sine and cosine of an angle in degrees; multiples of 90 give exactly 0 and +-1. Absolute error < 1e-15.
SinCos exact_sincos_degrees(double degrees);

// e^x for x <= 0; 0 below -700. Relative error < 1e-14.
double exact_exp(double x);

}  // namespace awan
