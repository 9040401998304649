// A picture as the eye passes give it.
#pragma once

#include <cstddef>
#include <vector>

namespace awan {

// Linear radiance with premultiplied alpha, row by row from the top left; 4 floats (r, g, b, a) a pixel.
// alpha = 1 - transmittance, or 1 everywhere where the sky was drawn behind.
struct Image {
    int width = 0;
    int height = 0;
    bool opaque = false;        // alpha is 1 everywhere by construction
    std::vector<float> pixels;  // 4 * width * height

    std::size_t pixel_count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

}  // namespace awan
