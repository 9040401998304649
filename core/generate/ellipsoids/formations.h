// The ellipsoids of a cloud: those given, and those of its formations (document 002: linked ellipsoids, horizontal,
// vertical and combined).
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/exact_math.h"
#include "core/scene/ellipsoids.h"

namespace awan {

// Of the cloud, in its own coordinates.
struct PlacedEllipsoid {
    glm::dvec3 center{0}, radii{1};
    // About y, as Motion has it.
    SinCos turn{0, 1};
    // Its own where it has one.
    Translucence translucence;
    // An earlier one that it overlaps; -1: to none.
    int linked_to = -1;

    // Where it is the unit sphere about the origin.
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
    // Half the sides of its box.
    glm::dvec3 half_box() const {
        const double a = radii.x * turn.cos, b = radii.z * turn.sin;
        const double c = radii.z * turn.cos, d = radii.x * turn.sin;
        return {std::sqrt(a * a + b * b), radii.y, std::sqrt(c * c + d * d)};
    }
};

// Formations first, then the ellipsoids given; in the document's order. key: ModelRequest's.
std::vector<PlacedEllipsoid> placed_ellipsoids(const EllipsoidsCloud& cloud, std::uint64_t key);

// The normalised limb curve in space: 1 at the centre, 0 on the surface. Document 002 has it in the picture, g(x, z),
// from the conic that is the silhouette's; of the line of sight that passes the centre at a distance b (where the
// ellipsoid is the unit sphere) it is 1 - b^2. The largest value of 1 - |p|^2 on that line is the same number: what a
// picture of the volume shows along it at the most is what the source draws. |p|^2 may be above 1.
inline double limb_in_space(double unit_distance_squared) {
    return 1 - unit_distance_squared;
}

// TR reaches 1 there and is 0 at threshold + range (opacity(), texture.h).
inline double threshold_at(const Translucence& t, double g) {
    return t.threshold + (t.threshold_edge - t.threshold) * (1 - g);
}

}  // namespace awan
