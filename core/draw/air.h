// The haze as the eye pass sees it. With the clouds' transmittance T_c and the haze's T_h along a ray and H(t) the light that
// the haze scatters to the eye between it and t, a pixel is (by parts)
//     sum_i w_i (S_i T_h(t_i) + H(t_i)) + T_c(end) (background T_h(end) + H(end)),
// w_i the alpha of sample i over all before it, S_i its own radiance: exact for haze before, between and behind the clouds.
//     H(t) = albedo (sun p(theta) (O(t) - L(t)) + ambient O(t)),  O = 1 - T_h,
// L what the clouds' shadows take from it (air_shadows.h). `ambient` is the mean of all that comes in from sky and far ground, neither
// shaded by clouds nor turned by the phase function: part of the model.
#pragma once

#include <optional>

#include "core/draw/air_shadows.h"
#include "core/draw/march_phase.h"
#include "core/scene/outside.h"

namespace awan {

struct Air {
    Haze haze;
    PictureRays picture;
    double ground = 0;           // height where the haze ends; -infinity: nowhere
    glm::dvec3 ambient{0};       // radiance per opacity, albedo in it
    glm::dvec3 sun{0};           // irradiance * albedo; times p(theta) / 4 pi: as `ambient`
    glm::dvec3 to_sun{0, 1, 0};  // unit
    RestOfPhase phase;           // p / 4 pi
    double up = 0, down = 0;     // depth to the end of a vertical ray; over |slope| of any other
    AirShadows shadows;          // spacing 0: none
};

PictureRays picture_rays(const View& view, int width, int height);

// None when the scene has no haze. Radiance of the haze is 0 where the sun is under a ground.
std::optional<Air> make_air(const Scene& scene, const View& view);
// With the clouds' shadows in it.
void shade_air(const SunDepth& sun, int threads, Air& air);

// Of the way from the eye to distance t along the ray through pixel coordinates (x, y).
struct AirBefore {
    double opacity = 0;  // O, 0..1
    double lost = 0;     // L, 0..O
};
AirBefore air_before(const Air& air, const HazeRay& ray, double x, double y, double t);
// To where the ray's haze ends.
AirBefore whole_air(const Air& air, double slope, double x, double y);

// H, for a direction (unit).
glm::dvec3 in_scattering(const Air& air, const glm::dvec3& direction, const AirBefore& before);

}  // namespace awan
