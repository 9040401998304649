// Real spherical harmonics up to l = 3, order l^2 + l + m; the integral of each square over the sphere is 1.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace awan {

// d: unit. y is up: the polar axis, so that m = 0 harmonics depend on d.y alone.
inline std::array<double, 16> harmonics(const glm::dvec3& d) {
    const double x = d.z, y = d.x, z = d.y;  // the usual formulas' axes
    const double xx = x * x, yy = y * y, zz = z * z;
    return {0.28209479177387814,
            0.4886025119029199 * y,
            0.4886025119029199 * z,
            0.4886025119029199 * x,
            1.0925484305920792 * x * y,
            1.0925484305920792 * y * z,
            0.31539156525252005 * (3 * zz - 1),
            1.0925484305920792 * x * z,
            0.5462742152960396 * (xx - yy),
            0.5900435899266435 * y * (3 * xx - yy),
            2.890611442640554 * x * y * z,
            0.4570457994644658 * y * (5 * zz - 1),
            0.3731763325901154 * z * (5 * zz - 3),
            0.4570457994644658 * x * (5 * zz - 1),
            1.445305721320277 * z * (xx - yy),
            0.5900435899266435 * x * (xx - 3 * yy)};
}

}  // namespace awan
