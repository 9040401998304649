#include "core/light/light_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/generate/gaussian.h"
#include "core/survey/projection.h"

namespace awan {

glm::dvec3 LightGrid::place(glm::dvec3 p) const {
    const glm::dvec3 d = p - origin;
    return {glm::dot(d, u) / texel, glm::dot(d, v) / texel, glm::dot(d, w) / slab};
}

namespace {

// A box in the grid's axes around all particles out to 4 s, and how large they are.
struct Extent {
    glm::dvec3 base, low, high;
    double typical_s;
};

Extent extent_of(const ParticleSet& particles, const LightGrid& grid) {
    Extent extent{particles.center[0], glm::dvec3(0), glm::dvec3(0), 0};
    double sum_s2 = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i);
        const glm::dvec3 p = particles.center[i] - extent.base;
        const glm::dvec3 q(glm::dot(p, grid.u), glm::dot(p, grid.v), glm::dot(p, grid.w));
        extent.low = i == 0 ? q - 4 * s : glm::min(extent.low, q - 4 * s);
        extent.high = i == 0 ? q + 4 * s : glm::max(extent.high, q + 4 * s);
        sum_s2 += s * s;
    }
    extent.typical_s = std::sqrt(sum_s2 / static_cast<double>(particles.size()));
    return extent;
}

void set_cells(LightGrid& grid, const Extent& extent, double texels_per_s) {
    const glm::dvec3 size = extent.high - extent.low;
    const double widest = std::max(size.x, size.y);
    const auto count = [&](double length, double per_s, double least, double most) {
        return static_cast<int>(
            std::clamp(std::ceil(length / extent.typical_s * per_s), least, most));
    };
    const int side = count(widest, texels_per_s, kMinLightTexels, kMaxLightTexels);
    grid.texel = widest / (side - 1);
    grid.cells.x = std::clamp(static_cast<int>(std::ceil(size.x / grid.texel)) + 1, 2, side);
    grid.cells.y = std::clamp(static_cast<int>(std::ceil(size.y / grid.texel)) + 1, 2, side);
    grid.cells.z = (count(size.z, texels_per_s * kSlabsPerTexel, 8, kMaxLightSlabs) + 7) / 8 * 8;
    grid.slab = size.z / (grid.cells.z - 1);
}

double work_of(const ParticleSet& particles, const LightGrid& grid) {
    double bricks = 0;
    for (const float radius : particles.radius) {
        const double s = 0.5 * static_cast<double>(radius);
        const double across = std::min(s / grid.texel + 1, grid.cells.x / 8.0 + 1);
        bricks += across * across * std::min(0.47 * s / grid.slab + 1, grid.cells.z / 8.0);
    }
    return bricks;
}

}  // namespace

LightGrid light_grid(const ParticleSet& particles, glm::dvec3 to_light) {
    LightGrid grid;
    const SideAxes axes = side_axes(to_light);
    grid.u = axes.u;
    grid.v = axes.v;
    grid.w = -to_light;
    const Extent extent = extent_of(particles, grid);
    for (const double per_s : kTexelsPerS) {
        set_cells(grid, extent, per_s);
        if (work_of(particles, grid) <= kMaxLightWork) break;
    }
    grid.origin =
        extent.base + grid.u * extent.low.x + grid.v * extent.low.y + grid.w * extent.low.z;
    return grid;
}

}  // namespace awan
