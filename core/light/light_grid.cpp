#include "core/light/light_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/survey/projection.h"

namespace awan {

glm::dvec3 LightGrid::place(glm::dvec3 p) const {
    const glm::dvec3 d = p - origin;
    return {glm::dot(d, u) / texel, glm::dot(d, v) / texel, glm::dot(d, w) / slab};
}

LightGrid light_grid(const ParticleSet& particles, glm::dvec3 to_light) {
    LightGrid grid;
    const SideAxes axes = side_axes(to_light);
    grid.u = axes.u;
    grid.v = axes.v;
    grid.w = -to_light;
    const glm::dvec3 base = particles.center[0];
    glm::dvec3 low(0), high(0);
    double sum_s2 = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = 0.5 * static_cast<double>(particles.radius[i]);
        const glm::dvec3 p = particles.center[i] - base;
        const glm::dvec3 q(glm::dot(p, grid.u), glm::dot(p, grid.v), glm::dot(p, grid.w));
        low = i == 0 ? q - 4 * s : glm::min(low, q - 4 * s);
        high = i == 0 ? q + 4 * s : glm::max(high, q + 4 * s);
        sum_s2 += s * s;
    }
    const double typical = std::sqrt(sum_s2 / static_cast<double>(particles.size()));
    const glm::dvec3 size = high - low;
    const double widest = std::max(size.x, size.y);
    const int side = static_cast<int>(std::clamp(std::ceil(widest / typical * kTexelsPerS),
                                                 static_cast<double>(kMinLightTexels),
                                                 static_cast<double>(kMaxLightTexels)));
    grid.texel = widest / (side - 1);
    const int slabs = static_cast<int>(std::clamp(std::ceil(size.z / typical * kTexelsPerS), 8.0,
                                                  static_cast<double>(kMaxLightSlabs)));
    grid.cells.x = std::clamp(static_cast<int>(std::ceil(size.x / grid.texel)) + 1, 2, side);
    grid.cells.y = std::clamp(static_cast<int>(std::ceil(size.y / grid.texel)) + 1, 2, side);
    grid.cells.z = (slabs + 7) / 8 * 8;
    grid.slab = size.z / (grid.cells.z - 1);
    grid.origin = base + grid.u * low.x + grid.v * low.y + grid.w * low.z;
    return grid;
}

}  // namespace awan
