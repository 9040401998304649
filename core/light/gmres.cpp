#include "core/light/gmres.h"

#include <algorithm>
#include <cmath>

#include "core/base/aligned_floats.h"
#include "core/base/exact_math.h"
#include "core/base/float_runs.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

// Floats of a block: one block of every vector of the basis stays in a processor's near cache.
constexpr std::size_t kBlock = 4096;

using Vector = AlignedFloats;

std::size_t blocks_of(std::size_t size) {
    return (size + kBlock - 1) / kBlock;
}

double sum_of(const std::vector<double>& parts) {
    double sum = 0;
    for (const double part : parts) sum += part;
    return sum;
}

// Dot products of `w` with the first `count` vectors of the basis and with itself (last).
std::vector<double> dots(const std::vector<Vector>& basis, std::size_t count, const Vector& w,
                         int threads) {
    const std::size_t blocks = blocks_of(w.size());
    std::vector<double> parts(blocks * (count + 1));
    parallel_for(threads, blocks, [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, w.size() - at);
        double* to = parts.data() + block * (count + 1);
        for (std::size_t v = 0; v < count; ++v)
            to[v] = dot_product(basis[v].data() + at, w.data() + at, n);
        to[count] = dot_product(w.data() + at, w.data() + at, n);
    });
    std::vector<double> sums(count + 1);
    for (std::size_t block = 0; block < blocks; ++block)
        for (std::size_t v = 0; v <= count; ++v) sums[v] += parts[block * (count + 1) + v];
    return sums;
}

// to += sum of scale[v] * basis[v]; the length of what it becomes.
double add(const std::vector<Vector>& basis, const std::vector<double>& scale, int threads,
           std::span<float> to) {
    const std::vector<float> scales(scale.begin(), scale.end());
    std::vector<const float*> vectors;
    for (const Vector& one : basis) vectors.push_back(one.data());
    std::vector<double> squares(blocks_of(to.size()));
    parallel_for(threads, squares.size(), [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, to.size() - at);
        add_scaled(to.data() + at, vectors.data(), at, scales.data(), scales.size(), n);
        squares[block] = dot_product(to.data() + at, to.data() + at, n);
    });
    return std::sqrt(sum_of(squares));
}

double norm(const Vector& v, int threads) {
    return std::sqrt(dots({}, 0, v, threads)[0]);
}

void divide(Vector& vector, double by, int threads) {
    const auto scale = static_cast<float>(1 / by);
    parallel_for(threads, blocks_of(vector.size()), [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, vector.size() - at);
        for (std::size_t i = at; i < at + n; ++i) vector[i] *= scale;
    });
}

// One Givens rotation, kept to be used on later columns.
struct Rotation {
    double c = 1, s = 0;
    void turn(double& a, double& b) const {
        const double t = c * a + s * b;
        b = c * b - s * a;
        a = t;
    }
};

Rotation rotation_that_clears(double a, double b) {
    const double length = exact::hypot(a, b);
    return length > 0 ? Rotation{a / length, b / length} : Rotation{};
}

// The vectors that x is sought among since the last restart, and what A makes of them: with V the basis and P the
// preconditioner, A P V = V H, and H is kept as Q R, Q made of rotations and R triangular.
struct KrylovSpace {
    std::vector<Vector> basis;                 // orthonormal; one more than columns
    std::vector<Vector> additions;             // what the preconditioner adds to each but the last
    std::vector<std::vector<double>> columns;  // of R
    std::vector<Rotation> rotations;           // Q
    std::vector<double> right;                 // the residual in this basis, turned by Q
};

KrylovSpace space_from(const Vector& residual, double length, int threads) {
    KrylovSpace space;
    space.basis.push_back(residual);
    divide(space.basis.front(), length, threads);
    space.right.push_back(length);
    return space;
}

// One more vector, by one product with A. False: it lies in the space already, which can grow no further.
Result<bool> grow(const Product& product, const Preconditioner& preconditioner, int threads,
                  KrylovSpace& space) {
    const std::size_t k = space.columns.size();
    const std::size_t size = space.basis.back().size();
    if (preconditioner.add) {
        space.additions.emplace_back(size / preconditioner.every);
        preconditioner.add(space.basis.back(), space.additions.back());
    }
    Vector w(size);
    const std::span<const float> addition = preconditioner.add
                                                ? std::span<const float>(space.additions.back())
                                                : std::span<const float>();
    if (auto error = product(space.basis.back(), addition, w)) return *error;
    // Classical Gram-Schmidt: one pass over memory. With so few vectors there is no need for a second.
    std::vector<double> column = dots(space.basis, k + 1, w, threads);
    const double before = std::sqrt(column.back());
    column.pop_back();
    std::vector<double> minus(column);
    for (double& value : minus) value = -value;
    const double length = add(space.basis, minus, threads, w);
    column.push_back(length);
    if (length > 0) divide(w, length, threads);
    space.basis.push_back(std::move(w));
    for (std::size_t i = 0; i < k; ++i) space.rotations[i].turn(column[i], column[i + 1]);
    space.rotations.push_back(rotation_that_clears(column[k], column[k + 1]));
    space.rotations[k].turn(column[k], column[k + 1]);
    space.right.push_back(0);
    space.rotations[k].turn(space.right[k], space.right[k + 1]);
    space.columns.push_back(std::move(column));
    return length > 1e-6 * before;
}

// Solves R y = right from the bottom up.
std::vector<double> solve_triangle(const KrylovSpace& space) {
    std::vector<double> y(space.columns.size());
    for (std::size_t i = space.columns.size(); i-- > 0;) {
        double value = space.right[i];
        for (std::size_t j = i + 1; j < space.columns.size(); ++j)
            value -= space.columns[j][i] * y[j];
        y[i] = space.columns[i][i] != 0 ? value / space.columns[i][i] : 0;
    }
    return y;
}

// x += P V y: the best that the space holds.
void take_best(const KrylovSpace& space, std::size_t every, int threads, std::span<float> x) {
    const std::vector<double> y = solve_triangle(space);
    add(space.basis, y, threads, x);
    for (std::size_t v = 0; v < space.additions.size() && v < y.size(); ++v)
        for (std::size_t i = 0; i < space.additions[v].size(); ++i)
            x[i * every] += static_cast<float>(y[v]) * space.additions[v][i];
}

// residual = b - A x. Its length.
Result<double> residual_of(const Product& product, std::span<const float> b,
                           std::span<const float> x, int threads, Vector& residual) {
    if (auto error = product(x, {}, residual)) return *error;
    std::vector<double> squares(blocks_of(b.size()));
    parallel_for(threads, squares.size(), [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, b.size() - at);
        for (std::size_t i = at; i < at + n; ++i) residual[i] = b[i] - residual[i];
        squares[block] = dot_product(residual.data() + at, residual.data() + at, n);
    });
    return std::sqrt(sum_of(squares));
}

struct Begun {
    double left;   // |b - A x|
    int products;  // of A, to know it
};

// residual = b - A x, or b and x = 0 where x is no better than that. `whole`: |b|. A guess that is not finite counts as
// no better.
Result<Begun> residual_of_guess(const Product& product, std::span<const float> b, double whole,
                                int threads, std::span<float> x, Vector& residual) {
    if (std::all_of(x.begin(), x.end(), [](float value) { return value == 0; }))
        return Begun{whole, 0};
    const auto left = residual_of(product, b, x, threads, residual);
    if (!left.ok()) return left.error();
    if (*left < whole) return Begun{*left, 1};
    std::fill(x.begin(), x.end(), 0.F);
    std::copy(b.begin(), b.end(), residual.begin());
    return Begun{whole, 1};
}

}  // namespace

Result<GmresOutcome> gmres(const Product& product, const Preconditioner& preconditioner,
                           std::span<const float> b, const GmresSettings& settings, int threads,
                           std::span<float> x) {
    GmresOutcome outcome;
    Vector residual(b.begin(), b.end());
    const double whole = norm(residual, threads);
    if (!(whole > 0) || !std::isfinite(whole)) {
        std::fill(x.begin(), x.end(), 0.F);
        return outcome;
    }
    auto begun = residual_of_guess(product, b, whole, threads, x, residual);
    if (!begun.ok()) return begun.error();
    double left = begun->left;
    outcome.products = begun->products;
    const auto most = static_cast<std::size_t>(std::max(settings.restart, 1));
    const auto goes_on = [&] {
        return left > settings.tolerance * whole && outcome.products < settings.max_products;
    };
    while (goes_on()) {
        const double at_start = left;
        KrylovSpace space = space_from(residual, left, threads);
        for (bool grows = true; grows && space.columns.size() < most && goes_on();) {
            const auto grown = grow(product, preconditioner, threads, space);
            if (!grown.ok()) return grown.error();
            ++outcome.products;
            grows = *grown;
            left = std::abs(space.right.back());
        }
        take_best(space, preconditioner.every, threads, x);
        if (!goes_on()) break;
        // The true residual before a restart, not the recurrence's: float32 vectors are not quite orthogonal.
        const auto true_left = residual_of(product, b, x, threads, residual);
        if (!true_left.ok()) return true_left.error();
        ++outcome.products;
        left = *true_left;
        // Less than a thousandth was gained: rounding is all that is left.
        if (!(left < 0.999 * at_start)) break;
    }
    outcome.residual = left / whole;
    return outcome;
}

}  // namespace awan
