// The sky as the discrete ordinates take it: one radiance a direction.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/light/ordinates.h"
#include "core/scene/outside.h"

namespace awan {

// Mean radiance over the solid angle that each ordinate stands for (its level of the product quadrature, its sixteenth of
// the circle): the total is kept where the sky is bright near the sun.
struct SkyInflow {
    std::array<std::array<glm::dvec3, kDirections>, kOctants> mean{};  // of the octant looked TO
    glm::dvec3 most{0};                                                // the largest radiance met
};
SkyInflow sky_inflow(const SkyDome& sky);

// Of the ordinate in whose solid angle a direction (towards the sky, any length > 0) lies.
glm::dvec3 mean_from(const SkyInflow& inflow, const glm::dvec3& direction);

}  // namespace awan
