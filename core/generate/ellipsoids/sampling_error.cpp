#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/ellipsoids/lattice.h"

namespace awan::ellipsoids {
namespace {

// Lines along either side of the raster; steps of the integral along a line.
constexpr int kLines = 8;
constexpr int kStepsPerCell = 4;
// How far Gaussians are looked for beside a line, cells. One has 3e-5 of itself left there.
constexpr int kReach = 3;

// A vertical line through the middle of a column of cells.
struct Line {
    // Which column.
    int x = 0, z = 0;
    // Where it enters the lattice.
    glm::dvec3 bottom{0};
    // How far it is to the top of the lattice.
    double height = 0;
    // Steps along it, kStepsPerCell a cell.
    int steps = 0;
};

// The depth along a line by the texture and the ellipsoids themselves.
double depth_of(const Line& line, const std::vector<PlacedEllipsoid>& ellipsoids, double join,
                const TextureFunction& texture) {
    glm::dvec3 p = line.bottom;
    std::vector<const PlacedEllipsoid*> met;
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        if (std::abs(p.x - one.center.x) <= half.x && std::abs(p.z - one.center.z) <= half.z)
            met.push_back(&one);
    }
    if (met.empty()) return 0;
    const double step = line.height / line.steps;
    double depth = 0;
    for (int i = 0; i < line.steps; ++i) {
        p.y = line.bottom.y + (i + 0.5) * step;
        double opaque = 0, limbs = 0;
        std::optional<TextureValue> value;
        for (const PlacedEllipsoid* one : met) {
            if (!(join > 0)) break;
            const glm::dvec3 u = one->to_unit(p);
            limbs += std::max(limb_in_space(glm::dot(u, u)), 0.0);
        }
        for (const PlacedEllipsoid* one : met) {
            const glm::dvec3 u = one->to_unit(p);
            const double g = limb_in_space(glm::dot(u, u));
            if (g < 0) continue;
            if (!value) value = texture_at(texture, p);
            const Translucence& t = one->translucence;
            const double limb = join > 0 ? joined_limb(g, limbs - g, join) : g;
            opaque = std::max(
                opaque, limited(opacity(*value, threshold_at(t, limb), t.range), t.least, t.most));
        }
        depth += opaque * step;
    }
    return depth;
}

// Sums of the Gaussians' densities over vertical columns of cells.
std::vector<double> columns_of(const LatticeField& lattice, const ReadyParticles& particles) {
    const auto width = static_cast<std::size_t>(lattice.nx);
    std::vector<double> columns(width * static_cast<std::size_t>(lattice.nz), 0.0);
    for (std::size_t i = 0; i < particles.positions.size(); ++i) {
        const glm::dvec3 at = (particles.positions[i] - lattice.origin) / lattice.cell;
        const auto x = static_cast<std::size_t>(std::clamp(std::lround(at.x), 0l, lattice.nx - 1l));
        const auto z = static_cast<std::size_t>(std::clamp(std::lround(at.z), 0l, lattice.nz - 1l));
        columns[z * width + x] += static_cast<double>(particles.densities[i]);
    }
    return columns;
}

// The Gaussians' optical depth along column (x, z), over the density where opaque.
double lattice_depth(const LatticeField& lattice, int x, int z, const std::vector<double>& columns,
                     const std::array<double, 2 * kReach + 1>& weights) {
    double depth = 0;
    for (int dz = -kReach; dz <= kReach; ++dz)
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const int cx = x + dx, cz = z + dz;
            if (cx < 0 || cz < 0 || cx >= lattice.nx || cz >= lattice.nz) continue;
            depth += columns[static_cast<std::size_t>(cz) * static_cast<std::size_t>(lattice.nx) +
                             static_cast<std::size_t>(cx)] *
                     weights[static_cast<std::size_t>(dx + kReach)] *
                     weights[static_cast<std::size_t>(dz + kReach)];
        }
    return depth * std::sqrt(2 * std::numbers::pi) * kLatticeS * lattice.cell;
}

template <typename Exact>
double error_of(const LatticeField& lattice, const ReadyParticles& particles, double density,
                int threads, const Deadline& deadline, const Exact& exact_depth) {
    if (lattice.values.empty() || !(density > 0)) return 0;
    std::array<double, 2 * kReach + 1> weights{};
    for (int k = -kReach; k <= kReach; ++k)
        weights[static_cast<std::size_t>(k + kReach)] =
            exact::exp(-0.5 * (k / kLatticeS) * (k / kLatticeS));
    const std::vector<double> columns = columns_of(lattice, particles);
    std::array<double, kLines * kLines> exact{}, made{};
    parallel_for(threads, exact.size(), [&](std::size_t i) {
        if (deadline.over()) return;
        const int along_x = static_cast<int>(i) % kLines, along_z = static_cast<int>(i) / kLines;
        Line line;
        line.x = (2 * along_x + 1) * lattice.nx / (2 * kLines);
        line.z = (2 * along_z + 1) * lattice.nz / (2 * kLines);
        line.bottom = lattice.origin + lattice.cell * glm::dvec3(line.x, -0.5, line.z);
        line.height = lattice.cell * lattice.ny;
        line.steps = kStepsPerCell * lattice.ny;
        exact[i] = exact_depth(line);
        made[i] = lattice_depth(lattice, line.x, line.z, columns, weights) / density;
    });
    double wrong = 0, all = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        wrong += (made[i] - exact[i]) * (made[i] - exact[i]);
        all += exact[i] * exact[i];
    }
    // Where no line meets anything, there is nothing to lose.
    return all > 0 ? std::sqrt(wrong / all) : 0;
}

}  // namespace

double sampling_error(const LatticeField& lattice, const ReadyParticles& particles, double density,
                      const std::vector<PlacedEllipsoid>& ellipsoids, double join,
                      const TextureFunction& texture, int threads, const Deadline& deadline) {
    return error_of(lattice, particles, density, threads, deadline,
                    [&](const Line& line) { return depth_of(line, ellipsoids, join, texture); });
}

double sampling_error(const LatticeField& lattice, const ReadyParticles& particles, double density,
                      const SkyPlane& plane, const PlaneTexture& texture, int threads,
                      const Deadline& deadline) {
    return error_of(lattice, particles, density, threads, deadline, [&](const Line& line) {
        const auto value = [&](const TextureFunction& one) { return texture_at(one, line.bottom); };
        return plane.thickness *
               column_opacity(plane, parts_of(plane, texture, line.bottom, value), line.bottom);
    });
}

}  // namespace awan::ellipsoids
