// Linear systems by GMRES (Saad & Schultz 1986), restarted, for operators that are only known by what they do.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace awan {

struct GmresSettings {
    double tolerance = 1e-3;  // |b - A x| / |b|
    int max_products = 40;    // of A with a vector
    int restart = 16;         // vectors kept
};

struct GmresOutcome {
    int products = 0;
    double residual = 0;  // |b - A x| / |b|; 0 when b is 0
};

// A: to = A (from + addition), `addition` as a preconditioner makes it; EMPTY: 0. May fail (deadline); the failure is
// passed on.
using Product = std::function<Status(std::span<const float> from, std::span<const float> addition,
                                     std::span<float> to)>;

// A preconditioner that changes a vector by adding to it: one number for every `every` floats, to the first of each
// group. It may differ from call to call, as an inner iteration does: what it added is kept ("flexible" GMRES, Saad
// 1993).
struct Preconditioner {
    std::size_t every = 1;
    // Empty: nothing is added.
    std::function<void(std::span<const float> vector, std::span<float> addition)> add;
};

// Solves A x = b from the x that is given, or from 0 where that is nearer. The residual never grows from product to
// product: when a limit ends the solve, x is the best so far. Sums are made in blocks of fixed size: the same bytes for
// every number of threads. Memory: (restart + 4) vectors and as many additions. Errors: those of A.
Result<GmresOutcome> gmres(const Product& product, const Preconditioner& preconditioner,
                           std::span<const float> b, const GmresSettings& settings, int threads,
                           std::span<float> x);

}  // namespace awan
