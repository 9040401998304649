// How deep into the hierarchy of spheres a picture needs to go, a sphere at a time. It is the level of detail of
// Ostroushko et al. 2010: "the farther away the cloud is from the observer, the lower the level number which provides
// the desired angular resolution".
#pragma once

#include <optional>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/subdivision.h"

namespace awan::spheres {

// A sphere looks `size_of` large: its radius over the distance from the eye to its nearest point, at most 2^20 (for
// an eye inside it). A child never looks larger than its parent. A sphere that looks smaller than `smallest` is cut:
// it stands for all below it.
struct SphereCut {
    // At 0 nothing is cut.
    double smallest = 0;
    // In the cloud's own coordinates. Without one, all spheres are `distance` away.
    std::optional<glm::dvec3> eye;
    double distance = 1;
    // What is nearer than this counts as this near.
    double least_distance = 0;

    double size_of(const Sphere& sphere) const;
    // Whether a sphere is cut. One whose children may be smaller than particles may be is cut, too.
    bool cuts(const Sphere& sphere, const Span& ratios) const;
};

// The cut that is as coarse as pixels of that angle allow (radians; 0: as fine as can be), and coarser where more
// than `most` spheres would be left. Goes once through what it keeps, the whole tree at most. Threads do not show in
// the result.
Result<SphereCut> choose_cut(const SphereTree& tree, const std::optional<glm::dvec3>& eye,
                             double pixel_angle, std::uint64_t most, int threads,
                             const Deadline& deadline);

// What a sphere's leaves hide less than the one Gaussian that stands for them, over what that hides: matter in lumps
// leaves gaps. moments: cluster_moments() of the tree; radius: of the sphere; below: levels below it, >= 1; sigma: the
// leaves' extinction, 1/unit. 0..1.
double lost_in_lumps(const SphereTree& tree, const std::vector<ClusterMoments>& moments,
                     double radius, int below, double sigma);

}  // namespace awan::spheres
