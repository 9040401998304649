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

std::vector<std::uint8_t> display_bytes(const Image& image, const FilmSettings& settings) {
    const Film film(settings);
    std::vector<std::uint8_t> bytes(3 * image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float* const from = image.pixels.data() + 4 * i;
        const auto codes = film.rounded(film.gain() * glm::vec3(from[0], from[1], from[2]));
        std::copy(codes.begin(), codes.end(), bytes.data() + 3 * i);
    }
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
