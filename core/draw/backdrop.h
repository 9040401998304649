// What stands behind the clouds: the sky, and the ground as it is lit.
#pragma once

#include <vector>

#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/light/ground_light.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// What every pixel's middle ray meets, row by row from the top.
struct Backdrop {
    int width = 0, height = 0;
    std::vector<float> rgb;  // radiance, 3 a pixel
    // To the ground, scene units; infinite where the ray does not meet it. EMPTY without a ground.
    std::vector<float> distance;
};

// Whether a picture needs more than the sky's gradient behind it: a physical sky, or a ground below the eye.
bool wants_backdrop(const Scene& scene, const View& view);

// The same for every number of threads. Pixels are point samples, those of the ground, too.
Backdrop make_backdrop(const Scene& scene, const View& view, int width, int height,
                       const GroundLight& ground, int threads);

// Lays it under a picture of clouds alone (premultiplied), which becomes opaque. Both have one size.
void lay_under(Image& picture, const Backdrop& backdrop);

// Whether the ground hides some of the cloud from an eye above it.
bool matter_below_ground(const Scene& scene, const View& view, const ParticleSet& particles);

}  // namespace awan
