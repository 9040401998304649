#include "core/truth/accuracy_pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/formats/image_file.h"
#include "core/formats/tone.h"
#include "core/scene/outside.h"

namespace awan {

Image over_sky(const Image& transparent, const Scene& scene, const View& view) {
    Image image = transparent;
    image.opaque = true;
    const SkyDome sky = outside_of(scene).sky;
    float* pixel = image.pixels.data();
    for (int y = 0; y < image.height; ++y) {
        const double v = (1 - (y + 0.5) / image.height * 2) * view.tan_half_fov;
        for (int x = 0; x < image.width; ++x, pixel += 4) {
            const double u = ((x + 0.5) / image.width * 2 - 1) * view.tan_half_fov * view.aspect;
            const glm::dvec3 ray = glm::normalize(view.forward + u * view.right + v * view.up);
            const glm::vec3 behind(sky_radiance(sky, ray));
            for (int c = 0; c < 3; ++c) pixel[c] += (1 - pixel[3]) * behind[c];
            pixel[3] = 1;
        }
    }
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

double exposure_of(const Scene& scene) {
    return scene->image.exposure.value_or(auto_exposure(scene));
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
