// encode_exr(). The only user of OpenEXR.
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
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

Imf::Header header_of(const Image& image, Imf::PixelType type, const PictureNotes& notes) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* const channel : {"R", "G", "B", "A"})
        header.channels().insert(channel, Imf::Channel(type));
    header.insert("Software", Imf::StringAttribute("Awan " AWAN_VERSION));
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

// Compressing is most of what large pictures of floats cost, so the deadline is looked at in between. T: float or half.
template <typename T>
Status write_rows(const Image& image, float largest, Imf::PixelType type, const Deadline& deadline,
                  Imf::OutputFile& file) {
    const std::size_t row = 4 * static_cast<std::size_t>(image.width);
    const int at_once = std::min(kRowsAtOnce * std::max(Imf::globalThreadCount(), 1), image.height);
    std::vector<T> rows(row * static_cast<std::size_t>(at_once));
    for (int y = 0; y < image.height; y += at_once) {
        if (Status over = deadline.over()) return over;
        const int count = std::min(at_once, image.height - y);
        const float* const first = image.pixels.data() + row * static_cast<std::size_t>(y);
        std::transform(first, first + row * static_cast<std::size_t>(count), rows.begin(),
                       [=](float value) { return T(storable(value, largest)); });
        // A frame buffer is addressed from line 0 of the picture.
        char* const base =
            reinterpret_cast<char*>(rows.data()) -
            static_cast<std::ptrdiff_t>(sizeof(T) * row) * static_cast<std::ptrdiff_t>(y);
        Imf::FrameBuffer buffer;
        std::size_t channel = 0;
        for (const char* const name : {"R", "G", "B", "A"})
            buffer.insert(name, Imf::Slice(type, base + sizeof(T) * channel++, 4 * sizeof(T),
                                           row * sizeof(T)));
        file.setFrameBuffer(buffer);
        file.writePixels(count);
    }
    return std::nullopt;
}

}  // namespace

Result<std::string> encode_exr(const Image& image, Precision precision, const PictureNotes& notes,
                               const Deadline& deadline) {
    if (const Status wrong = check_pixels(image)) return *wrong;
    const bool half_floats = precision == Precision::kHalf;
    const Imf::PixelType type = half_floats ? Imf::HALF : Imf::FLOAT;
    std::string bytes;
    try {
        StringStream stream(bytes);
        Imf::OutputFile file(stream, header_of(image, type, notes), Imf::globalThreadCount());
        const Status late =
            half_floats
                ? write_rows<half>(image, HALF_MAX, type, deadline, file)
                : write_rows<float>(image, std::numeric_limits<float>::max(), type, deadline, file);
        if (late) return *late;
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
