#include "core/scene/ellipsoids.h"

#include <algorithm>
#include <cmath>

namespace awan {

template <>
const Table& table_of<EllipsoidsCloud>() {
    return kEllipsoidsTable;
}

std::uint64_t most_particles(const EllipsoidsCloud& cloud) {
    // A draft that cannot be asks for more than there may be.
    if (cloud.resolution > limits::kMaxLatticeResolution ||
        (cloud.plane && cloud.plane->resolution > limits::kMaxPlaneResolution))
        return limits::kMaxParticles + 1;
    const bool solid = !cloud.plane || !cloud.formations.empty() || !cloud.ellipsoids.empty();
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
