// What the march does once a pixel, sixteen pixels at a time: directions and phase functions. Bodies are inlined into
// one function a target in march_targets.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

#include "core/draw/march_phase.h"
#include "core/draw/march_simd.h"

namespace awan {

// The rays of a block. Pixel coordinates (x, y) from its origin are seen along slopes (u0 + du x, v0 + dv y):
// the direction (slope, slope, 1) in the eye's frame (right, up, forward). `forward` is the block's middle ray, `right`
// and `up` stand at right angles to it; all three are unit, in the eye's frame.
struct BlockFrame {
    double u0, du, v0, dv;
    glm::dvec3 right{0}, up{0}, forward{0};
};

// Unit directions of sixteen rays less the middle ray's, in the block's frame. They are small differences of large
// numbers, hence computed in double. With d = m + e, d and m unit: e . m = -|e|^2 / 2, so the third is had without
// cancellation.
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
        out[2][i] = static_cast<float>(-0.5 * (a * a + b * b + c * c));
    }
    for (int axis = 0; axis < 3; ++axis) std::memcpy(&to[axis], out[axis], sizeof out[axis]);
}

// The sun's direction (unit) less the middle ray's, in the block's frame.
struct SunInBlock {
    float x, y, z;
};

// The chords |d - s| and |d + s| between a ray's direction d and the sun's s, both unit. Phase functions take them
// instead of the cosine 1 - |d - s|^2 / 2, which would lose its digits near the sun.
struct Chords {
    simd::Floats ahead, behind;
};
AWAN_INLINE Chords chords(const SunInBlock& sun, const simd::Floats ray[3]) {
    const simd::Floats ax = ray[0] - sun.x, ay = ray[1] - sun.y, az = ray[2] - sun.z;
    const simd::Floats bx = ray[0] + sun.x, by = ray[1] + sun.y, bz = ray[2] + (2.0f + sun.z);
    return {simd::sqrt(ax * ax + ay * ay + az * az), simd::sqrt(bx * bx + by * by + bz * bz)};
}

// p1, as rest_of_phase of march_phase.h. With moments, the Legendre sum of moment_l P_l(mu) by the recurrence
//     (l + 1) P_(l+1) = (2 l + 1) mu P_l - l P_(l-1);
// without, the phase function itself: Henyey-Greenstein's, with |g| and the chord c on its peak's side, is
//     p / 4 pi = (1 - g^2) / (4 pi ((1 - g)^2 + g c^2)^(3/2)),
// Cornette & Shanks's (1992) is that times 3 (1 + mu^2) / (2 (2 + g^2)).
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
    if (rest.medium.droplets) {
        simd::Floats p{};
        for (int lane = 0; lane < simd::kLanes; ++lane)
            p[lane] =
                static_cast<float>(phase_of_chords(rest.medium, static_cast<double>(c.ahead[lane]),
                                                   static_cast<double>(c.behind[lane])));
        return p;
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

// The peak table at sixteen angles, linear between its rows (row_at of march_phase.h): to[column], an angle a lane.
// Row numbers go with asinh(u) = ln(u + sqrt(u^2 + 1)), u = chord / fold.
AWAN_INLINE void rows_of(const PeakTable& table, const Chords& c, simd::Floats* to) {
    const simd::Floats u = simd::min(c.ahead, c.behind) * static_cast<float>(1 / table.fold);
    const auto most = static_cast<float>(2 * table.half);
    const simd::Floats fold =
        simd::log(u + simd::sqrt(u * u + 1.0f)) * static_cast<float>(table.rows_per);
    const simd::Floats at = simd::min(
        simd::max(c.behind < c.ahead ? most - fold : fold, simd::Floats{}), simd::all(most));
    const int end = 2 * table.half - 1;
    const int low = std::min(static_cast<int>(simd::smallest(at)), end);
    const int high = std::min(static_cast<int>(simd::largest(at)), end);
    const auto columns = static_cast<std::size_t>(table.columns);
    const float* const values = table.values.data();
    // A piecewise linear function is its first value plus the rises of its pieces, each as far as it is climbed. So
    // lanes in different rows are done together.
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

}  // namespace awan
