#include "core/light/diffusion.h"

#include <algorithm>
#include <cmath>

#include "core/base/float_runs.h"
#include "core/base/instruction_sets.h"

namespace awan {
namespace {

// Keeps the conductance of empty cells finite: over so few cells light does not diffuse but streams.
constexpr float kStreaming = 0.75F;

using Vector = std::vector<float>;

// to = operator from. The vectors have one layer of zeros before and after, so that no neighbour is out of bounds;
// conductances are 0 across the sides.
AWAN_INLINE void apply_body(const float* diagonal, const float* gx, const float* gy,
                            const float* gz, std::size_t row, std::size_t layer, const float* from,
                            std::size_t count, float* to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = diagonal[i] * from[i] - gx[i] * from[i + 1] - gy[i] * from[i + row] -
                gz[i] * from[i + layer];
    for (std::size_t i = 1; i < count; ++i) to[i] -= gx[i - 1] * from[i - 1];
    for (std::size_t i = row; i < count; ++i) to[i] -= gy[i - row] * from[i - row];
    for (std::size_t i = layer; i < count; ++i) to[i] -= gz[i - layer] * from[i - layer];
}
AWAN_KERNEL(void, apply,
            (const float* diagonal, const float* gx, const float* gy, const float* gz,
             std::size_t row, std::size_t layer, const float* from, std::size_t count, float* to),
            (diagonal, gx, gy, gz, row, layer, from, count, to))

AWAN_INLINE void step_body(float a, const float* p, const float* q, float* x, float* r,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        x[i] += a * p[i];
        r[i] -= a * q[i];
    }
}
AWAN_KERNEL(void, step,
            (float a, const float* p, const float* q, float* x, float* r, std::size_t count),
            (a, p, q, x, r, count))

AWAN_INLINE void turn_body(float b, const float* z, float* p, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) p[i] = z[i] + b * p[i];
}
AWAN_KERNEL(void, turn, (float b, const float* z, float* p, std::size_t count), (b, z, p, count))

AWAN_INLINE void multiply_body(const float* a, const float* b, float* to, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) to[i] = a[i] * b[i];
}
AWAN_KERNEL(void, multiply, (const float* a, const float* b, float* to, std::size_t count),
            (a, b, to, count))

}  // namespace

Diffusion make_diffusion(const glm::ivec3& cells, const glm::vec3& sides,
                         std::span<const float> depth, std::span<const float> scattered,
                         double forward) {
    Diffusion diffusion;
    diffusion.cells = cells;
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y),
               nz = static_cast<std::size_t>(cells.z);
    const auto cosine = static_cast<float>(forward);
    Vector transport(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        transport[i] = std::max(depth[i] - cosine * scattered[i], 0.F);
    diffusion.diagonal.resize(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        diffusion.diagonal[i] = std::max(depth[i] - scattered[i], 0.F);
    const std::size_t stride[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vector& across = diffusion.across[axis];
        const float side = sides[static_cast<int>(axis)], per_side = 1 / side;
        across.assign(depth.size(), 0.F);
        for (std::size_t i = 0; i < depth.size(); ++i) {
            const std::size_t at = i / stride[axis] % count[axis];
            // An outer face, by Marshak's condition: half a cell's way, and behind it only what leaves.
            const float out = per_side / (1.5F * side * transport[i] + 2);
            if (at == 0) diffusion.diagonal[i] += out;
            if (at + 1 == count[axis]) {
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
    const auto row = static_cast<std::size_t>(diffusion.cells.x);
    const std::size_t layer = row * static_cast<std::size_t>(diffusion.cells.y);
    std::fill(value.begin(), value.end(), 0.F);
    Vector residual(source.begin(), source.end()), scaled(count), product(count), inverse(count);
    Vector direction(count + layer);  // zeros beyond the end
    for (std::size_t i = 0; i < count; ++i) inverse[i] = 1 / diffusion.diagonal[i];
    const double goal = tolerance * tolerance * dot_product(source.data(), source.data(), count);
    if (!(goal > 0)) return;
    multiply(residual.data(), inverse.data(), scaled.data(), count);
    std::copy(scaled.begin(), scaled.end(), direction.begin());
    double rz = dot_product(residual.data(), scaled.data(), count);
    for (int i = 0; i < kMaxDiffusionSteps; ++i) {
        apply(diffusion.diagonal.data(), diffusion.across[0].data(), diffusion.across[1].data(),
              diffusion.across[2].data(), row, layer, direction.data(), count, product.data());
        const double curvature = dot_product(direction.data(), product.data(), count);
        if (!(curvature > 0)) return;
        step(static_cast<float>(rz / curvature), direction.data(), product.data(), value.data(),
             residual.data(), count);
        if (dot_product(residual.data(), residual.data(), count) <= goal) return;
        multiply(residual.data(), inverse.data(), scaled.data(), count);
        const double next = dot_product(residual.data(), scaled.data(), count);
        turn(static_cast<float>(next / rz), scaled.data(), direction.data(), count);
        rz = next;
    }
}

}  // namespace awan
