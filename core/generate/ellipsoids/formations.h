// The ellipsoids of a cloud: those given, and those of its formations (the linked ellipsoids of Gardner 1985:
// horizontal, vertical and combined).
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/exact_math.h"
#include "core/scene/ellipsoids.h"

namespace awan::ellipsoids {

// An ellipsoid in the cloud's own coordinates.
struct PlacedEllipsoid {
    glm::dvec3 center{0}, radii{1};
    // Its turn about y, as that of Motion (motion.h).
    exact::SinCos turn{0, 1};
    // Its own where it has one, else the cloud's.
    Translucence translucence;
    // The index of an earlier one that it overlaps; -1: of none.
    int linked_to = -1;

    // A point of the cloud in the coordinates in which the ellipsoid is the unit sphere about the origin.
    glm::dvec3 to_unit(const glm::dvec3& p) const {
        const glm::dvec3 d = p - center;
        return glm::dvec3(d.x * turn.cos - d.z * turn.sin, d.y, d.z * turn.cos + d.x * turn.sin) /
               radii;
    }
    glm::dvec3 from_unit(const glm::dvec3& u) const {
        const glm::dvec3 p = u * radii;
        return center +
               glm::dvec3(p.x * turn.cos + p.z * turn.sin, p.y, p.z * turn.cos - p.x * turn.sin);
    }
    // Half the sides of its axis-aligned box.
    glm::dvec3 half_box() const {
        const double a = radii.x * turn.cos, b = radii.z * turn.sin;
        const double c = radii.z * turn.cos, d = radii.x * turn.sin;
        return {std::sqrt(a * a + b * b), radii.y, std::sqrt(c * c + d * d)};
    }
};

// Formations first, then the ellipsoids given, each in the order of the scene. key: that of ModelRequest.
std::vector<PlacedEllipsoid> placed_ellipsoids(const EllipsoidsCloud& cloud, std::uint64_t key);

// The normalised limb curve in space: 1 at the centre, 0 on the surface. Gardner 1985 has it in the picture, as g(x,
// z), from the conic that is the silhouette. Where the ellipsoid is the unit sphere, g of a line of sight that passes
// the centre at distance b is 1 - b^2. The largest value of 1 - |p|^2 on that line is the same number: the most that
// a picture of the volume shows along it is what Gardner draws. unit_distance_squared: |p|^2; may be above 1.
inline double limb_in_space(double unit_distance_squared) {
    return 1 - unit_distance_squared;
}

// The value of the texture at which the cloud begins to be opaque, for a value g of the limb curve. Opacity is 1 at
// this + range (opacity(), texture.h).
inline double threshold_at(const Translucence& t, double g) {
    return t.threshold + (t.threshold_edge - t.threshold) * (1 - g);
}

}  // namespace awan::ellipsoids
