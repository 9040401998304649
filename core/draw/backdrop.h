// What stands behind the clouds: the sky, and the ground as it is lit.
#pragma once

#include <vector>

#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/light/ground_light.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Of every pixel's middle ray, row by row from the top.
struct Backdrop {
    int width = 0, height = 0;
    std::vector<float> rgb;  // radiance, 3 a pixel
    std::vector<float>
        distance;  // to the ground, scene units, infinite where it is not met; EMPTY without a ground
};

// Whether a picture needs more than the sky's gradient behind it: a physical sky, or a ground below the eye.
bool wants_backdrop(const Scene& scene, const View& view);

// Threads do not show in the result. The ground's pixels are point samples, as all others are.
Backdrop make_backdrop(const Scene& scene, const View& view, int width, int height,
                       const GroundLight& ground, int threads);

// Under a picture over nothing (premultiplied), which becomes opaque. Both of one size.
void lay_under(Image& picture, const Backdrop& backdrop);

// Whether the ground hides some of the cloud from an eye above it.
bool matter_below_ground(const Scene& scene, const View& view, const ParticleSet& particles);

}  // namespace awan
