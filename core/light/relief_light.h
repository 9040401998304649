// Light on hills (core/generate/relief.h), and the shadows that they throw.
//
// A place with normal n sends on albedo / pi times its irradiance
//     sun max(n . s, 0) V T  +  n . S  +  change (n . O)  +  pi B (1 - n . O),
// s the way to the sun; V whether hills are in the way; T what comes through the clouds, with what is scattered ahead;
// S the integral of the sky's radiance times direction over what hills leave of it, O the same of a radiance 1 / pi
// (what they hide lies below the surface, where n . d < 0 too, so that no cosine has to be cut off); `change` what the
// clouds send down, less what they hide of the sky; B the mean radiance of all hills, for the rest of what a slope
// sees. S and O are known on a coarse raster.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <vector>

#include "core/light/ground_light.h"
#include "core/light/sun_depth.h"

namespace awan {

struct ReliefLight {
    // Nodes of S and O, from the relief's side to its other; x fastest.
    glm::ivec2 nodes{0};
    // S of r, g, b and O, x y z each.
    std::vector<std::array<float, 12>> open;
    std::array<float, 12> plain{};                  // of a place that hills hide nothing from
    glm::dvec3 to_sun{0, 1, 0}, sun{0};             // unit; irradiance
    glm::dvec3 aside_u{1, 0, 0}, aside_v{0, 0, 1};  // across the sun's disc, as long as its radius
    glm::dvec3 bounced{0};                          // B
    glm::dmat3 to_nodes{1};                         // of ground.clouds
};

// Precondition: the ground has hills. It does not depend on the view. Some 50 ms of one core.
ReliefLight relief_light(const Scene& scene, const GroundLight& ground, int threads);

// Radiance of the ground, hills or beside them, at a place on it. aside: in the unit disc: from which part of the sun's
// disc its light is taken.
glm::dvec3 radiance_at(const ReliefLight& light, const GroundLight& ground, const glm::dvec3& place,
                       const glm::dvec2& aside);

// The albedo of a level ground that is as bright, in the same light, as the hills are in the mean from above: these
// shade each other.
glm::dvec3 level_albedo(const ReliefLight& light, const GroundLight& ground);

// Adds the shadows of hills to the depth of the clouds: what lies in them has kHillDepth more.
void shade_by_hills(const Relief& relief, int threads, SunDepth& sun);
inline constexpr float kHillDepth = 10;

}  // namespace awan
