#include "core/generate/ellipsoids/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace awan::ellipsoids {
namespace {

// A cell sees the texture over a blob of this standard deviation, in cells. What is finer than two cells is then
// gone, instead of turning up as something coarser.
constexpr double kCellBlur = 0.5;
constexpr float kLeastOpacity = 1e-3f;

struct Blur {
    double x, z;
};
Blur blur_of_cell(const TextureFunction& texture, double cell) {
    return {blur_of_blob(texture, false, kCellBlur * cell),
            blur_of_blob(texture, true, kCellBlur * cell)};
}

glm::dvec3 sample(const LatticeField& lattice, int i, int j, int k) {
    return lattice.origin + lattice.cell * glm::dvec3(i, j, k);
}

struct Range {
    // Indices first .. last - 1.
    int first, last;
};
// The samples that may lie within `half` of `center`, along one axis.
Range samples_within(double center, double half, double origin, double cell, int count) {
    const double low = std::floor((center - half - origin) / cell);
    const double high = std::ceil((center + half - origin) / cell) + 1;
    return {static_cast<int>(std::clamp(low, 0.0, static_cast<double>(count))),
            static_cast<int>(std::clamp(high, 0.0, static_cast<double>(count)))};
}

// Calls visit(ellipsoid, index of the cell, its place, g) for all cells of layer k that lie in an ellipsoid.
template <typename Visit>
void each_cell(const LatticeField& lattice, int k, const std::vector<PlacedEllipsoid>& ellipsoids,
               const Visit& visit) {
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        if (std::abs(sample(lattice, 0, 0, k).z - one.center.z) > half.z) continue;
        const Range xs =
            samples_within(one.center.x, half.x, lattice.origin.x, lattice.cell, lattice.nx);
        const Range ys =
            samples_within(one.center.y, half.y, lattice.origin.y, lattice.cell, lattice.ny);
        for (int j = ys.first; j < ys.last; ++j)
            for (int i = xs.first; i < xs.last; ++i) {
                const glm::dvec3 p = sample(lattice, i, j, k);
                const glm::dvec3 u = one.to_unit(p);
                const double g = limb_in_space(glm::dot(u, u));
                if (g < 0) continue;
                visit(one, lattice.index(i, j, k), p, g);
            }
    }
}

// Fills layer k, which is upright, of the lattice.
void fill_layer(LatticeField& lattice, int k, const std::vector<PlacedEllipsoid>& ellipsoids,
                double join, const TextureFunction& texture, const Blur& blur) {
    const std::size_t first = lattice.index(0, 0, k);
    // Values of the texture that are known already: a cell's is the same for all ellipsoids that hold it.
    const std::size_t size = lattice.index(0, 0, k + 1) - first;
    std::vector<TextureValue> known(size);
    std::vector<char> is_known(size, 0);
    std::vector<double> limbs;
    if (join > 0) {
        limbs.assign(size, 0.0);
        each_cell(lattice, k, ellipsoids,
                  [&](const PlacedEllipsoid&, std::size_t at, const glm::dvec3&, double g) {
                      limbs[at - first] += g;
                  });
    }
    each_cell(lattice, k, ellipsoids,
              [&](const PlacedEllipsoid& one, std::size_t at, const glm::dvec3& p, double g) {
                  const std::size_t in_layer = at - first;
                  if (is_known[in_layer] == 0) {
                      is_known[in_layer] = 1;
                      known[in_layer] = texture_at(texture, p, blur.x, blur.z);
                  }
                  const double limb = join > 0 ? joined_limb(g, limbs[in_layer] - g, join) : g;
                  const Translucence& t = one.translucence;
                  const double opaque = limited(
                      opacity(known[in_layer], threshold_at(t, limb), t.range), t.least, t.most);
                  lattice.values[at] = std::max(lattice.values[at], static_cast<float>(opaque));
              });
}

// Opacity of the plane's slab where it has `parts`. off: distance from the middle height, in half thicknesses.
double opacity_in_slab(const SkyPlane& plane, const PlaneParts& parts, double off) {
    return parts.opacity(off * off, plane.least, plane.most);
}

// A factor that fades the slab out towards the sides of its square.
double edge_of(const SkyPlane& plane, const glm::dvec3& p) {
    const double out = std::max(std::abs(p.x), std::abs(p.z)) / (plane.extent / 2);
    return std::clamp((1 - out) * 10, 0.0, 1.0);
}

// The mean over a cell's height, of which the slab may fill a part. low, high: from the plane's height.
double opacity_of_cell(const SkyPlane& plane, const PlaneParts& parts, double low, double high) {
    const double half = plane.thickness / 2;
    const double from = std::max(low, -half), to = std::min(high, half);
    if (!(to > from)) return 0;
    constexpr int kHeights = 4;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i)
        sum += opacity_in_slab(plane, parts, (from + (i + 0.5) / kHeights * (to - from)) / half);
    return sum / kHeights * (to - from) / (high - low);
}

}  // namespace

LatticeField opacity_of(const std::vector<PlacedEllipsoid>& ellipsoids, double join,
                        std::uint64_t resolution, const TextureFunction& texture, int threads,
                        const Deadline& deadline) {
    LatticeField lattice;
    if (ellipsoids.empty()) return lattice;
    glm::dvec3 low = ellipsoids[0].center, high = low;
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        low = glm::min(low, one.center - half);
        high = glm::max(high, one.center + half);
    }
    const glm::dvec3 size = high - low;
    const auto most = static_cast<double>(resolution);
    lattice.cell = std::max({size.x, size.y, size.z}) / most;
    const glm::dvec3 cells = glm::clamp(glm::ceil(size / lattice.cell - 1e-9), 1.0, most);
    lattice.nx = static_cast<int>(cells.x);
    lattice.ny = static_cast<int>(cells.y);
    lattice.nz = static_cast<int>(cells.z);
    lattice.origin = 0.5 * (low + high) - 0.5 * lattice.cell * (cells - 1.0);
    lattice.values.assign(lattice.index(0, 0, lattice.nz), 0.0f);
    const Blur blur = blur_of_cell(texture, lattice.cell);
    parallel_for(threads, static_cast<std::size_t>(lattice.nz), [&](std::size_t k) {
        if (!deadline.over())
            fill_layer(lattice, static_cast<int>(k), ellipsoids, join, texture, blur);
    });
    return lattice;
}

LatticeField opacity_of(const SkyPlane& plane, const PlaneTexture& texture, int threads,
                        const Deadline& deadline) {
    LatticeField lattice;
    lattice.nx = lattice.nz = static_cast<int>(plane.resolution);
    lattice.cell = plane.extent / lattice.nx;
    lattice.ny = std::clamp(
        static_cast<int>(std::ceil(plane.thickness / plane.extent * lattice.nx)), 1, lattice.nx);
    const glm::dvec3 cells(lattice.nx, lattice.ny, lattice.nz);
    lattice.origin = glm::dvec3(0, plane.altitude, 0) - 0.5 * lattice.cell * (cells - 1.0);
    lattice.values.assign(lattice.index(0, 0, lattice.nz), 0.0f);
    const auto cell_value = [&](const glm::dvec3& p) {
        return [&lattice, p](const TextureFunction& one) {
            const Blur blur = blur_of_cell(one, lattice.cell);
            return texture_at(one, p, blur.x, blur.z);
        };
    };
    parallel_for(threads, static_cast<std::size_t>(lattice.nz), [&](std::size_t row) {
        if (deadline.over()) return;
        const int k = static_cast<int>(row);
        for (int i = 0; i < lattice.nx; ++i) {
            const glm::dvec3 p = sample(lattice, i, 0, k);
            const double edge = edge_of(plane, p);
            const PlaneParts parts = parts_of(plane, texture, p, cell_value(p));
            for (int j = 0; j < lattice.ny; ++j) {
                const double low = (j - 0.5 * lattice.ny) * lattice.cell;
                lattice.values[lattice.index(i, j, k)] = static_cast<float>(
                    edge * opacity_of_cell(plane, parts, low, low + lattice.cell));
            }
        }
    });
    return lattice;
}

double column_opacity(const SkyPlane& plane, const PlaneParts& parts, const glm::dvec3& place) {
    constexpr int kHeights = 32;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i)
        sum += opacity_in_slab(plane, parts, 2 * (i + 0.5) / kHeights - 1);
    return edge_of(plane, place) * sum / kHeights;
}

ReadyParticles particles_of(LatticeField opacity, double density, int threads) {
    for (float& value : opacity.values)
        value =
            value > kLeastOpacity ? static_cast<float>(density * static_cast<double>(value)) : 0.0f;
    LatticeOptions options;
    options.sharpen = true;
    return lattice_particles(opacity, options, threads);
}

}  // namespace awan::ellipsoids
