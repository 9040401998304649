// encode_png(). The only user of libpng.
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <vector>

#include "core/base/thrown.h"
#include "core/formats/image_file.h"
#include "core/formats/tone.h"

namespace awan {
namespace {

// What libpng writes, and what it says when it cannot.
struct PngSink {
    std::string bytes;
    std::string error;
    bool no_memory = false;
};

// libpng says in many words that it has no memory, so it gets it here.
void* on_png_malloc(png_structp png, png_alloc_size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) static_cast<PngSink*>(png_get_mem_ptr(png))->no_memory = true;
    return memory;
}
void on_png_free(png_structp, void* memory) {
    std::free(memory);
}

void on_png_error(png_structp png, png_const_charp message) {
    auto* const sink = static_cast<PngSink*>(png_get_error_ptr(png));
    try {
        sink->error = message;
    } catch (const std::exception&) {
        sink->no_memory = true;
    }
    png_longjmp(png, 1);
}
void on_png_warning(png_structp, png_const_charp) {}
void on_png_bytes(png_structp png, png_bytep bytes, std::size_t size) {
    auto* const sink = static_cast<PngSink*>(png_get_io_ptr(png));
    try {
        sink->bytes.append(reinterpret_cast<const char*>(bytes), size);
    } catch (const std::exception&) {
        sink->no_memory = true;
    }
    if (sink->no_memory) png_error(png, "there is not enough memory");
}
void on_png_flush(png_structp) {}

// One row of a picture in 8 or 16 bits a channel, as PNG wants it: of 16 the higher byte first.
struct RowMaker {
    const Image& image;
    const Film& film;
    int bits;

    void make(int y, std::uint8_t* to) const {
        const float* from = image.pixels.data() +
                            4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
        for (int x = 0; x < image.width; ++x, from += 4) {
            // NaN becomes 0.
            const float alpha = image.opaque ? 1.0f : from[3] > 0 ? std::min(from[3], 1.0f) : 0.0f;
            // Straight alpha: colour is divided by alpha while it is still linear, then tone mapped. Where alpha rounds
            // to 0 nothing shows; black packs better than the noise of 0 / 0.
            const float most = bits == 8 ? 255.0f : 65535.0f;
            const auto alpha_code = static_cast<std::uint16_t>(alpha * most + 0.5f);
            const float scale = image.opaque      ? film.gain()
                                : alpha_code == 0 ? 0.0f
                                                  : film.gain() / alpha;
            const glm::vec3 exposed = scale * glm::vec3(from[0], from[1], from[2]);
            if (bits == 8)
                for (const std::uint8_t code : film.dithered(exposed, x, y)) put(code, to);
            else
                for (const std::uint16_t code : film.rounded_16(exposed)) put(code, to);
            if (!image.opaque) put(alpha_code, to);
        }
    }

  private:
    void put(std::uint16_t code, std::uint8_t*& to) const {
        if (bits == 16) *to++ = static_cast<std::uint8_t>(code >> 8);
        *to++ = static_cast<std::uint8_t>(code & 0xFF);
    }
};

// libpng leaves by longjmp when something is wrong, past whatever stands between; so everything that owns memory is
// made by who calls this. False when it has.
bool write_png(png_structp png, png_infop info, const RowMaker& maker, std::uint8_t* row,
               const Deadline& deadline) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    const Image& image = maker.image;
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), maker.bits,
                 image.opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    char software[] = "Software", name[] = "Awan " AWAN_VERSION;
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = software;
    text.text = name;
    png_set_text(png, info, &text, 1);
    // zlib's fastest level with one fixed filter. Milliseconds and kB of 800 x 600 (a smooth sky behind a smooth
    // cloud, opaque, one core): level 1 with libpng's adaptive filters (the default) 33, 148; level 6 with them 80,
    // 97; with the filter "up" alone level 1 12, 151; 2 16, 144; 4 19, 112; 6 70, 99. Of the 12, 4 are the tone
    // curve.
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    // Data in few pieces.
    png_set_compression_buffer_size(png, 64u << 10);
    png_write_info(png, info);
    for (int y = 0; y < image.height; ++y) {
        if (deadline.over()) return false;
        maker.make(y, row);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return true;
}

}  // namespace

Result<std::string> encode_png(const Image& image, const FilmSettings& settings, int bits,
                               const Deadline& deadline) {
    if (const Status wrong = check_pixels(image)) return *wrong;
    const Film film(settings);
    const RowMaker maker{image, film, bits};
    const std::size_t channels = image.opaque ? 3 : 4;
    std::vector<std::uint8_t> row(channels * static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(bits / 8));
    PngSink sink;
    png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &sink, on_png_error,
                                                on_png_warning, &sink, on_png_malloc, on_png_free);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    bool written = false;
    if (info != nullptr) {
        png_set_write_fn(png, &sink, on_png_bytes, on_png_flush);
        written = write_png(png, info, maker, row.data(), deadline);
    }
    png_destroy_write_struct(&png, &info);
    if (const auto over = deadline.over(); over && !written) return *over;
    if (sink.no_memory) return out_of_memory();
    if (!written) return encoder_error(sink.error.empty() ? "libpng could not begin" : sink.error);
    return std::move(sink.bytes);
}

}  // namespace awan
