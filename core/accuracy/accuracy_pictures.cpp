#include "core/accuracy/accuracy_pictures.h"

#include <algorithm>
#include <cmath>

#include "core/draw/backdrop.h"
#include "core/formats/image_file.h"
#include "core/formats/tone.h"

namespace awan {

Image over_sky(const Image& transparent, const Scene& scene, const View& view,
               const GroundLight& ground) {
    Image image = transparent;
    lay_under(image, make_backdrop(scene, view, image.width, image.height, ground, 1));
    return image;
}

std::vector<std::uint8_t> display_bytes(const Image& image, double exposure) {
    const DisplayTable table;
    const auto gain = static_cast<float>(std::exp2(exposure));
    std::vector<std::uint8_t> bytes(3 * image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            bytes[3 * i + c] = table.code(image.pixels[4 * i + c] * gain);
    return bytes;
}

PictureSize fitted_size(int width, int height, int side) {
    const int longer = std::max(width, height);
    if (longer <= side) return {width, height};
    const auto scaled = [=](int n) {
        return std::max(1, static_cast<int>(std::lround(static_cast<double>(n) * side / longer)));
    };
    return {scaled(width), scaled(height)};
}

}  // namespace awan
