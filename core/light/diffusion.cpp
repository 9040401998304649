#include "core/light/diffusion.h"

#include <algorithm>
#include <cmath>

#include "core/base/aligned_floats.h"
#include "core/base/float_runs.h"
#include "core/base/instruction_sets.h"

namespace awan {
namespace {

// Keeps the conductance of empty cells finite: over so few cells light does not diffuse but streams.
constexpr float kStreaming = 0.75F;

// Floats of a block: what one step leaves in a processor's near cache, the next takes from there.
constexpr std::size_t kBlock = 4096;

using Vector = AlignedFloats;

// to = operator from, of the cells first..last-1. `from` has a layer of zeros behind it, so that no neighbour is out of
// bounds; conductances are 0 across the sides.
AWAN_INLINE void apply_body(const Diffusion& diffusion, const float* from, std::size_t first,
                            std::size_t last, float* to) {
    const float *diagonal = diffusion.diagonal.data(), *gx = diffusion.across[0].data(),
                *gy = diffusion.across[1].data(), *gz = diffusion.across[2].data();
    const auto row = static_cast<std::size_t>(diffusion.cells.x);
    const std::size_t layer = row * static_cast<std::size_t>(diffusion.cells.y);
    std::size_t i = first;
    for (; i < std::min(last, layer); ++i) {
        to[i] = diagonal[i] * from[i] - gx[i] * from[i + 1] - gy[i] * from[i + row] -
                gz[i] * from[i + layer];
        if (i >= 1) to[i] -= gx[i - 1] * from[i - 1];
        if (i >= row) to[i] -= gy[i - row] * from[i - row];
    }
    for (; i < last; ++i)
        to[i] = diagonal[i] * from[i] - gx[i] * from[i + 1] - gy[i] * from[i + row] -
                gz[i] * from[i + layer] - gx[i - 1] * from[i - 1] - gy[i - row] * from[i - row] -
                gz[i - layer] * from[i - layer];
}
AWAN_KERNEL(void, apply,
            (const Diffusion& diffusion, const float* from, std::size_t first, std::size_t last,
             float* __restrict to),
            (diffusion, from, first, last, to))

AWAN_INLINE void step_body(float a, const float* __restrict p, const float* __restrict q,
                           const float* __restrict inverse, float* __restrict x,
                           float* __restrict r, float* __restrict scaled, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        x[i] += a * p[i];
        r[i] -= a * q[i];
        scaled[i] = r[i] * inverse[i];
    }
}
AWAN_KERNEL(void, step,
            (float a, const float* __restrict p, const float* __restrict q,
             const float* __restrict inverse, float* __restrict x, float* __restrict r,
             float* __restrict scaled, std::size_t count),
            (a, p, q, inverse, x, r, scaled, count))

AWAN_INLINE void turn_body(float b, const float* __restrict z, float* __restrict p,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) p[i] = z[i] + b * p[i];
}
AWAN_KERNEL(void, turn,
            (float b, const float* __restrict z, float* __restrict p, std::size_t count),
            (b, z, p, count))

// The sum of what `work` gives for the blocks of `count` cells, each first and last + 1.
template <typename Work>
double sum_over_blocks(std::size_t count, const Work& work) {
    double sum = 0;
    for (std::size_t first = 0; first < count; first += kBlock)
        sum += work(first, std::min(first + kBlock, count));
    return sum;
}

}  // namespace

Diffusion make_diffusion(const glm::ivec3& cells, const glm::vec3& sides,
                         std::span<const float> depth, std::span<const float> scattered,
                         double forward) {
    Diffusion diffusion;
    diffusion.cells = cells;
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y),
               nz = static_cast<std::size_t>(cells.z);
    const auto cosine = static_cast<float>(forward);
    std::vector<float> transport(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        transport[i] = std::max(depth[i] - cosine * scattered[i], 0.F);
    diffusion.diagonal.resize(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        diffusion.diagonal[i] = std::max(depth[i] - scattered[i], 0.F);
    const std::size_t stride[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float>& across = diffusion.across[axis];
        const float side = sides[static_cast<int>(axis)], per_side = 1 / side;
        across.assign(depth.size(), 0.F);
        // Along an axis cells stand in runs of stride * count.
        const std::size_t run = stride[axis] * count[axis];
        for (std::size_t i = 0, in_run = 0; i < depth.size(); ++i, ++in_run) {
            if (in_run == run) in_run = 0;
            const bool last = in_run >= run - stride[axis];
            // An outer face, by Marshak's condition: half a cell's way, and behind it only what leaves.
            const float out = per_side / (1.5F * side * transport[i] + 2);
            if (in_run < stride[axis]) diffusion.diagonal[i] += out;
            if (last) {
                diffusion.diagonal[i] += out;
                continue;
            }
            const std::size_t next = i + stride[axis];
            across[i] = per_side / (1.5F * side * (transport[i] + transport[next]) + kStreaming);
            diffusion.diagonal[i] += across[i];
            diffusion.diagonal[next] += across[i];
        }
    }
    return diffusion;
}

void solve_diffusion(const Diffusion& diffusion, std::span<const float> source, double tolerance,
                     std::span<float> value) {
    const std::size_t count = source.size();
    const std::size_t layer =
        static_cast<std::size_t>(diffusion.cells.x) * static_cast<std::size_t>(diffusion.cells.y);
    std::fill(value.begin(), value.end(), 0.F);
    const double goal = tolerance * tolerance * dot_product(source.data(), source.data(), count);
    if (!(goal > 0)) return;
    Vector residual(source.begin(), source.end()), scaled(count), product(count), inverse(count);
    Vector direction(count + layer);
    std::fill(direction.begin() + static_cast<std::ptrdiff_t>(count), direction.end(), 0.F);
    for (std::size_t i = 0; i < count; ++i) {
        inverse[i] = 1 / diffusion.diagonal[i];
        direction[i] = scaled[i] = residual[i] * inverse[i];
    }
    double rz = dot_product(residual.data(), scaled.data(), count);
    for (int i = 0; i < kMaxDiffusionSteps; ++i) {
        const double curvature = sum_over_blocks(count, [&](std::size_t first, std::size_t last) {
            apply(diffusion, direction.data(), first, last, product.data());
            return dot_product(direction.data() + first, product.data() + first, last - first);
        });
        if (!(curvature > 0)) return;
        const auto along = static_cast<float>(rz / curvature);
        double next = 0;
        const double left = sum_over_blocks(count, [&](std::size_t first, std::size_t last) {
            const std::size_t n = last - first;
            step(along, direction.data() + first, product.data() + first, inverse.data() + first,
                 value.data() + first, residual.data() + first, scaled.data() + first, n);
            next += dot_product(residual.data() + first, scaled.data() + first, n);
            return dot_product(residual.data() + first, residual.data() + first, n);
        });
        if (left <= goal) return;
        turn(static_cast<float>(next / rz), scaled.data(), direction.data(), count);
        rz = next;
    }
}

}  // namespace awan
