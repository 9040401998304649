#include "core/formats/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/base/exact_math.h"
#include "core/formats/tone.h"
#include "core/scene/limits.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

const float* row_of(const Image& image, int y) {
    return image.pixels.data() +
           4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
}

void opaque_row(const float* from, int width, const Film& film, std::uint8_t* to) {
    for (int x = 0; x < width; ++x, from += 4, to += 3) {
        const auto codes = film.rounded(film.gain() * glm::vec3(from[0], from[1], from[2]));
        std::copy(codes.begin(), codes.end(), to);
    }
}

// Straight alpha: colour is divided by alpha while it is still linear, then tone mapped.
void transparent_row(const float* from, int width, const Film& film, std::uint8_t* to) {
    for (int x = 0; x < width; ++x, from += 4, to += 4) {
        // NaN becomes 0.
        const float alpha = from[3] > 0 ? std::min(from[3], 1.0f) : 0.0f;
        to[3] = static_cast<std::uint8_t>(alpha * 255.0f + 0.5f);
        // Where alpha rounds to 0 nothing shows; black packs better than the noise of 0 / 0.
        const float scale = to[3] == 0 ? 0.0f : film.gain() / alpha;
        const auto codes = film.rounded(scale * glm::vec3(from[0], from[1], from[2]));
        std::copy(codes.begin(), codes.end(), to);
    }
}

}  // namespace

Status check_pixels(const Image& image) {
    if (image.width < 1 || image.height < 1 || image.pixels.size() != 4 * image.pixel_count())
        return encoder_error("it has no pixels, or not as many as it says");
    return std::nullopt;
}

std::vector<std::uint8_t> display_pixels(const Image& image, const FilmSettings& settings) {
    const Film film(settings);
    const std::size_t row = (image.opaque ? 3U : 4U) * static_cast<std::size_t>(image.width);
    std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y)
        (image.opaque ? opaque_row : transparent_row)(
            row_of(image, y), image.width, film, pixels.data() + row * static_cast<std::size_t>(y));
    return pixels;
}

// The share of the sun's light that the lit side of a thick cloud reflects, as the transport rungs and the truth have
// it. Two streams through an optical depth of 30 at g = .85 give .7, at 45 degrees.
constexpr double kCloudReflectance = 0.5;

// The share of the stops lost to a low sun that stays lost. From noon to sunset a cloud loses 3 or 4 stops, to the end
// of civil twilight 13: these become .9 and 3.3.
constexpr double kEveningKept = 0.25;

// What the scene's sun makes of that cloud from 45 degrees up, without the sky. >= 0.
double high_sun_cloud(const Scene& scene) {
    const glm::dvec3 color = scene->sun.auto_color
                                 ? sunlight(std::numbers::pi / 4, scene->sky.turbidity)
                                 : scene->sun.color;
    return kCloudReflectance * scene->sun.intensity * luminance(color) / std::numbers::pi;
}

double auto_exposure(const Scene& scene) {
    const Outside outside = outside_of(scene);
    const SkyDome& sky = outside.sky;
    // Mean of a gradient's radiance (core/shaders/sky.glsl) over the upper hemisphere, weighted with
    // the cosine to the zenith u: the integral of 2 u 1.09 u^2 / (u^2 + .09) over u = 0..1 is 1.09
    // (1 - .09 ln(1.09 / .09)).
    const double mean_sky = !sky.shines ? 0.0
                            : sky.physical
                                ? luminance(means_of(sky).irradiance_up) / std::numbers::pi
                                : luminance(glm::mix(sky.horizon, sky.zenith, 0.845326504));
    const double cloud = kCloudReflectance * luminance(outside.sun) / std::numbers::pi + mean_sky;
    // Without light there is nothing to meter.
    if (!(cloud > 0)) return 0;
    const double lost = std::max(0.0, exact::log2(high_sun_cloud(scene) / cloud));
    const double stops =
        exact::log2(static_cast<double>(metered_level()) / cloud) - kEveningKept * lost;
    return std::clamp(stops, -limits::kMaxExposure, limits::kMaxExposure);
}

PictureNotes sky_notes_of(const Scene& scene) {
    const Outside outside = outside_of(scene);
    PictureNotes notes;
    notes.sky = SkyNotes{outside.to_sun, outside.sun};
    return notes;
}

double exposure_of(const Scene& scene) {
    const bool lit = scene->display == Display::kLit;
    return scene->image.exposure.value_or(lit ? auto_exposure(scene) : 0.0);
}

FilmSettings film_of(const Scene& scene) {
    return {exposure_of(scene), scene->image.tone};
}

}  // namespace awan
