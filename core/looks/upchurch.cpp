#include "core/looks/upchurch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/generate/keyed_random.h"

namespace awan::upchurch {

CellStyle style_of(const AutomatonDrawing& drawing, double density) {
    if (drawing.mode == AutomatonMode::kPresence) return {1, 1, drawing.point_size};
    const bool point = drawing.mode == AutomatonMode::kDensity;
    return {std::min(drawing.color_multiplier * density, 1.0),
            std::min(drawing.opacity * density, 1.0),
            point ? drawing.point_size : drawing.billboard_scale * density};
}

Axes axes_of(const glm::dvec3& q) {
    // With z forward the frame is left-handed, so products are taken in the order that keeps right to the right.
    glm::dvec3 right(q.z, 0, -q.x);
    // Straight above or below the eye the camera's up names no side.
    if (!(glm::length(right) > 1e-9 * glm::length(q))) right = {1, 0, 0};
    right = glm::normalize(right);
    return {right, glm::normalize(glm::cross(q, right))};
}

Painted painted(std::vector<float> texels) {
    Painted all;
    all.side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(texels.size()))));
    all.levels.push_back(std::move(texels));
    for (auto side = static_cast<std::size_t>(all.side) / 2; side >= 1; side /= 2) {
        const std::vector<float>& finer = all.levels.back();
        std::vector<float> means;
        means.reserve(side * side);
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x) {
                const float* const at = &finer[4 * side * y + 2 * x];
                means.push_back(0.25F * (at[0] + at[1] + at[2 * side] + at[2 * side + 1]));
            }
        all.levels.push_back(std::move(means));
    }
    return all;
}

float sample(const Painted& texture, int level, float u, float v) {
    const std::vector<float>& texels = texture.levels[static_cast<std::size_t>(level)];
    const int side = texture.side >> level;
    const float x = u * static_cast<float>(side) - 0.5F, y = v * static_cast<float>(side) - 0.5F;
    if (!(x > -1 && y > -1 && x < static_cast<float>(side) && y < static_cast<float>(side)))
        return 0;
    // x and y are over -1.
    const int i = static_cast<int>(x + 1) - 1, j = static_cast<int>(y + 1) - 1;
    const float right = x - static_cast<float>(i), below = y - static_cast<float>(j);
    const auto at = [&](int column, int row) {
        const bool in = column >= 0 && row >= 0 && column < side && row < side;
        return in ? texels[static_cast<std::size_t>(row * side + column)] : 0.0F;
    };
    const float upper = at(i, j) + right * (at(i + 1, j) - at(i, j));
    const float lower = at(i, j + 1) + right * (at(i + 1, j + 1) - at(i, j + 1));
    return upper + below * (lower - upper);
}

std::size_t texture_of_cell(std::size_t i, std::size_t j, std::size_t k, std::size_t count) {
    // At most 1024 of each.
    return static_cast<std::size_t>(mix_bits(i | j << 10 | k << 20) % count);
}

}  // namespace awan::upchurch
