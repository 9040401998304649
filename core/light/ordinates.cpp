#include "core/light/ordinates.h"

#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Positive nodes and weights of the 8-point Gauss-Legendre rule on (-1, 1).
constexpr std::array<double, 4> kNode = {0.18343464249564980, 0.52553240991632899,
                                         0.79666647741362674, 0.96028985649753623};
constexpr std::array<double, 4> kWeight = {0.36268378337836198, 0.31370664587788729,
                                           0.22238103445337447, 0.10122853629037626};

}  // namespace

Ordinates make_ordinates() {
    Ordinates all;
    for (std::size_t o = 0; o < kOctants; ++o) {
        Ordinates::Octant& octant = all.octants[o];
        octant.sign = {(o & 1u) != 0 ? -1 : 1, (o & 2u) != 0 ? -1 : 1, (o & 4u) != 0 ? -1 : 1};
        for (std::size_t d = 0; d < kDirections; ++d) {
            const std::size_t level = d / 4;
            // 0..pi/2
            const double azimuth = (static_cast<double>(d % 4) + 0.5) * std::numbers::pi / 8;
            const double up = kNode[level], flat = std::sqrt(1 - up * up);
            const glm::dvec3 size(flat * exact::sin(azimuth), up, flat * exact::cos(azimuth));
            for (int axis = 0; axis < 3; ++axis)
                all.cosine[static_cast<std::size_t>(axis)][d] = static_cast<float>(size[axis]);
            octant.direction[d] = size * glm::dvec3(octant.sign);
            const double weight = kWeight[level] * std::numbers::pi / 8;
            const std::array<double, 16> y = harmonics(octant.direction[d]);
            for (std::size_t m = 0; m < 16; ++m) {
                octant.value[m][d] = static_cast<float>(y[m]);
                octant.weighted[d][m] = static_cast<float>(y[m] * weight);
            }
        }
    }
    return all;
}

}  // namespace awan
