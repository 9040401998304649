#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/generate/ellipsoids/lattice.h"
#include "core/parallel.h"

namespace awan {
namespace {

constexpr int kLines = 8;  // along either axis
constexpr int kStepsPerCell = 4;
constexpr int kReach = 3;  // cells; a Gaussian has 3e-5 of itself left there

// The texture and the ellipsoids as they are, along the line through the middles of a column.
double exact_depth(const OpacityLattice& lattice, int x, int z,
                   const std::vector<PlacedEllipsoid>& ellipsoids, const TextureFunction& texture) {
    glm::dvec3 p = lattice.middle(x, 0, z);
    std::vector<const PlacedEllipsoid*> met;
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        if (std::abs(p.x - one.center.x) <= half.x && std::abs(p.z - one.center.z) <= half.z)
            met.push_back(&one);
    }
    if (met.empty()) return 0;
    const int steps = kStepsPerCell * lattice.cells.y;
    const double step = lattice.layer / kStepsPerCell;
    double depth = 0;
    for (int i = 0; i < steps; ++i) {
        p.y = lattice.origin.y + (i + 0.5) * step;
        double opaque = 0, value = -1;
        for (const PlacedEllipsoid* one : met) {
            const glm::dvec3 u = one->to_unit(p);
            const double g = limb_in_space(glm::dot(u, u));
            if (g < 0) continue;
            if (value < 0) value = texture_at(texture, p).mean;
            opaque = std::max(opaque, opacity({value, 0}, threshold_at(one->translucence, g),
                                              one->translucence.range));
        }
        depth += opaque * step;
    }
    return depth;
}

// The Gaussians' depth there.
double lattice_depth(const OpacityLattice& lattice, int x, int z,
                     const std::array<double, 2 * kReach + 1>& weights) {
    double depth = 0;
    for (int dz = -kReach; dz <= kReach; ++dz)
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const int cx = x + dx, cz = z + dz;
            if (cx < 0 || cz < 0 || cx >= lattice.cells.x || cz >= lattice.cells.z) continue;
            double column = 0;
            for (int y = 0; y < lattice.cells.y; ++y)
                column += static_cast<double>(lattice.values[lattice.index(cx, y, cz)]);
            depth += column * weights[static_cast<std::size_t>(dx + kReach)] *
                     weights[static_cast<std::size_t>(dz + kReach)];
        }
    return depth * lattice.layer;
}

}  // namespace

double sampling_error(const OpacityLattice& lattice, const std::vector<PlacedEllipsoid>& ellipsoids,
                      const TextureFunction& texture, int threads, const Deadline& deadline) {
    if (lattice.values.empty()) return 0;
    std::array<double, 2 * kReach + 1> weights{};
    for (int k = -kReach; k <= kReach; ++k) {
        const double off = k / 0.65;
        weights[static_cast<std::size_t>(k + kReach)] =
            std::exp(-off * off / 2) / (0.65 * std::sqrt(2 * std::numbers::pi));
    }
    std::array<double, kLines * kLines> exact{}, made{};
    parallel_for(threads, exact.size(), [&](std::size_t i) {
        if (deadline.over()) return;
        const int along_x = static_cast<int>(i) % kLines, along_z = static_cast<int>(i) / kLines;
        const int x = (2 * along_x + 1) * lattice.cells.x / (2 * kLines);
        const int z = (2 * along_z + 1) * lattice.cells.z / (2 * kLines);
        exact[i] = exact_depth(lattice, x, z, ellipsoids, texture);
        made[i] = lattice_depth(lattice, x, z, weights);
    });
    double wrong = 0, all = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        wrong += (made[i] - exact[i]) * (made[i] - exact[i]);
        all += exact[i] * exact[i];
    }
    // Nothing met by a line, and nothing made either: nothing lost that they show.
    return all > 0 ? std::sqrt(wrong / all) : 0;
}

}  // namespace awan
