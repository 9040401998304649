// A picture taken apart, pixel by pixel, into what compositing programs put together again (core/scene/layers.h).
#pragma once

#include <vector>

#include "core/draw/march.h"
#include "core/scene/layers.h"

namespace awan {

// Row by row from the top left. One float a pixel of depth and transmittance, three (r, g, b) of the others. EMPTY:
// that layer was not asked for.
struct PictureLayers {
    std::vector<float> depth, transmittance, sun, sky, multiple, haze, background;
};

// The depth where a ray meets no cloud, as Blender has it: finite, and farther than any.
inline constexpr float kNoDepth = 1e10F;

// The parts add up to the picture to rounding. Where the grid's light is less than what is scattered once, whose
// figures are exacter, that is brought down to it, so that no part is negative. beside: as march() filled it for this
// picture.
PictureLayers layers_of(const Image& picture, const MarchedBeside& beside, const Layers& asked);

}  // namespace awan
