// The compiled programs of both passes. Private to core/gl, core/light and core/draw.
#pragma once

#include <optional>

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

    // Those that not all pictures need, compiled when they are first asked for. They fail as Program does.

    // Pass 2: particles blended per pixel. interior: the eye may be inside a particle.
    Result<const gl::Program*> plain(bool interior);
    // Pass 2 with textures on the billboards of some particles. tinted: some of the textures have colours.
    Result<const gl::Program*> painted(bool interior, bool tinted);
    // Pass 2 with detail.
    Result<const gl::Program*> detailed(bool interior);
    // Triangles, for what is displayed instead of lit.
    Result<const gl::Program*> display();

    using Late = std::optional<gl::Program>;
    // [interior][tinted], [interior].
    Late painted_splats[2][2]{}, plain_splats[2]{}, detailed_splats[2]{};
    Late display_triangles{};
};

}  // namespace awan
