// The ellipsoids of a cloud: those given, and those of its formations (the linked ellipsoids of Gardner 1985:
// horizontal, vertical and combined).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/exact_math.h"
#include "core/scene/ellipsoids.h"

namespace awan::ellipsoids {

// An ellipsoid in the cloud's own coordinates.
struct PlacedEllipsoid {
    glm::dvec3 center{0}, radii{1};
    // The directions of its semi-axes, by columns.
    glm::dmat3 axes{1};
    // Its own where it has one, else the cloud's.
    Translucence translucence;
    // The index of an earlier one that it overlaps; -1: of none.
    int linked_to = -1;

    // A point of the cloud in the coordinates in which the ellipsoid is the unit sphere about the origin.
    glm::dvec3 to_unit(const glm::dvec3& p) const { return direction_to_unit(p - center); }
    // The same of a way from one point to another.
    glm::dvec3 direction_to_unit(const glm::dvec3& d) const {
        return glm::dvec3(d.x * axes[0].x + d.y * axes[0].y + d.z * axes[0].z,
                          d.x * axes[1].x + d.y * axes[1].y + d.z * axes[1].z,
                          d.x * axes[2].x + d.y * axes[2].y + d.z * axes[2].z) /
               radii;
    }
    glm::dvec3 from_unit(const glm::dvec3& u) const { return center + axes * (u * radii); }
    // Half the sides of its axis-aligned box.
    glm::dvec3 half_box() const {
        const glm::dvec3 a = axes[0] * radii.x, b = axes[1] * radii.y, c = axes[2] * radii.z;
        return {std::sqrt(a.x * a.x + b.x * b.x + c.x * c.x),
                std::sqrt(a.y * a.y + b.y * b.y + c.y * c.y),
                std::sqrt(a.z * a.z + b.z * b.z + c.z * c.z)};
    }
    double mean_radius() const { return (radii.x + radii.y + radii.z) / 3; }
};

// A turn about z (from +x towards +y), then about x (from +y towards +z), then about y (from +z towards +x), degrees.
glm::dmat3 turned_axes(double about_z, double about_x, double about_y);

// Formations first, then the ellipsoids given and the quadrics, each in the order of the scene. key: that of
// ModelRequest.
std::vector<PlacedEllipsoid> placed_ellipsoids(const EllipsoidsCloud& cloud, std::uint64_t key);

// The normalised limb curve in space: 1 at the centre, 0 on the surface. Gardner 1985 has it in the picture, as g(x,
// z), from the conic that is the silhouette. Where the ellipsoid is the unit sphere, g of a line of sight that passes
// the centre at distance b is 1 - b^2. The largest value of 1 - |p|^2 on that line is the same number: the most that
// a picture of the volume shows along it is what Gardner draws. unit_distance_squared: |p|^2; may be above 1.
inline double limb_in_space(double unit_distance_squared) {
    return 1 - unit_distance_squared;
}

// g of an ellipsoid where others overlap it: its own, and `join` times the sum of theirs (EllipsoidsCloud::join).
inline double joined_limb(double own, double others, double join) {
    return std::min(own + join * others, 1.0);
}

// TR stays between its limits, so its complement does.
inline double limited(double opacity, double least, double most) {
    return std::clamp(opacity, 1 - most, 1 - least);
}

// The value of the texture at which the cloud begins to be opaque, for a value g of the limb curve. Opacity is 1 at
// this + range (opacity(), texture.h).
inline double threshold_at(const Translucence& t, double g) {
    return t.threshold + (t.threshold_edge - t.threshold) * (1 - g);
}

}  // namespace awan::ellipsoids
