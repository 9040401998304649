// Real spherical harmonics up to l = 3: how the light's dependence on direction is written down.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace awan {

// Legendre orders that the light grid resolves: l = 0..L with L = 3.
inline constexpr int kOrders = 4;
// Harmonics of those orders, in the order l^2 + l + m.
inline constexpr int kHarmonics = kOrders * kOrders;

// The order l of each harmonic.
inline constexpr std::array<std::size_t, kHarmonics> kOrderOf = {0, 1, 1, 1, 2, 2, 2, 2,
                                                                 2, 3, 3, 3, 3, 3, 3, 3};

// The value of each harmonic towards d (unit), normalised so that the integral of its square over the sphere is 1.
// The polar axis is y, which is up: harmonics with m = 0 depend on d.y alone.
inline std::array<double, kHarmonics> harmonics(const glm::dvec3& d) {
    // The usual formulas have z as their polar axis.
    const double x = d.z, y = d.x, z = d.y;
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
