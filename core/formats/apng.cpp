#include "core/formats/apng.h"

#include <zlib.h>

namespace awan {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);

void append_u32(std::uint32_t value, std::string& out) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255);
}
void append_u16(std::uint32_t value, std::string& out) {
    out += static_cast<char>(value >> 8 & 255);
    out += static_cast<char>(value & 255);
}
std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

Error not_a_frame(const char* what) {
    return {ErrorCode::kInternal, "", std::string("a frame of the animation ") + what};
}

}  // namespace

ApngWriter::ApngWriter(std::uint16_t delay_ms, std::uint32_t frames)
    : delay_ms_(delay_ms), frames_(frames) {}

void ApngWriter::chunk(std::string_view type, std::string_view data) {
    append_u32(static_cast<std::uint32_t>(data.size()), out_);
    const std::size_t start = out_.size();
    out_ += type;
    out_ += data;
    append_u32(static_cast<std::uint32_t>(crc32_z(
                   0, reinterpret_cast<const Bytef*>(out_.data() + start), out_.size() - start)),
               out_);
}

Status ApngWriter::add(std::string_view png) {
    if (!png.starts_with(kSignature)) return not_a_frame("is no PNG");
    const bool first = header_.empty();
    bool began = false;
    for (std::size_t at = kSignature.size(); at + 12 <= png.size();) {
        const std::uint32_t length = u32_at(png, at);
        if (length > png.size() - at - 12) return not_a_frame("is cut short");
        const std::string_view type = png.substr(at + 4, 4), data = png.substr(at + 8, length);
        at += 12 + std::size_t{length};
        if (type == "IHDR") {
            if (!first && data != header_) return not_a_frame("is of another size or kind");
            if (!first) continue;
            header_ = data;
            out_ = kSignature;
            chunk(type, data);
            std::string control;
            append_u32(frames_, control);
            // How often it plays; 0 is for ever.
            append_u32(0, control);
            chunk("acTL", control);
        } else if (type == "IDAT") {
            if (!began) {
                std::string control;
                append_u32(sequence_++, control);
                // Width and height, as in the first frame's header.
                control += header_.substr(0, 8);
                append_u32(0, control);
                // Its place in the picture: x and y are 0.
                append_u32(0, control);
                append_u16(delay_ms_, control);
                append_u16(1000, control);
                // The frame is left as it is, and the next one is written over it.
                control += std::string(2, '\0');
                chunk("fcTL", control);
                began = true;
            }
            if (first) {
                chunk(type, data);
            } else {
                std::string numbered;
                append_u32(sequence_++, numbered);
                numbered += data;
                chunk("fdAT", numbered);
            }
        } else if (first && type != "IEND") {
            chunk(type, data);
        }
    }
    return began ? Status() : not_a_frame("has no pixels");
}

std::string ApngWriter::end() {
    chunk("IEND", "");
    return std::move(out_);
}

}  // namespace awan
