// What shines on the clouds from outside, resolved from the document: the sun's irradiance and the sky's radiance as
// light, draw and truth take them.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "core/scene/atmosphere.h"
#include "core/scene/daylight.h"
#include "core/scene/scene.h"

namespace awan {

// The sky all around, with its intensity.
struct SkyDome {
    bool shines = false;  // else black, and nothing below holds
    bool physical = false;
    glm::dvec3 zenith{0}, horizon{0};  // radiance; of a gradient
    // Of a physical sky: scattered light, or where there is none, the fits of Preetham et al.
    std::shared_ptr<const AirSky> air;
    ClearSky clear;
    double intensity = 1;  // multiplies either
};

struct Outside {
    glm::dvec3 to_sun{0, 1, 0};  // unit
    glm::dvec3 sun{0};           // irradiance at normal incidence; none from below a ground
    SkyDome sky;
};

// Effect sun_color decides whether an "auto" sun has its colour: switched off it has the luminance without the hue.
Outside outside_of(const SceneDraft& scene);
// The same without computing the sky again.
Outside outside_of(const Scene& scene);

// The scene's sky where it is scattered light, else none. Some milliseconds, unless the draft has it from a scene of
// the same sun and air.
std::shared_ptr<const AirSky> air_of(const SceneDraft& scene);

// Of a sky that is physical and shines, from a direction (unit): its intensity times air or fits.
glm::dvec3 physical_radiance(const SkyDome& sky, const glm::dvec3& direction);

// Radiance from a direction (unit, from the ground up). Double; for 16 pixels at a time see core/draw.
glm::dvec3 sky_radiance(const SkyDome& sky, const glm::dvec3& direction);

// Irradiance of a level plane that looks up (all of the sky's upper half): integral of radiance * cosine, and the mean
// radiance of either half of the sphere. By the midpoint rule with `steps` in height and twice as many around: relative
// error < 2e-3 with 48 (2 ms where the sky is physical), < 2% with 12 (daylight_test).
struct SkyMeans {
    glm::dvec3 irradiance_up{0};
    glm::dvec3 above{0}, below{0};  // mean radiance of the halves
};
SkyMeans means_of(const SkyDome& sky, int steps = 48);

double luminance(const glm::dvec3& rgb);  // Rec. 709

}  // namespace awan
