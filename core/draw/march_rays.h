// What the march does once a pixel, sixteen pixels at a time: directions, phase functions, sky. Bodies are inlined into
// one function a target in march_block.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

#include "core/draw/march_block.h"
#include "core/shaders/shared.h"

namespace awan {

// The rays of a block: through slopes (u0 + du x, v0 + dv y) for pixel coordinates (x, y) from its corner. `right`, `up`
// and `forward`, its middle ray, are unit, in the eye's frame.
struct BlockFrame {
    double u0, du, v0, dv;
    glm::dvec3 right{0}, up{0}, forward{0};
};

// Directions less the middle ray's, in the block's frame: small differences, hence in double.
AWAN_INLINE void directions(const BlockFrame& f, const float* x, const float* y,
                            simd::Floats to[3]) {
    float out[3][simd::kLanes];
    const double fx = f.forward.x, fy = f.forward.y, fz = f.forward.z, rx = f.right.x,
                 ry = f.right.y, rz = f.right.z, ux = f.up.x, uy = f.up.y, uz = f.up.z;
    for (int i = 0; i < simd::kLanes; ++i) {
        const double u = f.u0 + f.du * static_cast<double>(x[i]);
        const double v = f.v0 + f.dv * static_cast<double>(y[i]);
        const double n = 1 / __builtin_sqrt(1 + u * u + v * v);
        const double a = u * n - fx, b = v * n - fy, c = n - fz;
        out[0][i] = static_cast<float>(a * rx + b * ry + c * rz);
        out[1][i] = static_cast<float>(a * ux + b * uy + c * uz);
        out[2][i] = static_cast<float>(-0.5 * (a * a + b * b + c * c));  // both are unit
    }
    for (int axis = 0; axis < 3; ++axis) std::memcpy(&to[axis], out[axis], sizeof out[axis]);
}

// The sun's direction less the middle ray's, in the block's frame.
struct SunInBlock {
    float x, y, z;
};

// Lengths of direction - sun and direction + sun.
struct Chords {
    simd::Floats ahead, behind;
};
AWAN_INLINE Chords chords(const SunInBlock& sun, const simd::Floats ray[3]) {
    const simd::Floats ax = ray[0] - sun.x, ay = ray[1] - sun.y, az = ray[2] - sun.z;
    const simd::Floats bx = ray[0] + sun.x, by = ray[1] + sun.y, bz = ray[2] + (2.0f + sun.z);
    return {simd::sqrt(ax * ax + ay * ay + az * az), simd::sqrt(bx * bx + by * by + bz * bz)};
}

// rest_of_phase (march_phase.h).
AWAN_INLINE simd::Floats rest_of_phase(const RestOfPhase& rest, const Chords& c) {
    const simd::Floats mu = 1.0f - 0.5f * c.ahead * c.ahead;
    if (!rest.moments.empty()) {
        simd::Floats sum{}, p = simd::all(1.0f), before{};
        for (std::size_t l = 0; l < rest.moments.size(); ++l) {
            const auto n = static_cast<float>(l);
            sum += static_cast<float>(rest.moments[l]) * p;
            const simd::Floats next = ((2 * n + 1) * mu * p - n * before) * (1.0f / (n + 1));
            before = p;
            p = next;
        }
        return sum;
    }
    const auto g = static_cast<float>(rest.medium.g);
    const float size = std::abs(g);
    const auto short_of = static_cast<float>(1 - std::abs(rest.medium.g));
    const simd::Floats chord = g >= 0 ? c.ahead : c.behind;
    const simd::Floats base = short_of * short_of + size * chord * chord;
    simd::Floats p = (0.0795774715f * short_of * (1.0f + size)) / (base * simd::sqrt(base));
    if (rest.medium.phase == PhaseFunction::kCornetteShanks)
        p *= (1.5f / (2.0f + g * g)) * (1.0f + mu * mu);
    return p;
}

// The peak table's rows at sixteen angles (row_at of march_phase.h): to[column], an angle a lane.
AWAN_INLINE void rows_of(const PeakTable& table, const Chords& c, simd::Floats* to) {
    const simd::Floats u = simd::min(c.ahead, c.behind) * static_cast<float>(1 / table.fold);
    const auto most = static_cast<float>(2 * table.half);
    const simd::Floats fold =
        simd::log(u + simd::sqrt(u * u + 1.0f)) * static_cast<float>(table.rows_per);  // asinh
    const simd::Floats at = simd::min(
        simd::max(c.behind < c.ahead ? most - fold : fold, simd::Floats{}), simd::all(most));
    const int end = 2 * table.half - 1;
    const int low = std::min(static_cast<int>(simd::smallest(at)), end);
    const int high = std::min(static_cast<int>(simd::largest(at)), end);
    const auto columns = static_cast<std::size_t>(table.columns);
    const float* const values = table.values.data();
    // A piecewise linear function is its first value and the sum of its pieces' rises, as far as each is climbed.
    const float* const first = values + static_cast<std::size_t>(low) * columns;
    for (std::size_t k = 0; k < columns; ++k) to[k] = simd::all(first[k]);
    for (int row = low; row <= high; ++row) {
        const simd::Floats climbed =
            simd::min(simd::max(at - static_cast<float>(row), simd::Floats{}), simd::all(1.0f));
        const float* const a = values + static_cast<std::size_t>(row) * columns;
        const float* const b = a + columns;
        for (std::size_t k = 0; k < columns; ++k) to[k] += climbed * (b[k] - a[k]);
    }
}

// How a tile's pixels end: what the march found, and what is behind: `backdrop` (three colours, and 1 or 0: whether the
// forward peak brings them), or, where that is null, the sky's gradient. [lane][channel].
AWAN_INLINE void finish(const SkyBehind& sky, const simd::Floats* backdrop, float scaled,
                        const simd::Floats& up, const simd::Floats& depth,
                        const simd::Floats radiance[3], float (*to)[4]) {
    float alpha[simd::kLanes], light[3][simd::kLanes];
    simd::Floats behind{};
    const simd::Floats e = simd::exp(-depth);
    const simd::Floats opaque = simd::one_minus(e, depth);
    if (sky.behind) behind = e;
    // exp(-k tau) - exp(-tau) without cancellation, k < 1.
    if (sky.peak) {
        const simd::Floats rest = (1.0f - scaled) * depth;
        const simd::Floats through =
            simd::exp(-scaled * depth) * simd::one_minus(simd::exp(-rest), rest);
        behind += backdrop != nullptr ? through * backdrop[3] : through;
    }
    float share[simd::kLanes];  // of the zenith's colour
    std::memcpy(share, &up, sizeof share);
    if (backdrop == nullptr && (sky.behind || sky.peak))
        for (float& one : share)
            one = shader::sky_radiance(one, shader::vec3(1.0f), shader::vec3(0.0f)).x;
    simd::Floats high;
    std::memcpy(&high, share, sizeof high);
    for (int c = 0; c < 3; ++c) {
        const simd::Floats sum =
            radiance[c] + behind * (backdrop != nullptr
                                        ? backdrop[c]
                                        : sky.horizon[c] + (sky.zenith[c] - sky.horizon[c]) * high);
        std::memcpy(light[c], &sum, sizeof sum);
    }
    std::memcpy(alpha, &opaque, sizeof alpha);
    for (int lane = 0; lane < simd::kLanes; ++lane) {
        for (int c = 0; c < 3; ++c) to[lane][c] = light[c][lane];
        to[lane][3] = sky.behind ? 1.0f : alpha[lane];
    }
}

}  // namespace awan
