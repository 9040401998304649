// Compiles the file that AWAN_LANES_FILE names, after lanes.h, once for each instruction set, in a namespace of its name
// in awan::truth. Included where all that the file needs has been included; once in a source file.
#if defined(__x86_64__)

#pragma GCC push_options
#pragma GCC target("avx512f")
namespace awan::truth::avx512 {
namespace {
constexpr int kLanes = 16;
#include "core/truth/lanes.h"
AWAN_INLINE Floats sqrt(const Floats& x) {
    // Not plain _mm512_sqrt_ps: GCC 12 takes its unused operand for an uninitialised one.
    return Floats(_mm512_maskz_sqrt_ps(0xffff, __m512(x)));
}
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::avx512
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2")
namespace awan::truth::avx2 {
namespace {
constexpr int kLanes = 8;
#include "core/truth/lanes.h"
AWAN_INLINE Floats sqrt(const Floats& x) {
    return Floats(_mm256_sqrt_ps(__m256(x)));
}
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::avx2
#pragma GCC pop_options

#endif

namespace awan::truth::plain {
namespace {
constexpr int kLanes = 4;
#include "core/truth/lanes.h"
AWAN_INLINE Floats sqrt(const Floats& x) {
    return Floats{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}
#include "core/truth/lanes_light.h"
#include AWAN_LANES_FILE
}  // namespace
}  // namespace awan::truth::plain

#undef AWAN_LANES_FILE
