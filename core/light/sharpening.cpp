#include "core/light/sharpening.h"

#include <algorithm>
#include <array>

#include "core/base/instruction_sets.h"

namespace awan {
namespace {

// In a cell much deeper than this light changes from face to face and not evenly from cell to cell: there the
// difference of two large flows would be wrong by more than the small flow that is left.
constexpr float kTooDeep = 18;

// Of cells of the depths `s`: what each carries too much, for light whose cosines over the cell's side are c, with the
// weights w of their directions.
AWAN_INLINE void conduct_body(const float* s, const float* c, const float* w, std::size_t count,
                              float* to) {
    constexpr std::size_t kRun = 16;
    for (std::size_t from = 0; from < count; from += kRun) {
        const std::size_t n = std::min(kRun, count - from);
        float depth[kRun] = {}, sum[kRun] = {};
        std::copy_n(s + from, n, depth);
        for (std::size_t d = 0; d < kDirections; ++d)
            for (std::size_t i = 0; i < kRun; ++i) sum[i] += w[d] * c[d] / (6 * c[d] + depth[i]);
        for (std::size_t i = 0; i < n; ++i)
            to[from + i] =
                0.5F * depth[i] * sum[i] / (1 + depth[i] * depth[i] * (1 / (kTooDeep * kTooDeep)));
    }
}
AWAN_KERNEL(void, conduct,
            (const float* s, const float* c, const float* w, std::size_t count, float* to),
            (s, c, w, count, to))

// The conductance between neighbours a and b: half a cell's way each.
AWAN_INLINE void join_body(const float* a, const float* b, float scale, std::size_t count,
                           float* to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = a[i] > 0 && b[i] > 0 ? 2 * a[i] * b[i] / (a[i] + b[i]) * scale : 0.F;
}
AWAN_KERNEL(void, join, (const float* a, const float* b, float scale, std::size_t count, float* to),
            (a, b, scale, count, to))

// What goes across the faces after each cell, and what came across those before it, along one axis.
AWAN_INLINE void flow_body(const float* across, const float* value, std::size_t stride,
                           std::size_t count, float* to) {
    for (std::size_t i = 0; i + stride < count; ++i)
        to[i] += across[i] * (value[i] - value[i + stride]);
    for (std::size_t i = stride; i < count; ++i)
        to[i] -= across[i - stride] * (value[i - stride] - value[i]);
}
AWAN_KERNEL(void, flow,
            (const float* across, const float* value, std::size_t stride, std::size_t count,
             float* to),
            (across, value, stride, count, to))

}  // namespace

Sharpening make_sharpening(const SweepGrid& grid, const Ordinates& ordinates) {
    Sharpening made;
    made.cells = grid.cells;
    const auto nx = static_cast<std::size_t>(grid.cells.x),
               ny = static_cast<std::size_t>(grid.cells.y),
               nz = static_cast<std::size_t>(grid.cells.z);
    const std::size_t stride[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
    // What the weights of an octant's directions add up to: pi / 2 times the first harmonic.
    constexpr float kWhole = 0.44311346F;
    std::vector<float> own(grid.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<float, kDirections> cosine{}, weight{};
        for (std::size_t d = 0; d < kDirections; ++d) {
            cosine[d] = ordinates.cosine[axis][d] / grid.sides[static_cast<int>(axis)];
            weight[d] = ordinates.octants[0].weighted[d][0];
        }
        conduct(grid.depth.data(), cosine.data(), weight.data(), own.size(), own.data());
        std::vector<float>& across = made.across[axis];
        across.assign(own.size(), 0.F);
        // Along an axis cells stand in runs of stride * count; the last `stride` of a run have no next.
        const std::size_t run = stride[axis] * count[axis];
        for (std::size_t at = 0; at < own.size(); at += run)
            join(own.data() + at, own.data() + at + stride[axis], 1 / kWhole, run - stride[axis],
                 across.data() + at);
    }
    return made;
}

void add_sharpening(const Sharpening& sharpening, std::span<const float> value,
                    std::span<float> to) {
    const auto nx = static_cast<std::size_t>(sharpening.cells.x),
               layer = nx * static_cast<std::size_t>(sharpening.cells.y);
    const std::size_t stride[3] = {1, nx, layer};
    for (std::size_t axis = 0; axis < 3; ++axis)
        flow(sharpening.across[axis].data(), value.data(), stride[axis], value.size(), to.data());
}

}  // namespace awan
