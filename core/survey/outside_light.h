// How much light there is around the clouds, by one number a source.
#pragma once

#include "core/scene/outside.h"

namespace awan {

// Luminances of the mean radiance that comes in from all directions.
struct OutsideLight {
    Outside outside;
    double sun = 0, sky = 0;

    double all() const { return sun + sky; }
};

// sky_steps: of means_of(), which says how exact the sky is then.
OutsideLight outside_light(const Scene& scene, int sky_steps);

}  // namespace awan
