#include "core/scene/droplets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/scene/mie.h"

namespace awan {
namespace {

constexpr double kVariance = 0.1;
// Micrometres, refractive index, share of luminance.
struct Band {
    double wavelength, index, share;
};
constexpr Band kBands[] = {{0.625, 1.332, 0.2126}, {0.55, 1.333, 0.7152}, {0.45, 1.337, 0.0722}};
// Radii, even from the least to the most, in effective radii; outside is less than 1e-4 of the light.
constexpr double kLeast = 0.15, kMost = 2.4;
// How many a band. Small drops need the more, as they ring at sizes of their own; of large ones each costs more
// time. Measured against 400: within 5% at most angles.
int radii_of(double diameter) {
    return static_cast<int>(std::clamp(2000 / diameter, 48.0, 128.0));
}
// Moments below this are left out.
constexpr double kNegligible = 1e-6;

double size_of(double radius, const Band& band) {
    return 2 * std::numbers::pi * radius / band.wavelength;
}

std::vector<double> nodes_of(int octaves) {
    const int each = 1 << DropletPhase::kPerOctaveBits;
    const double most = std::ldexp(1.0, octaves) - 1;
    std::vector<double> nodes;
    for (int octave = 0; octave < octaves; ++octave)
        for (int i = 0; i < each; ++i)
            nodes.push_back((std::ldexp(1.0 + static_cast<double>(i) / each, octave) - 1) / most);
    nodes.push_back(1);
    return nodes;
}

// |S1|^2 + |S2|^2 over the squared wave number is what a sphere scatters in a direction.
void sum_over_sizes(DropletPhase& phase) {
    const double effective = phase.diameter / 2;
    const int radii = radii_of(phase.diameter);
    for (std::size_t b = 0; b < std::size(kBands); ++b) {
        const Band& band = kBands[b];
        for (int i = 0; i < radii; ++i) {
            // The bands' radii lie between each other's.
            const double place = (i + (static_cast<double>(b) + 0.5) / std::size(kBands)) / radii;
            const double ratio = kLeast + (kMost - kLeast) * place;
            const double many =
                exact::exp((1 - 3 * kVariance) / kVariance * exact::log(ratio) - ratio / kVariance);
            const double share = band.share * many * band.wavelength * band.wavelength;
            add_intensities(mie_series(size_of(ratio * effective, band), band.index), share,
                            phase.nodes, phase.ahead, phase.behind);
        }
    }
}

// Half the integral of p over w from node i to the next, of one half of the sphere.
double share_of_interval(const DropletPhase& phase, const std::vector<double>& p, std::size_t i) {
    return 0.25 * (p[i] + p[i + 1]) * (phase.nodes[i + 1] - phase.nodes[i]);
}

// Every node's mean with its neighbours. What is left of the single sizes' ringing is as narrow as that, while bow and
// glory are wider.
void smooth(DropletPhase& phase) {
    for (auto* const p : {&phase.ahead, &phase.behind}) {
        double before = (*p)[1];
        for (std::size_t i = 0; i + 1 < p->size(); ++i) {
            const double here = (*p)[i];
            (*p)[i] = 0.25 * (before + 2 * here + (*p)[i + 1]);
            before = here;
        }
    }
}

void normalise(DropletPhase& phase) {
    // Both halves meet at 90 degrees.
    phase.ahead.back() = phase.behind.back() = 0.5 * (phase.ahead.back() + phase.behind.back());
    double whole = 0;
    for (std::size_t i = 0; i + 1 < phase.nodes.size(); ++i)
        whole +=
            share_of_interval(phase, phase.ahead, i) + share_of_interval(phase, phase.behind, i);
    for (double& p : phase.ahead) p /= whole;
    for (double& p : phase.behind) p /= whole;
}

// A node's cosine, and by how much p's slope over the cosine rises there.
struct Bend {
    double cosine, rise;
};
std::vector<Bend> bends_of(const DropletPhase& phase) {
    std::vector<double> mu, p;
    const std::size_t n = phase.nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
        mu.push_back(phase.nodes[i] - 1);
        p.push_back(phase.behind[i]);
    }
    std::vector<double> width;
    for (std::size_t i = 0; i + 1 < n; ++i) width.push_back(phase.nodes[i + 1] - phase.nodes[i]);
    for (std::size_t i = n - 1; i > 0; --i) {
        mu.push_back(1 - phase.nodes[i - 1]);
        p.push_back(phase.ahead[i - 1]);
        width.push_back(phase.nodes[i] - phase.nodes[i - 1]);
    }
    std::vector<Bend> bends;
    double before = 0;
    for (std::size_t i = 0; i < mu.size(); ++i) {
        const double after = i + 1 < mu.size() ? (p[i + 1] - p[i]) / width[i] : 0;
        bends.push_back({mu[i], after - before});
        before = after;
    }
    return bends;
}

// chi_l = 1/2 integral of p P_l. As p is linear between nodes, two integrations by parts leave half the sum over nodes
// of the slope's rise times J_l, the second integral of P_l:
//     I_l = (P_(l+1) - P_(l-1)) / (2 l + 1),     J_l = (I_(l+1) - I_(l-1)) / (2 l + 1).
void take_moments(DropletPhase& phase, std::size_t count) {
    phase.moment.assign(count, 0.0);
    phase.moment[0] = 1;
    std::vector<double> p(count + 2);
    for (const Bend& bend : bends_of(phase)) {
        const double mu = bend.cosine;
        p[0] = 1;
        p[1] = mu;
        for (std::size_t l = 2; l < p.size(); ++l) {
            const auto n = static_cast<double>(l);
            p[l] = ((2 * n - 1) * mu * p[l - 1] - (n - 1) * p[l - 2]) / n;
        }
        phase.moment[1] += 0.5 * bend.rise * (1 - mu) * (1 - mu) * (mu + 2) / 6;
        for (std::size_t l = 2; l < count; ++l) {
            const auto n = static_cast<double>(l);
            const double j =
                ((p[l + 2] - p[l]) / (2 * n + 3) - (p[l] - p[l - 2]) / (2 * n - 1)) / (2 * n + 1);
            phase.moment[l] += 0.5 * bend.rise * j;
        }
    }
    while (phase.moment.size() > 8 && std::abs(phase.moment.back()) < kNegligible)
        phase.moment.pop_back();
}

struct NodePlace {
    std::size_t node;
    double share;  // of the next node
};
NodePlace place_of(const DropletPhase& phase, double w) {
    constexpr int kShift = 23 - DropletPhase::kPerOctaveBits;
    const double most = std::ldexp(1.0, phase.octaves) - 1;
    const auto v = static_cast<float>(1 + std::clamp(w, 0.0, 1.0) * most);
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(v) - std::bit_cast<std::uint32_t>(1.0f);
    const std::size_t node = std::min<std::size_t>(bits >> kShift, phase.nodes.size() - 2);
    const double from = phase.nodes[node], width = phase.nodes[node + 1] - from;
    return {node, std::clamp((w - from) / width, 0.0, 1.0)};
}

double between(const std::vector<double>& p, const NodePlace& at) {
    return p[at.node] + at.share * (p[at.node + 1] - p[at.node]);
}

}  // namespace

DropletPhase droplet_phase(double diameter) {
    DropletPhase phase;
    phase.diameter = diameter;
    const double x = std::numbers::pi * diameter / kBands[1].wavelength;
    // The first octave of nodes divides what is well within the peak ahead, which is about 1 / x wide.
    phase.octaves = std::max(6, static_cast<int>(std::ceil(2 * exact::log2(x) + 2)));
    phase.nodes = nodes_of(phase.octaves);
    phase.ahead.assign(phase.nodes.size(), 0.0);
    phase.behind.assign(phase.nodes.size(), 0.0);
    sum_over_sizes(phase);
    smooth(phase);
    smooth(phase);
    normalise(phase);
    // Light of a sphere has no orders beyond twice its size, and most drops are not much larger than the mean.
    take_moments(phase, static_cast<std::size_t>(4 * x) + 32);
    return phase;
}

double phase_value(const DropletPhase& droplets, double less, double more) {
    return less <= more ? between(droplets.ahead, place_of(droplets, less))
                        : between(droplets.behind, place_of(droplets, more));
}

double share_within(const DropletPhase& droplets, double less) {
    const auto within = [&](const std::vector<double>& p, double w) {
        const NodePlace at = place_of(droplets, w);
        double sum = 0;
        for (std::size_t i = 0; i < at.node; ++i) sum += share_of_interval(droplets, p, i);
        const double part = at.share * (droplets.nodes[at.node + 1] - droplets.nodes[at.node]);
        return sum + 0.25 * (p[at.node] + between(p, at)) * part;
    };
    return less <= 1 ? within(droplets.ahead, less) : 1 - within(droplets.behind, 2 - less);
}

DropletFit droplet_fit(double diameter) {
    const double d = diameter;
    if (d >= 5)
        return {exact::exp(-0.0990567 / (d - 1.67154)),
                exact::exp(-2.20679 / (d + 3.91029) - 0.428934),
                exact::exp(3.62489 - 8.29288 / (d + 5.52825)),
                exact::exp(-0.599085 / (d - 0.641583) - 0.665888)};
    const double log = exact::log(d), loglog = exact::log(log);
    return {0.0604931 * loglog + 0.940256,
            0.500411 - 0.081287 / (-2 * log + exact::tan(log) + 1.27551), 7.30354 * log + 6.31675,
            0.026914 * (log - exact::cos(5.68947 * (loglog - 0.0292149))) + 0.376475};
}

}  // namespace awan
