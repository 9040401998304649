#include "core/survey/outside_light.h"

#include <numbers>

namespace awan {

OutsideLight outside_light(const Scene& scene, int sky_steps) {
    OutsideLight light;
    light.outside = outside_of(scene);
    // All of the sun's irradiance, spread over the sphere.
    light.sun = luminance(light.outside.sun) / (4 * std::numbers::pi);
    if (light.outside.sky.shines) {
        const SkyMeans means = means_of(light.outside.sky, sky_steps);
        light.sky = 0.5 * luminance(means.above + means.below);
    }
    return light;
}

}  // namespace awan
