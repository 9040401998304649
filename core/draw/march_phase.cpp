#include "core/draw/march_phase.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/light/legendre.h"

namespace awan {
namespace {

constexpr double kPer4Pi = 1 / (4 * std::numbers::pi);
constexpr int kMostTerms = 4096;  // of a Legendre sum
// Between rows, of asinh(chord / fold): a steep phase function falls as exp(-3 asinh).
constexpr double kRowStep = 0.012;
// Up to this depth G is summed over orders of scattering, beyond over Legendre moments.
constexpr double kSeriesDepth = 32;
constexpr double kNegligible = 1e-6;  // a term of a sum of about 1
constexpr int kMostOctaves = 13;

double pow_int(double x, int n) {
    return exact::pow(x, static_cast<double>(n));
}

double henyey_greenstein(double g, double ahead, double behind) {
    const double chord = g >= 0 ? ahead : behind, rest = 1 - std::abs(g);
    const double base = rest * rest + std::abs(g) * chord * chord;
    return rest * (1 + std::abs(g)) / (base * std::sqrt(base));
}

double cosine_of(double ahead) {
    return 1 - ahead * ahead / 2;
}

// P_0..P_n at mu.
void legendre(double mu, std::vector<double>& p) {
    p[0] = 1;
    if (p.size() > 1) p[1] = mu;
    for (std::size_t l = 2; l < p.size(); ++l) {
        const auto n = static_cast<double>(l);
        p[l] = ((2 * n - 1) * mu * p[l - 1] - (n - 1) * p[l - 2]) / n;
    }
}

// Whether sums of powers of the moments are a phase function again.
bool has_closed_powers(const Medium& medium) {
    return medium.phase == PhaseFunction::kHenyeyGreenstein;
}

// What of G depends on the medium and not on the angle.
// Up to kSeriesDepth, n + 1 times scattered by the peak:
//     G = low + sum over n of exp(-a f t) (a t)^n / n! * (sum over l > L of (2 l + 1) / 4 pi chi_l^(n+1) P_l),
// low the sum over l <= L; beyond it the sum over moments as it stands in march_phase.h.
struct Sums {
    std::vector<double> weight;               // (2l + 1) / 4 pi
    std::vector<double> chi;                  // moments, as many as matter
    std::vector<float> depths;                // t of the columns
    std::vector<std::vector<double>> orders;  // [column][n]: exp(-a f t) (a t)^n / n!
    // [column][l]: weight chi exp(-a t (f - chi)), in columns beyond kSeriesDepth; EMPTY in the others.
    std::vector<std::vector<double>> terms;
    std::size_t most_orders = 0;
    // [n][l]: weight chi^(n+1), l > L, as many as matter; EMPTY where the sum is known in closed form.
    std::vector<std::vector<double>> powers;
};

Sums sums_of(const Medium& medium, const Peak& peak, int columns) {
    Sums sums;
    const double a = medium.albedo, f = peak.share;
    const int most =
        medium.droplets ? static_cast<int>(medium.droplets->moment.size()) - 1
        : medium.g == 0
            ? 4
            : std::min(kMostTerms, static_cast<int>(20 / -exact::log(std::abs(medium.g))) + 8);
    for (int l = 0; l <= std::max(most, peak.from); ++l) {
        sums.weight.push_back((2 * l + 1) * kPer4Pi);
        sums.chi.push_back(phase_moment(medium, l));
    }
    sums.orders.resize(static_cast<std::size_t>(columns));
    sums.terms.resize(static_cast<std::size_t>(columns));
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
        const auto step = static_cast<std::uint32_t>(k) << 20;
        const float t = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0f) + step) - 1.0f;
        sums.depths.push_back(t);
        const double at = a * static_cast<double>(t);
        if (static_cast<double>(t) <= kSeriesDepth) {
            double term = exact::exp(-f * at);
            for (int n = 0; n < 200; ++n) {
                sums.orders[k].push_back(term);
                term *= at / (n + 1);
                if (n > at && term < 1e-9) break;
            }
            sums.most_orders = std::max(sums.most_orders, sums.orders[k].size());
            continue;
        }
        for (std::size_t l = 0; l < sums.chi.size(); ++l) {
            const bool low = static_cast<int>(l) < peak.from;
            const double chi = low ? f : sums.chi[l];
            const double term =
                sums.weight[l] * chi * (low ? 1 : exact::exp(-at * (f - sums.chi[l])));
            if (!low && std::abs(term) < kNegligible) break;
            sums.terms[k].push_back(term);
        }
    }
    sums.powers.resize(sums.most_orders);
    for (std::size_t n = 1; n < sums.most_orders && !has_closed_powers(medium); ++n)
        for (auto l = static_cast<std::size_t>(peak.from); l < sums.chi.size(); ++l) {
            sums.powers[n].push_back(sums.weight[l] *
                                     pow_int(sums.chi[l], static_cast<int>(n) + 1));
            if (std::abs(sums.powers[n].back()) < 1e-9) break;
        }
    return sums;
}

// Light that the peak has scattered n + 1 times: sum over l > L of weight chi^(n+1) P_l. For Henyey-Greenstein
// chi_l^(n+1) is (g^(n+1))^l: the whole sum is the phase function with g^(n+1) for g, less the orders up to L.
double peak_order(const Medium& medium, const Peak& peak, const Sums& sums,
                  const std::vector<double>& p, int n, double ahead, double behind) {
    const bool closed = n == 0 || has_closed_powers(medium);
    double sum = 0;
    if (closed) {
        sum = n == 0 ? phase_of_chords(medium, ahead, behind)
                     : kPer4Pi * henyey_greenstein(pow_int(medium.g, n + 1), ahead, behind);
        for (int l = 0; l < peak.from; ++l) {
            const auto i = static_cast<std::size_t>(l);
            sum -= sums.weight[i] * pow_int(sums.chi[i], n + 1) * p[i];
        }
        return sum;
    }
    const std::vector<double>& terms = sums.powers[static_cast<std::size_t>(n)];
    for (std::size_t i = 0; i < terms.size(); ++i)
        sum += terms[i] * p[static_cast<std::size_t>(peak.from) + i];
    return sum;
}

void fill_row(const Medium& medium, const Peak& peak, const Sums& sums, double ahead, double behind,
              float* out) {
    const double f = peak.share;
    std::vector<double> p(sums.chi.size());
    legendre(cosine_of(ahead), p);
    double low = 0;
    for (int l = 0; l < peak.from; ++l)
        low += sums.weight[static_cast<std::size_t>(l)] * f * p[static_cast<std::size_t>(l)];
    std::vector<double> orders;
    for (std::size_t n = 0; n < sums.most_orders; ++n)
        orders.push_back(peak_order(medium, peak, sums, p, static_cast<int>(n), ahead, behind));
    for (std::size_t k = 0; k < sums.depths.size(); ++k) {
        double value = 0;
        if (sums.terms[k].empty()) {
            value = low;
            for (std::size_t n = 0; n < sums.orders[k].size(); ++n)
                value += sums.orders[k][n] * orders[n];
        } else {
            for (std::size_t l = 0; l < sums.terms[k].size(); ++l) value += sums.terms[k][l] * p[l];
        }
        out[k] = static_cast<float>(value);
    }
}

}  // namespace

double phase_of_chords(const Medium& medium, double ahead, double behind) {
    if (medium.droplets)
        return kPer4Pi * phase_value(*medium.droplets, ahead * ahead / 2, behind * behind / 2);
    const double hg = kPer4Pi * henyey_greenstein(medium.g, ahead, behind);
    if (medium.phase == PhaseFunction::kHenyeyGreenstein) return hg;
    const double mu = cosine_of(ahead);
    return 1.5 * (1 + mu * mu) / (2 + medium.g * medium.g) * hg;
}

RestOfPhase rest_of(const Medium& medium, const Peak& peak) {
    RestOfPhase rest{medium, {}};
    for (int l = 0; l < peak.from && peak.share != 0; ++l)
        rest.moments.push_back((2 * l + 1) * kPer4Pi * (phase_moment(medium, l) - peak.share));
    return rest;
}

double rest_of_phase(const RestOfPhase& rest, double ahead, double behind) {
    if (rest.moments.empty()) return phase_of_chords(rest.medium, ahead, behind);
    const double mu = cosine_of(ahead);
    double sum = 0, p = 1, before = 0;
    for (std::size_t l = 0; l < rest.moments.size(); ++l) {
        const auto n = static_cast<double>(l);
        sum += rest.moments[l] * p;
        const double next = ((2 * n + 1) * mu * p - n * before) / (n + 1);
        before = p;
        p = next;
    }
    return sum;
}

RowAt row_at(const PeakTable& table, double ahead, double behind) {
    const double chord = std::min(ahead, behind);
    double at = std::asinh(chord / table.fold) * table.rows_per;
    if (behind < ahead) at = 2 * table.half - at;
    const int row = std::clamp(static_cast<int>(at), 0, 2 * table.half - 1);
    return {row, static_cast<float>(std::clamp(at - row, 0.0, 1.0))};
}

PeakTable peak_table(const Medium& medium, const Peak& peak, double least_ahead,
                     double most_ahead) {
    PeakTable table;
    if (peak.share == 0) return table;
    const double scaled = std::max(1 - medium.albedo * peak.share, 1e-6);
    const double octaves =
        std::clamp(exact::log2(1 + 14 / scaled), 1.0, static_cast<double>(kMostOctaves));
    table.columns = static_cast<int>(std::ceil((8 * octaves + 2) / 16)) * 16;
    // The nodes of droplets' phase function are even in the chord from about there on.
    table.fold = medium.droplets ? std::sqrt(std::ldexp(2.0, -medium.droplets->octaves))
                                 : 1 - std::abs(medium.g);
    const double reach = std::asinh(std::numbers::sqrt2 / table.fold);
    table.half = static_cast<int>(std::ceil(reach / kRowStep));
    table.rows_per = table.half / reach;
    table.values.resize(static_cast<std::size_t>(2 * table.half + 1) *
                        static_cast<std::size_t>(table.columns));
    const Sums sums = sums_of(medium, peak, table.columns);
    table.last = sums.depths.back();
    const auto behind_of = [](double ahead) { return std::sqrt(std::max(0.0, 4 - ahead * ahead)); };
    const int first = row_at(table, least_ahead, behind_of(least_ahead)).row;
    const int last = row_at(table, most_ahead, behind_of(most_ahead)).row + 1;
    for (int row = std::max(0, first - 1); row <= std::min(2 * table.half, last + 1); ++row) {
        const int from_end = row <= table.half ? row : 2 * table.half - row;
        const double near = std::min(table.fold * exact::sinh(from_end / table.rows_per), 2.0);
        const double far = behind_of(near);
        const bool forward = row <= table.half;
        fill_row(medium, peak, sums, forward ? near : far, forward ? far : near,
                 table.values.data() +
                     static_cast<std::size_t>(row) * static_cast<std::size_t>(table.columns));
    }
    return table;
}

}  // namespace awan
