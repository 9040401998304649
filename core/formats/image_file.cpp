#include "core/formats/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/thrown.h"
#include "core/formats/tone.h"
#include "core/scene/limits.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// What OpenImageIO writes, gathered in a string that becomes the answer's body without a copy. EXR
// seeks back to fill in its table of offsets.
class StringProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit StringProxy(std::string& bytes) : IOProxy("", Write), bytes_(bytes) {}
    const char* proxytype() const override { return "string"; }
    size_t write(const void* data, size_t size) override {
        const size_t written = pwrite(data, size, m_pos);
        m_pos += static_cast<std::int64_t>(written);
        return written;
    }
    size_t pwrite(const void* data, size_t size, int64_t offset) override {
        const auto at = static_cast<std::size_t>(offset);
        if (at > bytes_.size()) bytes_.resize(at);
        bytes_.replace(at, std::min(size, bytes_.size() - at), static_cast<const char*>(data),
                       size);
        return size;
    }
    size_t size() const override { return bytes_.size(); }

  private:
    std::string& bytes_;
};

Error encoder_error(const std::string& what) {
    return {ErrorCode::kInternal, "", "the image could not be encoded: " + what};
}

// Opens an encoder, lets `rows(output, y, end)` feed it rows y..end-1, `at_once` of them or fewer, and closes it.
// Compressing is most of what large pictures of floats cost, so the deadline is looked at in between.
template <typename Rows>
Result<std::string> encode(const char* format, const OIIO::ImageSpec& spec, const Image& image,
                           int at_once, const Deadline& deadline, Rows rows) {
    if (image.width < 1 || image.height < 1 || image.pixels.size() != 4 * image.pixel_count())
        return encoder_error("it has no pixels, or not as many as it says");
    try {
        std::string bytes;
        StringProxy proxy(bytes);
        const std::string name = std::string("image.") + format;
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name, &proxy);
        if (!output) return encoder_error(OIIO::geterror());
        if (!output->open(name, spec)) return encoder_error(output->geterror());
        for (int y = 0; y < image.height; y += at_once) {
            if (const auto over = deadline.over()) return *over;
            if (!rows(*output, y, std::min(y + at_once, image.height)))
                return encoder_error(output->geterror());
        }
        if (!output->close()) return encoder_error(output->geterror());
        return bytes;
    } catch (const std::exception& e) {
        const Error error = error_of_thrown(e);
        return error.code == ErrorCode::kInternal ? encoder_error(error.message) : error;
    }
}

OIIO::ImageSpec spec_of(const Image& image, int channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(image.width, image.height, channels, type);
    spec.attribute("Software", "Awan " AWAN_VERSION);
    return spec;
}

const float* row_of(const Image& image, int y) {
    return image.pixels.data() +
           4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
}

void opaque_row(const float* from, int width, float gain, const DisplayTable& table,
                std::uint8_t* to) {
    for (int x = 0; x < width; ++x, from += 4, to += 3)
        for (int c = 0; c < 3; ++c) to[c] = table.code(from[c] * gain);
}

// Straight alpha: colour is divided by alpha while it is still linear, then tone mapped.
void transparent_row(const float* from, int width, float gain, const DisplayTable& table,
                     std::uint8_t* to) {
    for (int x = 0; x < width; ++x, from += 4, to += 4) {
        // NaN becomes 0.
        const float alpha = from[3] > 0 ? std::min(from[3], 1.0f) : 0.0f;
        to[3] = static_cast<std::uint8_t>(alpha * 255.0f + 0.5f);
        // Where alpha rounds to 0 nothing shows; black packs better than the noise of 0 / 0.
        const float scale = to[3] == 0 ? 0.0f : gain / alpha;
        for (int c = 0; c < 3; ++c) to[c] = table.code(from[c] * scale);
    }
}

// Finite, so that no program that reads the file meets an infinity it did not expect.
float storable(float value, float largest) {
    return std::isnan(value) ? 0.0f : std::clamp(value, -largest, largest);
}

}  // namespace

std::vector<std::uint8_t> display_pixels(const Image& image, double exposure_stops) {
    const DisplayTable table;
    const auto gain = static_cast<float>(std::exp2(exposure_stops));
    const std::size_t row = (image.opaque ? 3U : 4U) * static_cast<std::size_t>(image.width);
    std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y)
        (image.opaque ? opaque_row : transparent_row)(
            row_of(image, y), image.width, gain, table,
            pixels.data() + row * static_cast<std::size_t>(y));
    return pixels;
}

Result<std::string> encode_png(const Image& image, double exposure_stops,
                               const Deadline& deadline) {
    const int channels = image.opaque ? 3 : 4;
    OIIO::ImageSpec spec = spec_of(image, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // The colour that we hand over is straight already.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    // zlib's fastest level with one fixed filter. Milliseconds and kB of 800 x 600 (a smooth sky behind a smooth
    // cloud, opaque, one core): level 1 with libpng's adaptive filters (the default) 33, 148; level 6 with them 80,
    // 97; with the filter "up" alone level 1 12, 151; 2 16, 144; 4 19, 112; 6 70, 99. Of the 12, 4 are the tone
    // curve.
    spec.attribute("png:compressionLevel", 1);
    // libpng's PNG_FILTER_UP.
    spec.attribute("png:filter", 32);

    const DisplayTable table;
    const auto gain = static_cast<float>(std::exp2(exposure_stops));
    std::vector<std::uint8_t> row(static_cast<std::size_t>(channels) *
                                  static_cast<std::size_t>(std::max(image.width, 0)));
    return encode("png", spec, image, 1, deadline, [&](OIIO::ImageOutput& output, int y, int) {
        (image.opaque ? opaque_row : transparent_row)(row_of(image, y), image.width, gain, table,
                                                      row.data());
        return output.write_scanline(y, 0, OIIO::TypeDesc::UINT8, row.data());
    });
}

Result<std::string> encode_exr(const Image& image, Precision precision, const PictureNotes& notes,
                               const Deadline& deadline) {
    const bool half = precision == Precision::kHalf;
    OIIO::ImageSpec spec = spec_of(image, 4, half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    // Otherwise the time of day would be written, and equal scenes would not have equal bytes.
    spec.attribute("DateTime", "");
    if (!notes.rung.empty()) spec.attribute("awan:rung", notes.rung);
    const auto note = [&](const char* name, double value) {
        if (!notes.rung.empty() && std::isfinite(value))
            spec.attribute(name, static_cast<float>(value));
    };
    note("awan:error", notes.error);
    note("awan:error_forecast", notes.error_forecast);

    const float largest = half ? 65504.0f : std::numeric_limits<float>::max();
    // Rows that are handed over at once: four of EXR's blocks of 16 lines.
    constexpr int kRows = 64;
    std::vector<float> rows(4 * static_cast<std::size_t>(std::max(image.width, 0)) *
                            static_cast<std::size_t>(kRows));
    return encode("exr", spec, image, kRows, deadline,
                  [&](OIIO::ImageOutput& output, int y, int end) {
                      std::transform(row_of(image, y), row_of(image, end), rows.begin(),
                                     [=](float value) { return storable(value, largest); });
                      return output.write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, rows.data());
                  });
}

// The share of the sun's light that the lit side of a thick cloud reflects, as the transport rungs and the truth have
// it. Two streams through an optical depth of 30 at g = .85 give .7, at 45 degrees.
constexpr double kCloudReflectance = 0.5;

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
    return std::clamp(std::log2(static_cast<double>(metered_level()) / cloud),
                      -limits::kMaxExposure, limits::kMaxExposure);
}

}  // namespace awan
