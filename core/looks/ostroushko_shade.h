// How a sphere is lit in the look of Ostroushko et al. 2010: sun and sky on a surface whose normals are bump-mapped
// (4).
#pragma once

#include <cstdint>

#include "core/looks/ostroushko_clouds.h"

namespace awan::looks {

// The light of the scene as surfaces get it.
struct LookLight {
    glm::dvec3 to_sun{0, 1, 0};
    // Radiance of a white surface that faces the sun: irradiance / pi.
    glm::dvec3 sun{0};
    // Mean radiances of the upper and the lower half of what is around.
    glm::dvec3 above{0}, below{0};
    // The share of the clouds' depths towards the sun that counts. (Ostroushko et al. 2010 have no shadow.)
    double softened = 1;
    double albedo = 1;
};
LookLight look_light(const Scene& scene);

// The bump-mapped normal, n' = f(u, v, n) of Ostroushko et al. 2010 (4), by Blinn 1978: the normal is turned by the
// slope of a relief on the sphere. The place u, v is given by the unit vector n; the relief is waves whose phases
// belong to the sphere (key). height: in radii. n, n': unit.
glm::dvec3 bumped(const glm::dvec3& normal, std::uint64_t key,
                  double height = SpheresBump{}.height);

// The same by the cloud's own relief, where the user gives one, which turns as the cloud does.
glm::dvec3 bumped(const LookCloud& cloud, const glm::dvec3& normal, std::uint64_t key);

// How much light reaches a sphere.
struct Reaching {
    // Shares of the sun's and of the sky's light.
    double sun = 1, sky = 1;
};
Reaching reaching(const std::vector<LookCloud>& clouds, const LookLight& light,
                  const glm::dvec3& point);

// The radiance of a place with that normal (unit).
glm::dvec3 shade(const LookLight& light, const Reaching& share, const glm::dvec3& normal);

}  // namespace awan::looks
