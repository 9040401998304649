// The sky as the discrete ordinates take it: one radiance a direction.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/light/ordinates.h"
#include "core/scene/outside.h"

namespace awan {

// The mean radiance over the solid angle that each ordinate stands for: its level of the quadrature and its sixteenth
// of the circle. Samples in the ordinates' own directions could miss the bright sky around the sun, or count it too
// often.
struct SkyInflow {
    // [octant][direction], of the direction that one looks TO: light comes from there.
    std::array<std::array<glm::dvec3, kDirections>, kOctants> mean{};
    glm::dvec3 most{0};  // the largest radiance of any sample, each channel by itself
};
SkyInflow sky_inflow(const SkyDome& sky);

// The mean radiance of the ordinate in whose solid angle a direction lies (towards the sky, any length > 0).
glm::dvec3 mean_from(const SkyInflow& inflow, const glm::dvec3& direction);

}  // namespace awan
