#include "core/base/float_runs.h"

#include <algorithm>
#include <cstring>

#include "core/base/instruction_sets.h"

namespace awan {
namespace {

AWAN_INLINE double dot_product_body(const float* a, const float* b, std::size_t count) {
    using Lanes = float __attribute__((vector_size(64)));
    constexpr std::size_t kLanes = 16, kRun = 1024;
    double sum = 0;
    for (std::size_t run = 0; run < count; run += kRun) {
        const std::size_t end = std::min(run + kRun, count);
        // Two sums that do not wait for each other.
        Lanes parts[2] = {};
        std::size_t i = run;
        for (; i + 2 * kLanes <= end; i += 2 * kLanes) {
            Lanes x[2], y[2];
            std::memcpy(x, a + i, sizeof x);
            std::memcpy(y, b + i, sizeof y);
            parts[0] += x[0] * y[0];
            parts[1] += x[1] * y[1];
        }
        parts[0] += parts[1];
        for (; i < end; ++i) parts[0][0] += a[i] * b[i];
        for (std::size_t l = 0; l < kLanes; ++l) sum += static_cast<double>(parts[0][l]);
    }
    return sum;
}

AWAN_INLINE void add_scaled_body(float* __restrict to, const float* __restrict from, float scale,
                                 std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) to[i] += scale * from[i];
}

// Four vectors at a time: `to` is read and written once for them.
AWAN_INLINE void add_four_body(float* __restrict to, const float* __restrict a,
                               const float* __restrict b, const float* __restrict c,
                               const float* __restrict d, const float* scale, std::size_t count) {
    const float s = scale[0], t = scale[1], u = scale[2], v = scale[3];
    for (std::size_t i = 0; i < count; ++i)
        to[i] = (((to[i] + s * a[i]) + t * b[i]) + u * c[i]) + v * d[i];
}
AWAN_KERNEL(void, add_four,
            (float* __restrict to, const float* __restrict a, const float* __restrict b,
             const float* __restrict c, const float* __restrict d, const float* scale,
             std::size_t count),
            (to, a, b, c, d, scale, count))

}  // namespace

AWAN_KERNEL(double, dot_product, (const float* a, const float* b, std::size_t count), (a, b, count))
AWAN_KERNEL(void, add_scaled,
            (float* __restrict to, const float* __restrict from, float scale, std::size_t count),
            (to, from, scale, count))

void add_scaled(float* to, const float* const* from, std::size_t at, const float* scale,
                std::size_t vectors, std::size_t count) {
    std::size_t v = 0;
    for (; v + 4 <= vectors; v += 4)
        add_four(to, from[v] + at, from[v + 1] + at, from[v + 2] + at, from[v + 3] + at, scale + v,
                 count);
    for (; v < vectors; ++v) add_scaled(to, from[v] + at, scale[v], count);
}

}  // namespace awan
