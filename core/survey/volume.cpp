#include "core/survey/volume.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

// Particles between two looks at the deadline: some milliseconds.
constexpr std::size_t kBetweenLooks = 1u << 14;

struct CellSpan {
    int first, last;  // cells, inclusive
};

CellSpan cells_of(double center, double reach, double origin, double cell, int count) {
    const int first = static_cast<int>(std::floor((center - reach - origin) / cell));
    const int last = static_cast<int>(std::floor((center + reach - origin) / cell));
    return {std::clamp(first, 0, count - 1), std::clamp(last, 0, count - 1)};
}

// Shares of a Gaussian's mass in the cells of a span along one axis; they sum to 1.
void axis_weights(double center, double s, double origin, double cell, CellSpan span,
                  float* weights) {
    const auto below = [&](int edge) { return normal_cdf((origin + edge * cell - center) / s); };
    const double begin = below(span.first), whole = below(span.last + 1) - begin;
    double previous = begin;
    for (int i = span.first; i <= span.last; ++i) {
        const double next = below(i + 1);
        weights[i - span.first] = whole > 0 ? static_cast<float>((next - previous) / whole)
                                            : (i == span.first ? 1.F : 0.F);
        previous = next;
    }
}

double work_at(const ParticleSet& particles, double cell) {
    double work = 0;
    for (const float radius : particles.radius) {
        const double side = kGaussianCut * static_cast<double>(radius) / cell + 2;
        work += side * side * side;
    }
    return work;
}

}  // namespace

DensityVolume density_volume(const ParticleSet& particles, int max_cells, double most_work,
                             const Deadline& deadline) {
    DensityVolume volume;
    if (particles.size() == 0) return volume;
    glm::dvec3 low(particles.center[0]), high(low);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 reach(kGaussianCut * gaussian_s(particles, i));
        low = glm::min(low, particles.center[i] - reach);
        high = glm::max(high, particles.center[i] + reach);
    }
    const glm::dvec3 size = high - low;
    // Far from the origin a small ball may round to nothing; its own size is then the volume's.
    const double largest_ball =
        kGaussianCut *
        static_cast<double>(*std::max_element(particles.radius.begin(), particles.radius.end()));
    const double longest = std::max({size.x, size.y, size.z, largest_ball});
    int count = max_cells;
    while (count > 4 && work_at(particles, longest / count) > most_work) count = count * 3 / 4;
    volume.cell = longest / count;
    volume.origin = low;
    volume.cells =
        glm::clamp(glm::ivec3(glm::ceil(size / volume.cell)), glm::ivec3(1), glm::ivec3(count));
    const glm::ivec3 n = volume.cells;
    volume.extinction.assign(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                                 static_cast<std::size_t>(n.z),
                             0.F);

    const double cell_volume = volume.cell * volume.cell * volume.cell;
    std::vector<float> wx(static_cast<std::size_t>(n.x)), wy(static_cast<std::size_t>(n.y)),
        wz(static_cast<std::size_t>(n.z));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (i % kBetweenLooks == 0 && deadline.over()) break;
        const double s = gaussian_s(particles, i), mass = gaussian_mass(particles, i);
        if (!(mass > 0)) continue;
        const glm::dvec3 c = particles.center[i];
        const CellSpan x = cells_of(c.x, kGaussianCut * s, volume.origin.x, volume.cell, n.x);
        const CellSpan y = cells_of(c.y, kGaussianCut * s, volume.origin.y, volume.cell, n.y);
        const CellSpan z = cells_of(c.z, kGaussianCut * s, volume.origin.z, volume.cell, n.z);
        axis_weights(c.x, s, volume.origin.x, volume.cell, x, wx.data());
        axis_weights(c.y, s, volume.origin.y, volume.cell, y, wy.data());
        axis_weights(c.z, s, volume.origin.z, volume.cell, z, wz.data());
        const auto scale = static_cast<float>(mass / cell_volume);
        for (int k = z.first; k <= z.last; ++k)
            for (int j = y.first; j <= y.last; ++j) {
                const float w = scale * wz[static_cast<std::size_t>(k - z.first)] *
                                wy[static_cast<std::size_t>(j - y.first)];
                float* row = volume.extinction.data() +
                             (static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                              static_cast<std::size_t>(j)) *
                                 static_cast<std::size_t>(n.x);
                for (int a = x.first; a <= x.last; ++a)
                    row[a] += w * wx[static_cast<std::size_t>(a - x.first)];
            }
    }
    return volume;
}

double extinction_of_cell(const DensityVolume& volume, const glm::dvec3& place) {
    const glm::ivec3 cell =
        glm::clamp(glm::ivec3(glm::floor(place)), glm::ivec3(0), volume.cells - 1);
    const auto across = static_cast<std::size_t>(volume.cells.x),
               up = static_cast<std::size_t>(volume.cells.y);
    const std::size_t at =
        (static_cast<std::size_t>(cell.z) * up + static_cast<std::size_t>(cell.y)) * across +
        static_cast<std::size_t>(cell.x);
    return static_cast<double>(volume.extinction[at]);
}

}  // namespace awan
