// Sixteen points at a time (core/base/float_lanes.h). All of it is inlined into functions that choose a target
// (field.cpp).
#pragma once

#include "core/base/float_lanes.h"

namespace awan::implicit::lanes {

inline constexpr int kCount = simd::kLanes;
using simd::abs;
using simd::all;
using simd::Bits;
using simd::bits;
using simd::Floats;
using simd::floats;
using simd::Ints;
using simd::max;
using simd::min;
using simd::sqrt;

struct Vec {
    Floats x, y, z;
};

AWAN_INLINE Floats clamp(const Floats& x, float low, float high) {
    return min(max(x, all(low)), all(high));
}

// The largest integer <= x, |x| < 2^31.
AWAN_INLINE Ints floor_int(const Floats& x) {
    const Ints i = __builtin_convertvector(x, Ints);
    // The conversion rounds towards 0; a true comparison is -1.
    return i + (__builtin_convertvector(i, Floats) > x);
}
AWAN_INLINE Floats to_floats(const Ints& i) {
    return __builtin_convertvector(i, Floats);
}

// sin(2 pi x), |x| < 2^22. Absolute error < 3e-6: the Taylor series to the 11th power on a quarter turn.
AWAN_INLINE Floats sin_turns(const Floats& x) {
    // The part of a turn, -.5 .. .5.
    Floats r = x - to_floats(floor_int(x + 0.5f));
    r = r > 0.25f ? 0.5f - r : r;
    r = r < -0.25f ? -0.5f - r : r;
    const Floats a = r * 6.28318531f, s = a * a;
    return a * (1.0f + s * (-1.0f / 6 +
                            s * (1.0f / 120 + s * (-1.0f / 5040 +
                                                   s * (1.0f / 362880 - s * (1.0f / 39916800))))));
}

// log2(x), x a normal number > 0. Absolute error < 1e-6: exponent, and the mantissa's logarithm by the series of
// atanh.
AWAN_INLINE Floats log2(const Floats& x) {
    // The mantissa from sqrt(1/2) to sqrt(2).
    const Bits shifted = bits(x) - 0x3f3504f3u;
    const Ints exponent = reinterpret_cast<const Ints&>(shifted) >> 23;
    const Floats m = floats((shifted & 0x007fffffu) + 0x3f3504f3u);
    const Floats z = (m - 1.0f) / (m + 1.0f), s = z * z;
    const Floats series =
        z * (1.0f + s * (1.0f / 3 + s * (1.0f / 5 + s * (1.0f / 7 + s * (1.0f / 9)))));
    // The factor is 2 / ln 2.
    return to_floats(exponent) + series * 2.88539008f;
}

// 2^x, x from -126 to 126. Relative error < 1e-6.
AWAN_INLINE Floats exp2(const Floats& x) {
    const Ints n = floor_int(x + 0.5f);
    const Floats r = (x - to_floats(n)) * 0.693147181f;
    const Floats p =
        1.0f +
        r * (1.0f +
             r * (0.5f + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
    const Ints scale = (n + 127) << 23;
    return p * floats(reinterpret_cast<const Bits&>(scale));
}

// x^power; 0 for x < 1e-30, at most 2^10. Relative error < 1e-5 for powers up to 8.
AWAN_INLINE Floats power(const Floats& x, float exponent) {
    const Floats log = log2(max(x, all(1e-30f))) * exponent;
    const Floats y = exp2(clamp(log, -126.0f, 10.0f));
    return x < 1e-30f ? Floats{} : y;
}

}  // namespace awan::implicit::lanes

namespace awan::implicit {

// 0 at t <= 0, 1 at t >= 1, level at both: ease-in and ease-out.
inline double smoothstep(double t) {
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

}  // namespace awan::implicit
