#include "core/scene/mie.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Directions that are summed side by side.
constexpr std::size_t kBlock = 64;

double weight(std::size_t n) {
    const auto l = static_cast<double>(n);
    return (2 * l + 1) / (l * (l + 1));
}

// The logarithmic derivatives D_n(z) of psi, n = 0..count, downwards, the way that is stable.
std::vector<double> logarithmic_derivatives(double z, std::size_t count) {
    const std::size_t from = std::max(count, static_cast<std::size_t>(z)) + 16;
    std::vector<double> d(from + 1, 0.0);
    for (std::size_t n = from; n > 0; --n) {
        const double per = static_cast<double>(n) / z;
        d[n - 1] = per - 1 / (d[n] + per);
    }
    d.resize(count + 1);
    return d;
}

}  // namespace

// With the Riccati-Bessel functions psi_n and xi_n = psi_n - i chi_n,
//     a_n = ((D_n(m x) / m + n / x) psi_n - psi_(n-1)) / ((D_n(m x) / m + n / x) xi_n - xi_(n-1)),
//     b_n the same with m D_n for D_n / m.
// All but the i of xi is real here: a_n = p / (p - i q).
MieSeries mie_series(double x, double index) {
    const auto terms = static_cast<std::size_t>(x + 4 * exact::cbrt(x) + 2.5);
    const std::vector<double> d = logarithmic_derivatives(index * x, terms);
    MieSeries series{x, {}, {}};
    double psi_before = exact::cos(x), psi = exact::sin(x);
    double chi_before = -exact::sin(x), chi = exact::cos(x);
    for (std::size_t n = 1; n <= terms; ++n) {
        const double per = static_cast<double>(n) / x;
        const double psi_next = (2 * per - 1 / x) * psi - psi_before;
        const double chi_next = (2 * per - 1 / x) * chi - chi_before;
        const auto coefficient = [&](double factor) {
            const double p = factor * psi_next - psi, q = factor * chi_next - chi;
            return std::complex<double>(p * p, p * q) / (p * p + q * q);
        };
        series.a.push_back(coefficient(d[n] / index + per));
        series.b.push_back(coefficient(d[n] * index + per));
        psi_before = psi;
        psi = psi_next;
        chi_before = chi;
        chi = chi_next;
    }
    return series;
}

MieEfficiencies mie_efficiencies(const MieSeries& series) {
    double all = 0, forward = 0;
    std::complex<double> back = 0;
    for (std::size_t i = 0; i < series.a.size(); ++i) {
        const auto n = static_cast<double>(i + 1);
        const std::complex<double> a = series.a[i], b = series.b[i];
        all += (2 * n + 1) * (std::norm(a) + std::norm(b));
        back += (i % 2 == 0 ? -1.0 : 1.0) * (2 * n + 1) * (a - b);
        forward += weight(i + 1) * std::real(a * std::conj(b));
        if (i + 1 < series.a.size())
            forward += n * (n + 2) / (n + 1) *
                       std::real(a * std::conj(series.a[i + 1]) + b * std::conj(series.b[i + 1]));
    }
    const double xx = series.x * series.x;
    return {2 * all / xx, std::norm(back) / xx, 2 * forward / all};
}

// S1 + S2 = sum of c_n (a_n + b_n) (pi_n + tau_n), S1 - S2 = sum of c_n (a_n - b_n) (pi_n - tau_n), with the angular
// functions pi_n and tau_n of Bohren & Huffman (4.47). At the opposite cosine pi_n has the sign (-1)^(n-1), tau_n the
// other, so both directions have the same sums with other signs.
void add_intensities(const MieSeries& series, double share, std::span<const double> less,
                     std::span<double> ahead, std::span<double> behind) {
    for (std::size_t from = 0; from < less.size(); from += kBlock) {
        const std::size_t count = std::min(kBlock, less.size() - from);
        double mu[kBlock] = {}, before[kBlock] = {}, now[kBlock];
        for (std::size_t i = 0; i < count; ++i) mu[i] = 1 - less[from + i];
        std::fill_n(now, kBlock, 1.0);
        // Real and imaginary parts: of S1 + S2 and S1 - S2 ahead, then behind.
        double s[8][kBlock] = {};
        for (std::size_t n = 1; n <= series.a.size(); ++n) {
            const double c = weight(n), sign = n % 2 == 1 ? 1 : -1;
            const std::complex<double> sum = c * (series.a[n - 1] + series.b[n - 1]);
            const std::complex<double> rest = c * (series.a[n - 1] - series.b[n - 1]);
            const double sr = sum.real(), si = sum.imag(), rr = rest.real(), ri = rest.imag();
            const auto l = static_cast<double>(n);
            for (std::size_t i = 0; i < kBlock; ++i) {
                const double tau = l * mu[i] * now[i] - (l + 1) * before[i];
                const double u = now[i] + tau, v = now[i] - tau;
                s[0][i] += sr * u;
                s[1][i] += si * u;
                s[2][i] += rr * v;
                s[3][i] += ri * v;
                s[4][i] += sign * sr * v;
                s[5][i] += sign * si * v;
                s[6][i] += sign * rr * u;
                s[7][i] += sign * ri * u;
                const double next = ((2 * l + 1) * mu[i] * now[i] - (l + 1) * before[i]) * (1 / l);
                before[i] = now[i];
                now[i] = next;
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            double squares[2] = {};
            for (int part = 0; part < 8; ++part) squares[part / 4] += s[part][i] * s[part][i];
            ahead[from + i] += 0.5 * share * squares[0];
            behind[from + i] += 0.5 * share * squares[1];
        }
    }
}

}  // namespace awan
