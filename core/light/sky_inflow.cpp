#include "core/light/sky_inflow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Heights at which the levels of the quadrature end: the sums of its weights (ordinates.cpp), from the horizontal up.
constexpr std::array<double, 5> kEdge = {0, 0.362683783378362, 0.676390429256249, 0.898771463709624,
                                         1};
constexpr std::size_t kAzimuths = 4;  // of an octant
constexpr int kSamples = 6;           // along either side of a solid angle

}  // namespace

SkyInflow sky_inflow(const SkyDome& sky) {
    SkyInflow inflow;
    if (!sky.shines) return inflow;
    for (std::size_t o = 0; o < kOctants; ++o) {
        const glm::dvec3 sign((o & 1u) != 0 ? -1 : 1, (o & 2u) != 0 ? -1 : 1,
                              (o & 4u) != 0 ? -1 : 1);
        for (std::size_t d = 0; d < kDirections; ++d) {
            const std::size_t level = d / kAzimuths;
            glm::dvec3 sum(0);
            for (int i = 0; i < kSamples; ++i)
                for (int j = 0; j < kSamples; ++j) {
                    const double up =
                        kEdge[level] + (kEdge[level + 1] - kEdge[level]) * (i + 0.5) / kSamples;
                    const double azimuth =
                        (static_cast<double>(d % kAzimuths) + (j + 0.5) / kSamples) *
                        std::numbers::pi / (2 * kAzimuths);
                    const double flat = std::sqrt(1 - up * up);
                    const glm::dvec3 to(flat * exact::sin(azimuth), up, flat * exact::cos(azimuth));
                    const glm::dvec3 seen = sky_radiance(sky, sign * to);
                    inflow.most = glm::max(inflow.most, seen);
                    sum += seen;
                }
            inflow.mean[o][d] = sum / (1.0 * kSamples * kSamples);
        }
    }
    return inflow;
}

glm::dvec3 mean_from(const SkyInflow& inflow, const glm::dvec3& direction) {
    const std::size_t octant =
        (direction.x < 0 ? 1u : 0u) + (direction.y < 0 ? 2u : 0u) + (direction.z < 0 ? 4u : 0u);
    const double up = std::abs(direction.y) / glm::length(direction);
    const double azimuth = exact::atan2(std::abs(direction.x), std::abs(direction.z));  // 0..pi/2
    std::size_t level = 0;
    while (level < 3 && up > kEdge[level + 1]) ++level;
    const auto turn = std::min(
        static_cast<std::size_t>(azimuth * (2 * kAzimuths) / std::numbers::pi), kAzimuths - 1);
    return inflow.mean[octant][level * kAzimuths + turn];
}

}  // namespace awan
