// What shines on the clouds from outside, resolved from the document: the sun's irradiance and the sky's radiance as
// light, draw and truth take them.
#pragma once

#include <glm/vec3.hpp>

#include "core/scene/daylight.h"
#include "core/scene/scene.h"

namespace awan {

// The sky all around, with its intensity.
struct SkyDome {
    bool shines = false;  // else black, and nothing below holds
    bool physical = false;
    glm::dvec3 zenith{0}, horizon{0};  // radiance; of a gradient
    ClearSky clear;                    // of a physical sky
    double intensity = 1;              // multiplies `clear`
};

struct Outside {
    glm::dvec3 to_sun{0, 1, 0};  // unit
    glm::dvec3 sun{0};           // irradiance at normal incidence
    SkyDome sky;
};

// Effect sun_color decides whether an "auto" sun has its colour: switched off it has the luminance without the hue.
Outside outside_of(const SceneDraft& scene);
inline Outside outside_of(const Scene& scene) {
    return outside_of(*scene);
}

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
