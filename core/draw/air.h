// The haze as the eye pass sees it.
//
// On a ray let T_c and T_h be the transmittances of the clouds and of the haze from the eye to a distance t, O = 1 -
// T_h the haze's opacity, and H(t) the light that the haze scatters to the eye from before t. By parts, a pixel is
//     sum_i w_i (S_i T_h(t_i) + H(t_i)) + T_c(end) (background T_h(end) + H(end)),
// w_i the weight of the clouds' sample i (its own opacity times T_c before it), S_i that sample's radiance. This holds
// for haze before, between and behind the clouds. The haze's light is
//     H(t) = albedo (sun p(theta) (O(t) - L(t)) + ambient O(t)),
// L what the clouds' shadows take from it (air_shadows.h), p the phase function. `ambient` is the mean of all radiance
// that comes in from the sky and from the ground far away. That clouds shade it, and that it is scattered more into
// some directions than into others, is left out: that is a part of the model.
#pragma once

#include <optional>

#include "core/draw/air_shadows.h"
#include "core/draw/march_phase.h"
#include "core/scene/outside.h"

namespace awan {

struct Air {
    Haze haze;
    PictureRays picture;
    double ground = 0;      // height where the haze ends; -infinity: nowhere
    glm::dvec3 ambient{0};  // albedo * radiance, per opacity
    glm::dvec3 sun{0};      // albedo * irradiance; times p(theta) / 4 pi it is per opacity, too
    glm::dvec3 to_sun{0, 1, 0};  // unit
    RestOfPhase phase;           // p / 4 pi
    // Optical depth to the end of a ray straight up and straight down. Along any other it is that over |slope|.
    double up = 0, down = 0;
    AirShadows shadows;  // spacing 0: none
};

PictureRays picture_rays(const View& view, int width, int height);

// None where the scene has no haze. Without the clouds' shadows. Over a ground, a sun below the horizon does not light
// it.
std::optional<Air> make_air(const Scene& scene, const View& view);
// Puts the clouds' shadows in.
void shade_air(const SunDepth& sun, int threads, Air& air);

// The haze on the way from the eye to distance t along the ray through pixel coordinates (x, y).
struct AirBefore {
    double opacity = 0;  // O, 0..1
    double lost = 0;     // L, 0..O
};
AirBefore air_before(const Air& air, const HazeRay& ray, double x, double y, double t);
// The same to where the haze ends on that ray. slope: the direction's y.
AirBefore whole_air(const Air& air, double slope, double x, double y);

// H along a direction (unit).
glm::dvec3 in_scattering(const Air& air, const glm::dvec3& direction, const AirBefore& before);

}  // namespace awan
