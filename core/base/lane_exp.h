// Exponentials of sixteen floats (float_lanes.h), the same to the last bit on every machine.
#pragma once

#include "core/base/float_lanes.h"

namespace awan::simd {

// exp(x); relative error < 4e-7 for |x| < 86, constant beyond. With x = n ln 2 + r, |r| <= ln 2 / 2 (Cody & Waite 1980,
// ln 2 in two parts), it is 2^n, made from the exponent's bits, times the Taylor series of exp(r).
AWAN_INLINE Floats exp(const Floats& at) {
    // 1.5 * 2^23: a sum with it is rounded to an integer.
    constexpr float kShift = 12582912.0f;
    const Floats x = min(max(at, all(-86.0f)), all(86.0f));
    const Floats shifted = x * 1.44269504f + kShift;
    const Floats n = shifted - kShift;
    const Floats r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    // Estrin's scheme: a shorter chain of dependent operations than Horner's.
    const Floats rr = r * r;
    const Floats p = ((1.0f + r) + rr * (0.5f + r * (1.0f / 6))) +
                     (rr * rr) * (((1.0f / 24) + r * (1.0f / 120)) + rr * (1.0f / 720));
    return floats(bits(p) + (bits(shifted) << 23));
}

// 1 - e for e = exp(-x), x >= 0: by the series of 1 - exp(-x) where the difference would lose its digits.
AWAN_INLINE Floats one_minus(const Floats& e, const Floats& x) {
    const Floats series = x * (1.0f - x * (0.5f - x * ((1.0f / 6) - x * (1.0f / 24))));
    return x < 0.03125f ? series : 1.0f - e;
}

}  // namespace awan::simd
