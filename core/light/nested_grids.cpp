#include "core/light/nested_grids.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace awan {
namespace {

// Cells of the grids there are. A solve of the first takes less than a millisecond.
constexpr std::array kSteps = {8, 12, 16, 24, 32, 48, 64, 96};
constexpr double kLeastGrowth = 1.25;
// The power of a cell's side with which errors are taken to fall.
constexpr double kOrder = 2;
// Below this growth two grids differ by rounding more than by their error.
constexpr double kLeastRatio = 1.1;
// The largest change of a cell's light, relative to its mean radiance: where cells are so coarse that grids differ by more, their difference does not
// say where they go.
constexpr float kMostChange = 0.5F;

// Where a coordinate lies between the centres of two cells.
struct Between {
    int low, high;
    float share;  // of the upper
};
Between between(double place, int cells) {
    const double clamped = std::clamp(place - 0.5, 0.0, static_cast<double>(cells - 1));
    const int low = std::min(static_cast<int>(clamped), std::max(cells - 2, 0));
    return {low, std::min(low + 1, cells - 1), static_cast<float>(clamped - low)};
}

std::vector<Between> along(const TransportLight& from, const TransportLight& to, int axis) {
    std::vector<Between> places;
    for (int i = 0; i < to.cells[axis]; ++i) {
        const double at = to.origin[axis] + (i + 0.5) * to.cell;
        places.push_back(between((at - from.origin[axis]) / from.cell, from.cells[axis]));
    }
    return places;
}

}  // namespace

std::vector<int> nested_cells(int cells) {
    std::vector<int> grids{cells};
    for (std::size_t i = kSteps.size(); i-- > 0;)
        if (kLeastGrowth * kSteps[i] <= grids.back()) grids.push_back(kSteps[i]);
    std::reverse(grids.begin(), grids.end());
    return grids;
}

std::vector<std::array<float, kHarmonics>> moments_between(const TransportLight& from,
                                                           std::size_t band,
                                                           const TransportLight& to, int threads) {
    const auto& values = from.bands[band].moments;
    const std::vector<Between> x = along(from, to, 0), y = along(from, to, 1),
                               z = along(from, to, 2);
    std::vector<std::array<float, kHarmonics>> moments(x.size() * y.size() * z.size());
    const auto at = [&](int i, int j, int k) {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(from.cells.y) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(from.cells.x) +
               static_cast<std::size_t>(i);
    };
    parallel_for(threads, y.size() * z.size(), [&](std::size_t row) {
        const Between &b = y[row % y.size()], &c = z[row / y.size()];
        // The four rows of `from` about this one, and their shares.
        const std::array rows{at(0, b.low, c.low), at(0, b.high, c.low), at(0, b.low, c.high),
                              at(0, b.high, c.high)};
        const std::array shares{(1 - b.share) * (1 - c.share), b.share * (1 - c.share),
                                (1 - b.share) * c.share, b.share * c.share};
        for (std::size_t i = 0; i < x.size(); ++i) {
            std::array<float, kHarmonics>& sum = moments[row * x.size() + i];
            sum.fill(0);
            for (std::size_t r = 0; r < 4; ++r) {
                const auto& low = values[rows[r] + static_cast<std::size_t>(x[i].low)];
                const auto& high = values[rows[r] + static_cast<std::size_t>(x[i].high)];
                const float upper = shares[r] * x[i].share, lower = shares[r] - upper;
                for (std::size_t m = 0; m < kHarmonics; ++m)
                    sum[m] += lower * low[m] + upper * high[m];
            }
        }
    });
    return moments;
}

void extrapolate(const TransportLight& coarse, TransportLight& fine, int threads) {
    const double ratio = coarse.cell / fine.cell;
    if (coarse.bands.size() != fine.bands.size() || !(ratio > kLeastRatio)) return;
    const auto gain = static_cast<float>(1 / (std::pow(ratio, kOrder) - 1));
    for (std::size_t b = 0; b < fine.bands.size(); ++b) {
        const auto before = moments_between(coarse, b, fine, threads);
        auto& moments = fine.bands[b].moments;
        for (std::size_t i = 0; i < moments.size(); ++i) {
            float change = 0;
            for (std::size_t m = 0; m < kHarmonics; ++m)
                change = std::max(change, gain * std::abs(moments[i][m] - before[i][m]));
            const float most = kMostChange * std::abs(moments[i][0]);
            const float share = change > most ? gain * most / change : gain;
            for (std::size_t m = 0; m < kHarmonics; ++m)
                moments[i][m] += share * (moments[i][m] - before[i][m]);
        }
    }
}

TransportLight as_coarser(const TransportLight& light) {
    TransportLight coarser = light.coarser ? *light.coarser : light;
    coarser.sun = light.sun;
    coarser.ground = light.ground;
    coarser.regions = light.regions;
    coarser.islands.clear();
    for (const LightIsland& island : light.islands) {
        LightIsland& one = coarser.islands.emplace_back();
        one.lit = island.lit;
        one.low = island.low;
        one.high = island.high;
        one.mean_s = island.mean_s;
        if (island.lit) one.light = as_coarser(island.light);
    }
    return coarser;
}

}  // namespace awan
