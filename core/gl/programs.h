// The compiled programs of both passes. Private to core/gl, core/light and core/draw.
#pragma once

#include "core/gl/device.h"
#include "core/gl/objects.h"

namespace awan {

struct Device::Programs {
    gl::Program light_columns;  // light/: optical depth from a light, on a volume
    gl::Program light_samples;  // light/: what each particle sees of that volume
    gl::Program splat;          // draw/: particles blended per pixel
};

}  // namespace awan
