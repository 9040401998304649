// Compiles the file that AWAN_LANES_FILE names, after lanes.h, once for each instruction set, in a namespace of that
// name. Included where all that the file needs has been included; once in a source file.

// What differs: how many lanes go at a time, square roots (correctly rounded in all), and the lanes of a mask, all bits
// or none set in each, as bits.
#define AWAN_LANE_TYPES(count)                                         \
    constexpr int kLanes = count;                                      \
    using Floats = float __attribute__((vector_size(4 * count)));      \
    using Ints = std::int32_t __attribute__((vector_size(4 * count))); \
    using Bits = std::uint32_t __attribute__((vector_size(4 * count)));

#if defined(__x86_64__) && !defined(__clang__)

#pragma GCC push_options
#pragma GCC target("avx512f")
namespace awan::truth::avx512 {
namespace {
AWAN_LANE_TYPES(16)
AWAN_INLINE Floats sqrt(const Floats& x) {
    // Not plain _mm512_sqrt_ps: GCC 12 takes its unused operand for an uninitialised one.
    return Floats(_mm512_maskz_sqrt_ps(0xffff, __m512(x)));
}
AWAN_INLINE std::uint32_t lanes_of(const Ints& mask) {
    return _mm512_test_epi32_mask(__m512i(mask), __m512i(mask));
}
#include "core/truth/lanes.h"
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::avx512
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2")
namespace awan::truth::avx2 {
namespace {
AWAN_LANE_TYPES(8)
AWAN_INLINE Floats sqrt(const Floats& x) {
    return Floats(_mm256_sqrt_ps(__m256(x)));
}
AWAN_INLINE std::uint32_t lanes_of(const Ints& mask) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(__m256(mask)));
}
#include "core/truth/lanes.h"
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::avx2
#pragma GCC pop_options

#endif

namespace awan::truth::plain {
namespace {
AWAN_LANE_TYPES(4)
AWAN_INLINE Floats sqrt(const Floats& x) {
    return Floats{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}
AWAN_INLINE std::uint32_t lanes_of(const Ints& mask) {
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < kLanes; ++lane)
        lanes |= static_cast<std::uint32_t>(mask[lane] & 1 << lane);
    return lanes;
}
#include "core/truth/lanes.h"
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::plain

#undef AWAN_LANE_TYPES
#undef AWAN_LANES_FILE
