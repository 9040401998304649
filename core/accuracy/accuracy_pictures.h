// Pictures as a person sees them: the sky behind, on a screen.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image.h"
#include "core/formats/tone.h"
#include "core/light/ground_light.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// A picture over nothing, laid over the scene's sky and the ground as `ground` has it lit.
Image over_sky(const Image& transparent, const Scene& scene, const View& view,
               const GroundLight& ground);

// The samples of its PNG: 3 bytes a pixel, sRGB after exposure and the tone curve, not
// dithered. What is transparent is black.
std::vector<std::uint8_t> display_bytes(const Image& image, const FilmSettings& film);

// The size of a picture with the shape of `width` x `height` and a longer side of at most `side`.
struct PictureSize {
    int width = 1, height = 1;
};
PictureSize fitted_size(int width, int height, int side);

}  // namespace awan
