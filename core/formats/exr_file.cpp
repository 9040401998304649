// encode_exr(). The only user of OpenEXR.
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfVecAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <vector>

#include "core/base/thrown.h"
#include "core/formats/image_file.h"

namespace awan {
namespace {

// What OpenEXR writes, gathered in a string that becomes the answer's body without a copy. It goes back to fill in its
// table of offsets.
class StringStream final : public Imf::OStream {
  public:
    explicit StringStream(std::string& bytes) : OStream("image.exr"), bytes_(bytes) {}
    void write(const char* from, int count) override {
        const auto size = static_cast<std::size_t>(count);
        bytes_.replace(at_, std::min(size, bytes_.size() - at_), from, size);
        at_ += size;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override {
        at_ = static_cast<std::size_t>(at);
        if (at_ > bytes_.size()) bytes_.resize(at_);
    }

  private:
    std::string& bytes_;
    std::size_t at_ = 0;
};

// Finite, so that no program that reads the file meets an infinity it did not expect.
float storable(float value, float largest) {
    return std::isnan(value) ? 0.0f : std::clamp(value, -largest, largest);
}

Imf::PixelType type_of(const ExrChannel& channel, Precision precision) {
    return precision == Precision::kHalf && !channel.exact ? Imf::HALF : Imf::FLOAT;
}

Imf::Header header_of(const Image& image, const std::vector<ExrChannel>& channels,
                      Precision precision, const PictureNotes& notes) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const ExrChannel& channel : channels)
        header.channels().insert(channel.name, Imf::Channel(type_of(channel, precision)));
    header.insert("Software", Imf::StringAttribute("Awan " AWAN_VERSION));
    if (notes.sky) {
        Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
        const auto vector = [&](const char* name, const glm::dvec3& v) {
            header.insert(name, Imf::V3fAttribute(Imath::V3f(Imath::V3d(v.x, v.y, v.z))));
        };
        vector("awan:sun_direction", notes.sky->to_sun);
        vector("awan:sun_irradiance", notes.sky->sun);
    }
    if (notes.rung.empty()) return header;
    header.insert("awan:rung", Imf::StringAttribute(notes.rung));
    const auto note = [&](const char* name, double value) {
        if (std::isfinite(value))
            header.insert(name, Imf::FloatAttribute(static_cast<float>(value)));
    };
    note("awan:error", notes.error);
    note("awan:error_forecast", notes.error_forecast);
    return header;
}

// Rows that are handed over at once, for each thread: four of EXR's blocks of 16 lines.
constexpr int kRowsAtOnce = 64;

// A channel's values of the rows that are handed over, as the file has them.
struct ChannelRows {
    std::vector<half> halves;
    std::vector<float> floats;

    char* data() {
        return halves.empty() ? reinterpret_cast<char*>(floats.data())
                              : reinterpret_cast<char*>(halves.data());
    }
};

template <typename T>
void take_rows(const ExrChannel& channel, std::size_t first, std::size_t count, float largest,
               std::vector<T>& to) {
    to.resize(count);
    const float* from = channel.first + channel.apart * first;
    for (T& value : to) {
        value = T(storable(*from, largest));
        from += channel.apart;
    }
}

// Compressing is most of what large pictures of floats cost, so the deadline is looked at in between.
Status write_rows(const Image& image, const std::vector<ExrChannel>& channels, Precision precision,
                  const Deadline& deadline, Imf::OutputFile& file) {
    const auto width = static_cast<std::size_t>(image.width);
    const int at_once = std::min(kRowsAtOnce * std::max(Imf::globalThreadCount(), 1), image.height);
    std::vector<ChannelRows> rows(channels.size());
    for (int y = 0; y < image.height; y += at_once) {
        if (Status over = deadline.over()) return over;
        const int lines = std::min(at_once, image.height - y);
        const std::size_t first = width * static_cast<std::size_t>(y),
                          count = width * static_cast<std::size_t>(lines);
        Imf::FrameBuffer buffer;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const Imf::PixelType type = type_of(channels[i], precision);
            const std::size_t size = type == Imf::HALF ? sizeof(half) : sizeof(float);
            if (type == Imf::HALF)
                take_rows(channels[i], first, count, HALF_MAX, rows[i].halves);
            else
                take_rows(channels[i], first, count, std::numeric_limits<float>::max(),
                          rows[i].floats);
            // A frame buffer is addressed from line 0 of the picture.
            char* const base = rows[i].data() - static_cast<std::ptrdiff_t>(size * first);
            buffer.insert(channels[i].name, Imf::Slice(type, base, size, size * width));
        }
        file.setFrameBuffer(buffer);
        file.writePixels(lines);
    }
    return std::nullopt;
}

}  // namespace

std::vector<ExrChannel> channels_of(const PictureLayers& layers) {
    std::vector<ExrChannel> channels;
    if (!layers.depth.empty()) channels.push_back({"depth.Z", layers.depth.data(), 1, true});
    if (!layers.transmittance.empty())
        channels.push_back({"transmittance.Y", layers.transmittance.data()});
    const auto add = [&](const std::string& name, const std::vector<float>& colors) {
        if (colors.empty()) return;
        for (std::size_t c = 0; c < 3; ++c)
            channels.push_back({name + '.' + "RGB"[c], colors.data() + c, 3});
    };
    add("sun", layers.sun);
    add("sky", layers.sky);
    add("multiple", layers.multiple);
    add("haze", layers.haze);
    add("background", layers.background);
    return channels;
}

Result<std::string> encode_exr(const Image& image, Precision precision, const PictureNotes& notes,
                               const Deadline& deadline, const std::vector<ExrChannel>& more) {
    if (const Status wrong = check_pixels(image)) return *wrong;
    std::vector<ExrChannel> channels;
    for (std::size_t c = 0; c < 4; ++c)
        channels.push_back({std::string(1, "RGBA"[c]), image.pixels.data() + c, 4});
    channels.insert(channels.end(), more.begin(), more.end());
    std::string bytes;
    try {
        StringStream stream(bytes);
        Imf::OutputFile file(stream, header_of(image, channels, precision, notes),
                             Imf::globalThreadCount());
        if (const Status late = write_rows(image, channels, precision, deadline, file))
            return *late;
    } catch (const std::exception& e) {
        const Error error = error_of_thrown(e);
        return error.code == ErrorCode::kInternal ? encoder_error(error.message) : error;
    }
    return bytes;
}

void set_exr_threads(int threads) {
    try {
        Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
    } catch (const std::exception&) {
        // As many as could be had.
    }
}

}  // namespace awan
