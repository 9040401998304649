// How deep into the hierarchy of spheres a picture needs to go. Level of detail as the source has it ("the farther away
// the cloud is from the observer, the lower the level number which provides the desired angular resolution"), a sphere
// at a time.
#pragma once

#include <optional>

#include "core/base/deadline.h"
#include "core/generate/spheres/subdivision.h"

namespace awan {

// A sphere looks `size_of` large: its radius over the distance from the eye to its nearest point, at most 2^20 (an eye
// inside it). A child never looks larger than its parent. It is cut, and stands for all below it, where it looks
// smaller than `smallest`.
struct SphereCut {
    // 0: none is.
    double smallest = 0;
    // The cloud's own coordinates; none: from `distance` off all spheres.
    std::optional<glm::dvec3> eye;
    double distance = 1;
    // Nearer is as near as that.
    double least_distance = 0;

    double size_of(const Sphere& sphere) const;
    // A sphere that could have children smaller than particles may be is cut, too.
    bool cuts(const Sphere& sphere, const Span& ratios) const;
};

// As coarse as pixels of that angle allow (radians; 0: as fine as can be), and coarser where more than `most` spheres
// would be left. Goes once through what it keeps, the whole tree at most. Threads do not show in the result.
Result<SphereCut> choose_cut(const SphereTree& tree, const std::optional<glm::dvec3>& eye,
                             double pixel_angle, std::uint64_t most, int threads,
                             const Deadline& deadline);

}  // namespace awan
