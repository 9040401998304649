#include "core/scene/ellipsoids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace awan {

template <>
const Table& table_of<EllipsoidsCloud>() {
    return kEllipsoidsTable;
}

namespace {

// Turns the axes i and j so that a, symmetric, loses its element between them (Jacobi); v turns along.
void rotate_away(glm::dmat3& a, glm::dmat3& v, int i, int j) {
    const double off = a[i][j];
    if (off == 0) return;
    const double theta = (a[j][j] - a[i][i]) / (2 * off);
    const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double at_i = a[k][i], at_j = a[k][j];
        a[k][i] = c * at_i - s * at_j;
        a[k][j] = s * at_i + c * at_j;
    }
    for (int k = 0; k < 3; ++k) {
        const double of_i = a[i][k], of_j = a[j][k];
        a[i][k] = c * of_i - s * of_j;
        a[j][k] = s * of_i + c * of_j;
    }
    const glm::dvec3 old = v[i];
    v[i] = c * old - s * v[j];
    v[j] = s * old + c * v[j];
}

}  // namespace

std::optional<QuadricShape> shape_of(const Quadric& q) {
    // x . m x + linear . x + q0 = 0 in our axes.
    glm::dmat3 m = {
        {q.q1, q.q6 / 2, q.q4 / 2}, {q.q6 / 2, q.q3, q.q5 / 2}, {q.q4 / 2, q.q5 / 2, q.q2}};
    const double size = std::max({std::abs(q.q1), std::abs(q.q2), std::abs(q.q3)});
    if (!(size > 0)) return std::nullopt;
    // Only what coefficients are to each other counts.
    const double by = (q.q1 < 0 ? -1 : 1) / size;
    m *= by;
    const glm::dvec3 linear = by * glm::dvec3(q.q7, q.q9, q.q8);
    QuadricShape shape;
    glm::dmat3 diagonal = m;
    constexpr int kSweeps = 12;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotate_away(diagonal, shape.axes, 0, 1);
        rotate_away(diagonal, shape.axes, 0, 2);
        rotate_away(diagonal, shape.axes, 1, 2);
    }
    const glm::dvec3 stretch(diagonal[0][0], diagonal[1][1], diagonal[2][2]);
    if (!(std::min({stretch.x, stretch.y, stretch.z}) > 0)) return std::nullopt;
    // Along its own axes: stretch u^2 + along u + q0, a square each.
    const glm::dvec3 along = glm::transpose(shape.axes) * linear;
    const glm::dvec3 middle = -0.5 * along / stretch;
    const double left = glm::dot(stretch, middle * middle) - by * q.q0;
    if (!(left > 0)) return std::nullopt;
    shape.center = shape.axes * middle;
    for (int axis = 0; axis < 3; ++axis) shape.radii[axis] = std::sqrt(left / stretch[axis]);
    return shape;
}

std::uint64_t most_particles(const EllipsoidsCloud& cloud) {
    // A draft that cannot be asks for more than there may be.
    if (cloud.resolution > limits::kMaxLatticeResolution ||
        (cloud.plane && cloud.plane->resolution > limits::kMaxPlaneResolution))
        return limits::kMaxParticles + 1;
    const bool solid = !cloud.plane || !cloud.formations.empty() || !cloud.ellipsoids.empty() ||
                       !cloud.quadrics.empty();
    std::uint64_t most = solid ? cloud.resolution * cloud.resolution * cloud.resolution : 0;
    if (cloud.plane) {
        const SkyPlane& plane = *cloud.plane;
        const auto side = static_cast<double>(plane.resolution);
        const double layers = std::ceil(plane.thickness / plane.extent * side);
        most += plane.resolution * plane.resolution *
                static_cast<std::uint64_t>(std::min(std::max(1.0, layers), side));
    }
    return most;
}

}  // namespace awan
