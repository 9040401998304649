// Functions of sixteen floats (core/base/float_lanes.h) that the march needs; inlined into march_targets.cpp.
#pragma once

#include "core/base/lane_exp.h"

namespace awan::simd {

// ln x for normal x > 0; absolute error < 1e-6 for x < 1e6. With x = 2^n m, 1 / sqrt 2 <= m < sqrt 2, and
// f = (m - 1) / (m + 1): ln x = n ln 2 + 2 artanh f, by the series of artanh.
AWAN_INLINE Floats log(const Floats& x) {
    const Bits b = bits(x) - 0x3f3504f3u;
    const Floats n = __builtin_convertvector(reinterpret_cast<const Ints&>(b) >> 23, Floats);
    const Floats m = floats((b & 0x007fffffu) + 0x3f3504f3u);
    const Floats f = (m - 1.0f) / (m + 1.0f), ff = f * f;
    const Floats series =
        1.0f + ff * ((1.0f / 3) + ff * ((1.0f / 5) + ff * ((1.0f / 7) + ff * (1.0f / 9))));
    return n * 0.693147181f + 2.0f * f * series;
}

// Cumulative normal distribution as in core/shaders/optics.glsl (Abramowitz & Stegun 7.1.26).
AWAN_INLINE Floats normal_cdf(const Floats& x) {
    const Floats z = abs(x) * 0.70710678f;
    const Floats t = 1.0f / (1.0f + 0.3275911f * z);
    const Floats tail =
        0.5f * exp(-z * z) * t *
        (0.254829592f +
         t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
    return x > 0.0f ? 1.0f - tail : tail;
}

AWAN_INLINE bool any(const Ints& mask) {
    std::int64_t words[8];
    std::memcpy(words, &mask, sizeof words);
    std::int64_t sum = 0;
    for (const std::int64_t word : words) sum |= word;
    return sum != 0;
}
// The largest of the sixteen, by halves: four comparisons after each other.
using Eight = float __attribute__((vector_size(32)));
using Four = float __attribute__((vector_size(16)));
AWAN_INLINE float largest(const Floats& x) {
    Eight a[2];
    std::memcpy(a, &x, sizeof a);
    a[0] = a[0] > a[1] ? a[0] : a[1];
    Four b[2];
    std::memcpy(b, a, sizeof b);
    b[0] = b[0] > b[1] ? b[0] : b[1];
    const float c = b[0][0] > b[0][2] ? b[0][0] : b[0][2];
    const float d = b[0][1] > b[0][3] ? b[0][1] : b[0][3];
    return c > d ? c : d;
}
AWAN_INLINE float smallest(const Floats& x) {
    return -largest(-x);
}

}  // namespace awan::simd
