// Sixteen floats at a time, by GCC's vector extensions: element by element the same IEEE operations on every
// machine, whatever registers they take. Everything here must be inlined into functions that choose a target, hence
// always_inline.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/base/instruction_sets.h"

// Vectors are only ever passed between inlined functions: no ABI to worry about.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace awan::simd {

inline constexpr int kLanes = 16;
using Floats = float __attribute__((vector_size(64)));
using Ints = std::int32_t __attribute__((vector_size(64)));
using Bits = std::uint32_t __attribute__((vector_size(64)));

// The same number in every lane.
AWAN_INLINE Floats all(float x) {
    return Floats{} + x;
}
AWAN_INLINE Floats min(const Floats& a, const Floats& b) {
    return a < b ? a : b;
}
AWAN_INLINE Floats max(const Floats& a, const Floats& b) {
    return a > b ? a : b;
}
AWAN_INLINE Bits bits(const Floats& x) {
    return reinterpret_cast<const Bits&>(x);
}
AWAN_INLINE Floats floats(const Bits& x) {
    return reinterpret_cast<const Floats&>(x);
}
AWAN_INLINE Floats abs(const Floats& x) {
    return floats(bits(x) & 0x7fffffffu);
}

// Correctly rounded everywhere, so the same on every machine.
AWAN_INLINE Floats sqrt(const Floats& x) {
    float a[kLanes];
    std::memcpy(a, &x, sizeof a);
    for (float& value : a) value = __builtin_sqrtf(value);
    Floats root;
    std::memcpy(&root, a, sizeof root);
    return root;
}

}  // namespace awan::simd
