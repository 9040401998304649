// The compiled programs of both passes. Private to core/gl, core/light and core/draw.
#pragma once

#include "core/gl/device.h"
#include "core/gl/objects.h"

namespace awan {

struct Device::Programs {
    // light/: optical depth in each cell of a volume that faces a light.
    gl::Program light_columns;
    // light/: summed up from the light on.
    gl::Program light_sums;
    // light/: what each particle sees of that volume.
    gl::Program light_samples;
    // draw/: particles blended per pixel, the eye outside all of them.
    gl::Program splat;
    // draw/: the eye may be inside.
    gl::Program splat_interior;
};

}  // namespace awan
