#include "core/light/island_sun.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

// How far a particle's matter reaches, in standard deviations.
constexpr double kReach = 4;

// The shares of a Gaussian's mass in columns first..last along one axis. What lies beyond kReach, 6e-5 of it, is left
// out.
void shares(double center, double s, double cell, int first, int last, std::vector<double>& to) {
    to.clear();
    double before = normal_cdf((first * cell - center) / s);
    for (int i = first; i <= last; ++i) {
        const double next = normal_cdf(((i + 1) * cell - center) / s);
        to.push_back(next - before);
        before = next;
    }
}

// Optical depth of what lies before the prism: the mean over each of its columns' faces.
std::vector<double> depth_before(const Lattice& prism, const ParticleSet& all) {
    const auto nx = static_cast<std::size_t>(prism.cells.x);
    std::vector<double> depth(nx * static_cast<std::size_t>(prism.cells.y)), x, y;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double s = gaussian_s(all, i), reach = kReach * s;
        const glm::dvec3 apart = all.center[i] - prism.origin;
        const double before = normal_cdf(-glm::dot(apart, prism.w) / s);
        if (before < 1e-5) continue;
        const double cx = glm::dot(apart, prism.u), cy = glm::dot(apart, prism.v);
        const auto column = [&](double at, double cell, int count) {
            return static_cast<int>(
                std::clamp(std::floor(at / cell), -1.0, static_cast<double>(count)));
        };
        const int x0 = std::max(column(cx - reach, prism.cell.x, prism.cells.x), 0);
        const int x1 = std::min(column(cx + reach, prism.cell.x, prism.cells.x), prism.cells.x - 1);
        const int y0 = std::max(column(cy - reach, prism.cell.y, prism.cells.y), 0);
        const int y1 = std::min(column(cy + reach, prism.cell.y, prism.cells.y), prism.cells.y - 1);
        if (x0 > x1 || y0 > y1) continue;
        shares(cx, s, prism.cell.x, x0, x1, x);
        shares(cy, s, prism.cell.y, y0, y1, y);
        const double most =
            std::min(before * gaussian_mass(all, i) / (prism.cell.x * prism.cell.y), 1e30);
        for (int j = y0; j <= y1; ++j) {
            const double across = most * y[static_cast<std::size_t>(j - y0)];
            double* const row =
                depth.data() + static_cast<std::size_t>(j) * nx + static_cast<std::size_t>(x0);
            for (std::size_t a = 0; a < x.size(); ++a) row[a] += across * x[a];
        }
    }
    return depth;
}

}  // namespace

bool shades(const Lattice& prism, const glm::dvec3& center, double reach) {
    const glm::dvec3 apart = center - prism.origin;
    const auto within = [&](double at, double side) { return at > -reach && at < side + reach; };
    const glm::dvec3 size = prism.cell * glm::dvec3(prism.cells);
    return glm::dot(apart, prism.w) < size.z + reach && within(glm::dot(apart, prism.u), size.x) &&
           within(glm::dot(apart, prism.v), size.y);
}

SunDepth sun_depth_in(const Lattice& prism, const ParticleSet& all) {
    const std::vector<double> before = depth_before(prism, all);
    return sun_depth_on(prism, all, std::vector<float>(before.begin(), before.end()), 1);
}

}  // namespace awan
