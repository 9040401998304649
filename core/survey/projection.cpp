#include "core/survey/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace awan {

Interval disc_slopes(double x, double z, double radius) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double distance2 = x * x + z * z;
    const double radius2 = radius * radius;
    if (distance2 <= radius2) return {-kInfinity, kInfinity};
    if (z + radius <= 0) return {1, -1};
    // The tangent lines leave at +-asin(radius / distance) from the direction of the centre.
    const double along = std::sqrt(distance2 - radius2);
    const double low_x = along * x - radius * z, low_z = along * z + radius * x;
    const double high_x = along * x + radius * z, high_z = along * z - radius * x;
    return {low_z > 0 ? low_x / low_z : -kInfinity, high_z > 0 ? high_x / high_z : kInfinity};
}

PixelSpan pixels_between(Interval slopes, double tangent, int pixels, bool up) {
    if (slopes.low > slopes.high) return {0, -1, 0, -1};
    const double sign = up ? -1 : 1;
    const auto pixel = [&](double slope) {
        return std::clamp((sign * slope / tangent + 1) / 2 * pixels - 0.5, -1e7, 1e7);
    };
    const double low = pixel(up ? slopes.high : slopes.low);
    const double high = pixel(up ? slopes.low : slopes.high);
    return {low, high, static_cast<int>(std::ceil(std::max(low, 0.0))),
            static_cast<int>(std::floor(std::min(high, pixels - 1.0)))};
}

SideAxes side_axes(glm::dvec3 axis) {
    const double sign = std::copysign(1.0, axis.z);
    const double a = -1.0 / (sign + axis.z);
    const double b = axis.x * axis.y * a;
    return {{1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
            {b, sign + axis.y * axis.y * a, -axis.y}};
}

}  // namespace awan
