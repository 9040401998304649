// The compiled programs of both passes. Private to core/gl, core/light and core/draw.
#pragma once

#include "core/gl/device.h"
#include "core/gl/objects.h"

namespace awan {

struct Device::Programs {
    // Pass 1: the optical depth in each cell of a volume that faces a light.
    gl::Program light_columns;
    // Pass 1: running sums of it, from the light on.
    gl::Program light_sums;
    // Pass 1: the light that each particle gets, read from those sums.
    gl::Program light_samples;
    // Pass 2: particles blended per pixel, with the eye outside all of them.
    gl::Program splat;
    // Pass 2: the same where the eye may be inside a particle.
    gl::Program splat_interior;
};

}  // namespace awan
