// Gaussians summed at the nodes of a lattice, for looking them up between the nodes by trilinear
// interpolation.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/deadline.h"

namespace awan::truth {

// Lengths in cells; node (i, j, k) stands at (i, j, k).
struct LatticeGaussian {
    glm::dvec3 center{0};
    double s = 1;
    // It is 0 farther than cut * s from its centre.
    double cut = 5;
    double peak = 1;
};

// The smallest s that a lattice can hold; narrower Gaussians are widened to it, their mass kept.
inline constexpr double kNarrowest = 0.9;

// Values at all nodes, x fastest, then y, then z. Interpolating between nodes widens what it is given by 1/6 cell^2
// in each axis's variance; the Gaussians are narrowed by as much, so that the interpolated field has their mass and
// their width. What is left is a ripple of the cells' period and mean 0, at most peak / (4 s^2). Wide Gaussians (s >=
// 6 cells) are summed on lattices 2, 4, ... times coarser, and refined by cubic interpolation (error < 0.2% of their
// peak). Bytes do not depend on threads. Errors: kOverDeadline, kCancelled.
Result<std::vector<float>> sum_on_lattice(const glm::ivec3& nodes,
                                          std::span<const LatticeGaussian> gaussians, int threads,
                                          const Deadline& deadline);

// Trilinear; (x, y, z) in cells, clamped to the lattice. Every side has at least 2 nodes.
inline float interpolated(const float* values, const glm::ivec3& nodes, double x, double y,
                          double z) {
    x = std::clamp(x, 0.0, static_cast<double>(nodes.x - 1));
    y = std::clamp(y, 0.0, static_cast<double>(nodes.y - 1));
    z = std::clamp(z, 0.0, static_cast<double>(nodes.z - 1));
    const int i = std::min(static_cast<int>(x), nodes.x - 2);
    const int j = std::min(static_cast<int>(y), nodes.y - 2);
    const int k = std::min(static_cast<int>(z), nodes.z - 2);
    const float fx = static_cast<float>(x - i), fy = static_cast<float>(y - j),
                fz = static_cast<float>(z - k);
    const auto row = static_cast<std::size_t>(nodes.x);
    const std::size_t plane = row * static_cast<std::size_t>(nodes.y);
    const float* v = values + static_cast<std::size_t>(i) + row * static_cast<std::size_t>(j) +
                     plane * static_cast<std::size_t>(k);
    const auto along = [&](const float* p) { return p[0] + fx * (p[1] - p[0]); };
    const float a = along(v), b = along(v + row);
    const float c = along(v + plane), d = along(v + plane + row);
    const float near = a + fy * (b - a), far = c + fy * (d - c);
    return near + fz * (far - near);
}

}  // namespace awan::truth
