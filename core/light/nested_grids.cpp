#include "core/light/nested_grids.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

using Moments = std::vector<std::array<float, kHarmonics>>;

// The power of a cell's side with which errors are taken to fall.
constexpr double kOrder = 2;
// Below this growth two grids differ by rounding more than by their error.
constexpr double kLeastRatio = 1.1;
// The largest change of a cell's light, relative to its mean radiance: where cells are so coarse that grids differ by
// more, their difference does not say where they go.
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
        const double at = to.origin[axis] + (i + 0.5) * to.cell[axis];
        places.push_back(between((at - from.origin[axis]) / from.cell[axis], from.cells[axis]));
    }
    return places;
}

// Of `fine` the moments of a cell, of `before` those of the coarser grid there.
void go_on(const std::array<float, kHarmonics>& before, float gain,
           std::array<float, kHarmonics>& fine) {
    float change = 0;
    for (std::size_t m = 0; m < kHarmonics; ++m)
        change = std::max(change, gain * std::abs(fine[m] - before[m]));
    const float most = kMostChange * std::abs(fine[0]);
    const float share = change > most ? gain * most / change : gain;
    for (std::size_t m = 0; m < kHarmonics; ++m) fine[m] += share * (fine[m] - before[m]);
}

// Cells that a thread takes at a time.
constexpr std::size_t kBlock = 4096;

// The moments as they were solved.
const Moments& solved_moments(const TransportLight& light, std::size_t band) {
    return band < light.solved.size() ? light.solved[band] : light.bands[band].moments;
}

// `values`: moments of the cells of `from`.
Moments at_cells_of(const TransportLight& to, const TransportLight& from, const Moments& values,
                    int threads) {
    const std::vector<Between> x = along(from, to, 0), y = along(from, to, 1),
                               z = along(from, to, 2);
    Moments moments(x.size() * y.size() * z.size());
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

}  // namespace

std::vector<std::array<float, kHarmonics>> moments_between(const TransportLight& from,
                                                           std::size_t band,
                                                           const TransportLight& to, int threads) {
    return at_cells_of(to, from, from.bands[band].moments, threads);
}

void extrapolate(const TransportLight& coarse, TransportLight& fine, int threads) {
    if (coarse.bands.size() != fine.bands.size() || !coarse.has_grid()) return;
    if (coarse.cells == fine.cells && coarse.origin == fine.origin) {
        fine.bands = coarse.bands;
        fine.solved = coarse.solved;
        return;
    }
    const glm::dvec3 ratios = coarse.cell / fine.cell;
    const double ratio = exact::cbrt(ratios.x * ratios.y * ratios.z);
    if (!(ratio > kLeastRatio)) return;
    const auto gain = static_cast<float>(1 / (exact::pow(ratio, kOrder) - 1));
    for (std::size_t b = 0; b < fine.bands.size(); ++b) {
        const Moments before = at_cells_of(fine, coarse, solved_moments(coarse, b), threads);
        auto& moments = fine.bands[b].moments;
        fine.solved.push_back(moments);
        parallel_for(threads, moments.size() / kBlock + 1, [&](std::size_t block) {
            const std::size_t end = std::min((block + 1) * kBlock, moments.size());
            for (std::size_t i = block * kBlock; i < end; ++i) go_on(before[i], gain, moments[i]);
        });
    }
}

}  // namespace awan
