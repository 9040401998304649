#include "core/light/sharpening.h"

#include <algorithm>

namespace awan {
namespace {

// In a cell much deeper than this light changes from face to face and not evenly from cell to cell: there the
// difference of two large flows would be wrong by more than the small flow that is left.
constexpr float kTooDeep = 18;

}  // namespace

Sharpening make_sharpening(const SweepGrid& grid, const Ordinates& ordinates) {
    Sharpening made;
    made.cells = grid.cells;
    const auto nx = static_cast<std::size_t>(grid.cells.x),
               ny = static_cast<std::size_t>(grid.cells.y),
               nz = static_cast<std::size_t>(grid.cells.z);
    const std::size_t stride[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
    std::vector<float> own(grid.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float side = grid.sides[static_cast<int>(axis)];
        for (std::size_t i = 0; i < own.size(); ++i) {
            const float s = grid.depth[i];
            float sum = 0;
            for (std::size_t d = 0; d < kDirections; ++d) {
                const float c = ordinates.cosine[axis][d] / side;
                sum += ordinates.octants[0].weighted[d][0] * c / (6 * c + s);
            }
            own[i] = 0.5F * s * sum / (1 + s * s * (1 / (kTooDeep * kTooDeep)));
        }
        std::vector<float>& across = made.across[axis];
        across.assign(own.size(), 0.F);
        for (std::size_t i = 0; i < own.size(); ++i)
            if (i / stride[axis] % count[axis] + 1 < count[axis]) {
                const float a = own[i], b = own[i + stride[axis]];
                if (a > 0 && b > 0) across[i] = 2 * a * b / (a + b);
            }
    }
    // What the weights of an octant's directions add up to: pi / 2 times the first harmonic.
    constexpr float kWhole = 0.44311346F;
    for (std::vector<float>& across : made.across)
        for (float& one : across) one /= kWhole;
    return made;
}

void add_sharpening(const Sharpening& sharpening, std::span<const float> value, std::size_t every,
                    std::span<float> to) {
    const auto nx = static_cast<std::size_t>(sharpening.cells.x),
               layer = nx * static_cast<std::size_t>(sharpening.cells.y);
    const std::size_t stride[3] = {1, nx, layer};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<float>& across = sharpening.across[axis];
        for (std::size_t i = 0; i + stride[axis] < value.size(); ++i) {
            const float moved = across[i] * (value[i] - value[i + stride[axis]]);
            to[i * every] += moved;
            to[(i + stride[axis]) * every] -= moved;
        }
    }
}

}  // namespace awan
