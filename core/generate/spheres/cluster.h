// What a sphere of the hierarchy (subdivision.h) holds, as one Gaussian: itself where it is a leaf, else all the
// leaves below it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/spheres/subdivision.h"

namespace awan::spheres {

// A leaf as a medium. Ostroushko et al. 2010 (1)-(3) let a ray at the distance d from the middle of a sphere keep
//   T f + 1 - f    of its light,    f = 1 - d/r,    T = t^l,    l = 2 sqrt(r^2 - d^2).
// That is no medium: however dense, 1 - f comes through. Its limit for thin spheres is one: the optical depth there
// is f sigma l, sigma = -ln t. Over the disc this makes
//   mass (integral of the depth)    4 pi sigma r^3 (1/3 - pi/16),
//   variance of a coordinate        r^2 / 2 * (2/15 - pi/32) / (1/3 - pi/16),    of a Gaussian s^2,
// and the leaf is the Gaussian that has both. Its depth through the middle is 2.13 sigma r; by the printed rule it is
// 2 sigma r. kLeafMass is the mass over sigma r^3.
inline constexpr double kLeafMass = 1.721389104514051;
// The variance over r^2.
inline constexpr double kLeafVariance = 0.1283311049837019;

// A unit sphere with n levels below it: means over all that is random. Masses are over that of a leaf of the same
// radius.
struct ClusterMoments {
    double mass = 1;
    // The centre of mass, from the sphere's centre.
    glm::dvec3 mean{0};
    // Mean of |x|^2, about the sphere's centre.
    double square = 3 * kLeafVariance;
};

// Element n, 0 .. levels - 1, is for n levels below. Steps at which axes are scaled differ (SpheresScaling::kFirst)
// only at the root, which is not in it. Exact but for the mean offset of the fifth child across its axis
// (Gauss-Legendre with 5 points; within 1e-2 of it).
std::vector<ClusterMoments> cluster_moments(const SphereTree& tree);

// A cluster of leaves as one Gaussian.
struct GaussianBlob {
    glm::dvec3 center{0};
    // Standard deviation, in the units of the children.
    double s = 0;
    // Extinction at the centre, over sigma of the leaves.
    double peak = 0;
};
GaussianBlob leaf_blob(const Sphere& sphere);
// The leaves below a sphere's children, each child with the moments that are to be expected of it. Mass, centre of mass
// and mean square distance from it are kept.
GaussianBlob cluster_blob(const SphereChildren& children, const ClusterMoments& below);

}  // namespace awan::spheres
