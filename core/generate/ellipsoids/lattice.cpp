#include "core/generate/ellipsoids/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "core/parallel.h"

namespace awan {
namespace {

constexpr double kSpread = 0.65;  // s of a Gaussian, cells
// A cell sees the texture over a blob of this standard deviation: what is finer than two cells is gone, instead of turning up
// as something coarser.
constexpr double kCellBlur = 0.5;

std::size_t layer_size(const OpacityLattice& lattice) {
    return static_cast<std::size_t>(lattice.cells.x) * static_cast<std::size_t>(lattice.cells.z);
}

void make_room(OpacityLattice& lattice) {
    lattice.values.assign(layer_size(lattice) * static_cast<std::size_t>(lattice.cells.y), 0.0f);
}

struct Range {
    int first, last;  // last is one past
};
// Cells whose middles may lie within `half` of `center`.
Range cells_within(double center, double half, double origin, double side, int count) {
    const double low = std::floor((center - half - origin) / side - 0.5);
    const double high = std::ceil((center + half - origin) / side + 0.5);
    return {static_cast<int>(std::clamp(low, 0.0, static_cast<double>(count))),
            static_cast<int>(std::clamp(high, 0.0, static_cast<double>(count)))};
}

// Of one level layer.
void fill_layer(OpacityLattice& lattice, int y, const std::vector<PlacedEllipsoid>& ellipsoids,
                const TextureFunction& texture) {
    const double sigma = kCellBlur * lattice.cell;
    const double blur_x = blur_of_blob(texture, false, sigma),
                 blur_z = blur_of_blob(texture, true, sigma);
    // The texture of a cell is the same for all ellipsoids that hold it; mean < 0: not known yet.
    std::vector<TextureValue> known(layer_size(lattice), TextureValue{-1, 0});
    std::vector<char> seen(known.size(), 0);
    const std::size_t first = lattice.index(0, y, 0);
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        const double height = lattice.middle(0, y, 0).y - one.center.y;
        if (std::abs(height) > half.y) continue;
        const Range xs =
            cells_within(one.center.x, half.x, lattice.origin.x, lattice.cell, lattice.cells.x);
        const Range zs =
            cells_within(one.center.z, half.z, lattice.origin.z, lattice.cell, lattice.cells.z);
        for (int z = zs.first; z < zs.last; ++z)
            for (int x = xs.first; x < xs.last; ++x) {
                const glm::dvec3 p = lattice.middle(x, y, z);
                const glm::dvec3 u = one.to_unit(p);
                const double g = limb_in_space(glm::dot(u, u));
                if (g < 0) continue;
                const std::size_t at = lattice.index(x, y, z), in_layer = at - first;
                if (seen[in_layer] == 0) {
                    seen[in_layer] = 1;
                    known[in_layer] = texture_at(texture, p, blur_x, blur_z);
                }
                const double opaque = opacity(known[in_layer], threshold_at(one.translucence, g),
                                              one.translucence.range);
                lattice.values[at] = std::max(lattice.values[at], static_cast<float>(opaque));
            }
    }
}

}  // namespace

OpacityLattice lattice_of(const std::vector<PlacedEllipsoid>& ellipsoids, std::uint64_t resolution,
                          const TextureFunction& texture, int threads, const Deadline& deadline) {
    OpacityLattice lattice;
    if (ellipsoids.empty()) return lattice;
    glm::dvec3 low = ellipsoids[0].center, high = low;
    for (const PlacedEllipsoid& one : ellipsoids) {
        const glm::dvec3 half = one.half_box();
        low = glm::min(low, one.center - half);
        high = glm::max(high, one.center + half);
    }
    const glm::dvec3 size = high - low;
    const auto most = static_cast<double>(resolution);
    lattice.cell = lattice.layer = std::max({size.x, size.y, size.z}) / most;
    for (int axis = 0; axis < 3; ++axis)
        lattice.cells[axis] =
            static_cast<int>(std::clamp(std::ceil(size[axis] / lattice.cell - 1e-9), 1.0, most));
    lattice.origin = 0.5 * (low + high) - 0.5 * lattice.cell * glm::dvec3(lattice.cells);
    make_room(lattice);
    parallel_for(threads, static_cast<std::size_t>(lattice.cells.y), [&](std::size_t y) {
        if (!deadline.over()) fill_layer(lattice, static_cast<int>(y), ellipsoids, texture);
    });
    return lattice;
}

OpacityLattice lattice_of(const SkyPlane& plane, const TextureFunction& texture, int threads,
                          const Deadline& deadline) {
    OpacityLattice lattice;
    const auto side = static_cast<int>(plane.resolution);
    lattice.cell = plane.extent / side;
    const int layers = std::max(1, static_cast<int>(std::ceil(plane.thickness / lattice.cell)));
    lattice.cells = {side, layers, side};
    lattice.layer = plane.thickness / layers;
    lattice.origin = {-plane.extent / 2, plane.altitude - plane.thickness / 2, -plane.extent / 2};
    make_room(lattice);
    const double sigma = kCellBlur * lattice.cell;
    const double blur_x = blur_of_blob(texture, false, sigma),
                 blur_z = blur_of_blob(texture, true, sigma);
    parallel_for(threads, static_cast<std::size_t>(side), [&](std::size_t row) {
        if (deadline.over()) return;
        const int z = static_cast<int>(row);
        for (int x = 0; x < side; ++x) {
            const glm::dvec3 p = lattice.middle(x, 0, z);
            const double out = std::max(std::abs(p.x), std::abs(p.z)) / (plane.extent / 2);
            const double edge = std::clamp((1 - out) * 10, 0.0, 1.0);
            const TextureValue value = texture_at(texture, p, blur_x, blur_z);
            for (int y = 0; y < layers; ++y) {
                const double off = layers == 1 ? 0 : 2 * (y + 0.5) / layers - 1;
                const double threshold = plane.threshold + plane.range * off * off;
                lattice.values[lattice.index(x, y, z)] =
                    static_cast<float>(edge * opacity(value, threshold, plane.range));
            }
        }
    });
    return lattice;
}

void add_particles(const OpacityLattice& lattice, double density, ReadyParticles& particles) {
    // (2 pi)^1.5 s^3 of them fill a cell; a layer may be thinner than a cell.
    const double whole = std::pow(2 * std::numbers::pi, 1.5) * kSpread * kSpread * kSpread;
    const double scale = density / whole * (lattice.layer / lattice.cell);
    const auto radius = static_cast<float>(2 * kSpread * lattice.cell);
    for (int y = 0; y < lattice.cells.y; ++y)
        for (int z = 0; z < lattice.cells.z; ++z)
            for (int x = 0; x < lattice.cells.x; ++x) {
                const auto value = static_cast<double>(lattice.values[lattice.index(x, y, z)]);
                if (!(value >= kLeastOpacity)) continue;
                particles.positions.push_back(lattice.middle(x, y, z));
                particles.radii.push_back(radius);
                particles.densities.push_back(static_cast<float>(scale * value));
            }
}

}  // namespace awan
