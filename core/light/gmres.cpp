#include "core/light/gmres.h"

#include <algorithm>
#include <cmath>

#include "core/base/float_runs.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

constexpr std::size_t kBlock = 4096;  // floats: one block of every vector stays in the first cache

using Vector = std::vector<float>;

std::size_t blocks_of(std::size_t size) {
    return (size + kBlock - 1) / kBlock;
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

// to += sum of scale[v] * basis[v].
void add(const std::vector<Vector>& basis, const std::vector<double>& scale, int threads,
         std::span<float> to) {
    parallel_for(threads, blocks_of(to.size()), [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, to.size() - at);
        for (std::size_t v = 0; v < scale.size(); ++v)
            add_scaled(to.data() + at, basis[v].data() + at, static_cast<float>(scale[v]), n);
    });
}

double norm(const Vector& v, int threads) {
    return std::sqrt(dots({}, 0, v, threads)[0]);
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
    const double length = std::hypot(a, b);
    return length > 0 ? Rotation{a / length, b / length} : Rotation{};
}

}  // namespace

Result<GmresOutcome> gmres(const Product& product, const Preconditioner& preconditioner,
                           std::span<const float> b, const GmresSettings& settings, int threads,
                           std::span<float> x) {
    GmresOutcome outcome;
    std::fill(x.begin(), x.end(), 0.F);
    Vector residual(b.begin(), b.end());
    const double whole = norm(residual, threads);
    double left = whole;
    if (!(whole > 0) || !std::isfinite(whole)) return outcome;
    const auto most = static_cast<std::size_t>(std::max(settings.restart, 1));
    std::vector<Vector> basis, additions;
    const std::size_t every = preconditioner.every;
    Vector changed;
    while (left > settings.tolerance * whole && outcome.products < settings.max_products) {
        basis.assign(1, residual);
        additions.clear();
        for (float& value : basis[0]) value = static_cast<float>(static_cast<double>(value) / left);
        std::vector<std::vector<double>> columns;  // of the triangular factor
        std::vector<Rotation> rotations;
        std::vector<double> right{left};
        const double at_start = left;
        while (columns.size() < most && left > settings.tolerance * whole &&
               outcome.products < settings.max_products) {
            const std::size_t k = columns.size();
            basis.emplace_back(b.size());
            Vector& w = basis.back();
            std::span<const float> from = basis[k];
            if (preconditioner.add) {
                additions.emplace_back(b.size() / every);
                preconditioner.add(basis[k], additions[k]);
                changed = basis[k];
                for (std::size_t i = 0; i < additions[k].size(); ++i)
                    changed[i * every] += additions[k][i];
                from = changed;
            }
            if (auto error = product(from, w)) return *error;
            ++outcome.products;
            // Classical Gram-Schmidt: one pass over memory; 16 vectors do not ask for a second.
            std::vector<double> column = dots(basis, k + 1, w, threads);
            const double before = std::sqrt(column.back());
            column.pop_back();
            std::vector<double> minus(column);
            for (double& value : minus) value = -value;
            add(basis, minus, threads, w);
            const double length = norm(w, threads);
            column.push_back(length);
            if (length > 0)
                for (float& value : w)
                    value = static_cast<float>(static_cast<double>(value) / length);
            for (std::size_t i = 0; i < k; ++i) rotations[i].turn(column[i], column[i + 1]);
            rotations.push_back(rotation_that_clears(column[k], column[k + 1]));
            rotations[k].turn(column[k], column[k + 1]);
            right.push_back(0);
            rotations[k].turn(right[k], right[k + 1]);
            columns.push_back(column);
            left = std::abs(right[k + 1]);
            if (!(length > 1e-6 * before)) break;  // the space is exhausted
        }
        std::vector<double> y(columns.size());
        for (std::size_t i = columns.size(); i-- > 0;) {
            double value = right[i];
            for (std::size_t j = i + 1; j < columns.size(); ++j) value -= columns[j][i] * y[j];
            y[i] = columns[i][i] != 0 ? value / columns[i][i] : 0;
        }
        add(basis, y, threads, x);
        for (std::size_t v = 0; v < additions.size() && v < y.size(); ++v)
            for (std::size_t i = 0; i < additions[v].size(); ++i)
                x[i * every] += static_cast<float>(y[v]) * additions[v][i];
        if (left <= settings.tolerance * whole || outcome.products >= settings.max_products) break;
        // The true residual, not the recurrence's: float32 vectors are not quite orthogonal.
        Vector product_of_x(b.size());
        if (auto error = product(x, product_of_x)) return *error;
        ++outcome.products;
        for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i] - product_of_x[i];
        left = norm(residual, threads);
        if (!(left < 0.999 * at_start)) break;  // rounding is all that is left
    }
    outcome.residual = left / whole;
    return outcome;
}

}  // namespace awan
