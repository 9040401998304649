// How a sphere is lit in the look of Ostroushko et al. (document 003): sun and sky on a surface whose normals are
// bump-mapped (equation 4).
#pragma once

#include <cstdint>

#include "core/looks/ostroushko_clouds.h"

namespace awan::looks {

struct LookLight {
    glm::dvec3 to_sun{0, 1, 0};
    // Radiance of a white surface that faces the sun: irradiance / pi.
    glm::dvec3 sun{0};
    // Mean radiance of the halves of what is around.
    glm::dvec3 above{0}, below{0};
    // Depth towards the sun that counts, of the clouds' own (the source has no shadow).
    double softened = 1;
    double albedo = 1;
};
LookLight look_light(const Scene& scene);

// Equation 4, n' = f(u, v, n), as Blinn 1978 has it: the normal is turned by the slope of a relief on the sphere. u, v:
// the place on the sphere as the unit vector n; the relief: waves whose phases belong to the sphere. n, n': unit.
glm::dvec3 bumped(const glm::dvec3& normal, std::uint64_t key);

// Of light that reaches a sphere.
struct Reaching {
    // Shares.
    double sun = 1, sky = 1;
};
Reaching reaching(const std::vector<LookCloud>& clouds, const LookLight& light,
                  const glm::dvec3& point);

// Radiance of a place with that normal (unit).
glm::dvec3 shade(const LookLight& light, const Reaching& share, const glm::dvec3& normal);

}  // namespace awan::looks
