// How random variables are distributed over their ranges (SpheresLaw).
#include <cmath>

#include "core/generate/spheres/subdivision.h"

namespace awan::spheres {
namespace {

// The Gauss-Legendre rule on 0..1; five points are exact for polynomials of degree 9.
constexpr LawPoint kGauss[] = {{0.04691007703066800, 0.11846344252809454},
                               {0.23076534494715845, 0.23931433524968324},
                               {0.5, 0.28444444444444444},
                               {0.76923465505284155, 0.23931433524968324},
                               {0.95308992296933200, 0.11846344252809454}};

// Of the share 0..1 of the way through the range.
double density(SpheresLaw law, double x) {
    switch (law) {
        case SpheresLaw::kUniform:
            return 1;
        case SpheresLaw::kFalling:
            return 2 - 2 * x;
        case SpheresLaw::kRising:
            return 2 * x;
        case SpheresLaw::kMiddle:
            return x < 0.5 ? 4 * x : 4 - 4 * x;
        case SpheresLaw::kEnds:
            return x < 0.5 ? 2 - 4 * x : 4 * x - 2;
    }
    return 1;
}

}  // namespace

// The inverse of the integral of density().
double at_share(SpheresLaw law, double u) {
    switch (law) {
        case SpheresLaw::kUniform:
            return u;
        case SpheresLaw::kFalling:
            return 1 - std::sqrt(1 - u);
        case SpheresLaw::kRising:
            return std::sqrt(u);
        case SpheresLaw::kMiddle:
            return u < 0.5 ? std::sqrt(u / 2) : 1 - std::sqrt((1 - u) / 2);
        case SpheresLaw::kEnds:
            return u < 0.5 ? 0.5 - 0.5 * std::sqrt(1 - 2 * u) : 0.5 + 0.5 * std::sqrt(2 * u - 1);
    }
    return u;
}

std::vector<LawPoint> points_of(SpheresLaw law) {
    if (law == SpheresLaw::kUniform) return {std::begin(kGauss), std::end(kGauss)};
    // Densities are straight on either half.
    std::vector<LawPoint> points;
    for (const double half : {0.0, 0.5})
        for (const LawPoint& one : kGauss) {
            const double at = half + 0.5 * one.at;
            points.push_back({at, 0.5 * one.weight * density(law, at)});
        }
    return points;
}

double mean_of_power(const Span& span, SpheresLaw law, int power) {
    const double low = span.low, high = span.high;
    if (law == SpheresLaw::kUniform && power == 2)
        return (low * low + low * high + high * high) / 3;
    if (law == SpheresLaw::kUniform && power == 3)
        return (low + high) * (low * low + high * high) / 4;
    double mean = 0;
    for (const LawPoint& point : points_of(law)) {
        const double x = low + (high - low) * point.at;
        double of = 1;
        for (int k = 0; k < power; ++k) of *= x;
        mean += point.weight * of;
    }
    return mean;
}

}  // namespace awan::spheres
