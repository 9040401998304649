#include "core/survey/narrow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// E1(z), z >= 4, by its continued fraction from the far end (Abramowitz & Stegun 1964, 5.1.22). Relative error < 1e-14.
double exponential_integral(double z) {
    double below = z + 101;
    for (int n = 50; n > 0; --n) below = z + 2 * n - 1 - static_cast<double>(n * n) / below;
    return exact::exp(-z) / below;
}

}  // namespace

double least_width(double depth) {
    return kLeastWidth + 0.06 * exact::log1p(std::clamp(depth, 0.0, 1e9));
}

double covered_area(double depth) {
    const double z = std::clamp(depth, 0.0, 1e300);
    // Ein(z) = ln z + gamma + E1(z); for small z by its series, the sum of -(-z)^n / (n n!).
    if (z > 4) return exact::log(z) + std::numbers::egamma + exponential_integral(z);
    double sum = 0, power = -1;
    for (int n = 1; n < 40; ++n) {
        power *= -z / n;
        sum += power / n;
        if (std::abs(power) < 1e-12 * sum) break;
    }
    return sum;
}

double depth_covering(double area) {
    if (!(area > 0)) return 0;
    // Ein(z) is about z (1 - z / 4) for small z, and ln z + gamma for large ones.
    double z = area < 2 ? area * (1 + 0.25 * area)
                        : exact::exp(std::min(area - std::numbers::egamma, 690.0));
    // Newton's method; Ein is concave, and so all but the first of its steps only rise towards the root.
    for (int i = 0; i < 8; ++i) {
        const double slope = z < 1e-8 ? 1 - z / 2 : -exact::expm1(-z) / z;
        const double next = std::max(z + (area - covered_area(z)) / slope, 0.5 * z);
        const bool done = std::abs(next - z) < 1e-7 * z;
        z = next;
        if (done) break;
    }
    return z;
}

double widened_depth(double depth, double wider) {
    if (!(wider > 1)) return depth;
    return depth_covering(covered_area(depth) / (wider * wider));
}

}  // namespace awan
