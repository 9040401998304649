// Sums over runs of floats, on the processor's vectors.
#pragma once

#include <cstddef>

namespace awan {

// Sum of a[i] b[i]. float32 within runs of 1024, double between them: relative error < 1e-5 of the sum of sizes. The
// order is fixed: the same bytes on every machine.
double dot_product(const float* a, const float* b, std::size_t count);

// to[i] += scale * from[i]; the two do not overlap.
void add_scaled(float* to, const float* from, float scale, std::size_t count);

// to[i] += sum of scale[v] * from[v][i + at], v = 0..vectors-1, added in this order; none overlaps `to`.
void add_scaled(float* to, const float* const* from, std::size_t at, const float* scale,
                std::size_t vectors, std::size_t count);

}  // namespace awan
