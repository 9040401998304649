// Pictures as textures: what is taken, to the byte, and what is refused.
#include "core/formats/texture_file.h"

#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/formats/image_file.h"
#include "core/generate/own_textures.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

Image image_of(int width, int height, float alpha) {
    Image image{width, height, false, {}};
    image.pixels.assign(4 * image.pixel_count(), alpha);
    return image;
}

std::string png_of(const Image& image) {
    return encode_png(image, {0, Tone::kNeutral}).value();
}

void expect_refused(std::string_view bytes, ErrorCode code, const char* word,
                    const char* name = "mine") {
    const auto texture = read_texture(name, bytes);
    ASSERT_FALSE(texture.ok()) << word;
    EXPECT_EQ(texture.error().code, code) << texture.error().message;
    EXPECT_NE(texture.error().message.find(word), std::string::npos) << texture.error().message;
}

TEST(TextureFile, ItsAlphaIsTakenAsItIs) {
    Image image = image_of(kTextureSide, kTextureSide, 0);
    const std::vector<std::uint8_t> depth = own_texture_depth(2);
    for (std::size_t i = 0; i < depth.size(); ++i)
        std::fill_n(&image.pixels[4 * i], 4, static_cast<float>(depth[i]) / 255.0f);
    const auto texture = read_texture("mine", png_of(image));
    ASSERT_TRUE(texture.ok()) << texture.error().message;
    EXPECT_EQ((*texture)->depth, depth);
    EXPECT_EQ((*texture)->hash, kOwnTextures[2].hash);
    EXPECT_EQ((*texture)->name, "mine");
}

TEST(TextureFile, APictureWithoutAlphaIsAsDeepAsItIsBright) {
    Image image = image_of(4, 4, 1);
    image.opaque = true;
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t c = 0; c < 3; ++c) image.pixels[4 * i + c] = i % 4 < 2 ? 0.0f : 0.2f;
    const auto texture = read_texture("mine", png_of(image));
    ASSERT_TRUE(texture.ok()) << texture.error().message;
    const auto& depth = (*texture)->depth;
    EXPECT_EQ(depth[0], 0);
    // 0.2 in sRGB, give or take the dither.
    EXPECT_NEAR(depth[kTextureSide - 1], 124, 2);
}

// The hue that each half of a picture gives, and the depth it is at.
std::array<int, 4> hue_at(const Texture& texture, int x, int y) {
    const auto at = static_cast<std::size_t>(y * kTextureSide + x);
    if (texture.color.empty()) return {255, 255, 255, texture.depth[at]};
    return {texture.color[3 * at], texture.color[3 * at + 1], texture.color[3 * at + 2],
            texture.depth[at]};
}

TEST(TextureFile, ItsHueIsTakenAndItsBrightnessIsNot) {
    // Left half red to the half, right half blue, both half as bright as they can be; all opaque to the half.
    Image image = image_of(kTextureSide, kTextureSide, 0.5f);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const bool left = i % kTextureSide < kTextureSide / 2;
        float* const pixel = &image.pixels[4 * i];
        pixel[0] = left ? 0.25f : 0.05f;
        pixel[1] = 0.05f;
        pixel[2] = left ? 0.05f : 0.25f;
    }
    const auto texture = read_texture("mine", png_of(image));
    ASSERT_TRUE(texture.ok()) << texture.error().message;
    ASSERT_EQ((*texture)->color.size(), std::size_t{3 * kTextureSide * kTextureSide});
    // Straight, .5 and .1 in sRGB: 188 and 89.
    const auto left = hue_at(**texture, 20, 60), right = hue_at(**texture, 100, 60);
    EXPECT_EQ(left[0], 255);
    EXPECT_NEAR(left[1], 255.0 * 89 / 188, 12);
    EXPECT_NEAR(left[2], 255.0 * 89 / 188, 12);
    EXPECT_NEAR(right[0], 255.0 * 89 / 188, 12);
    EXPECT_EQ(right[2], 255);
    EXPECT_NEAR(left[3], 128, 1);
    // The same matter in white is another texture, of the same depth.
    Image white = image_of(kTextureSide, kTextureSide, 0.5f);
    const auto plain = read_texture("mine", png_of(white));
    ASSERT_TRUE(plain.ok());
    EXPECT_EQ((*plain)->depth, (*texture)->depth);
    EXPECT_NE((*plain)->hash, (*texture)->hash);
}

TEST(TextureFile, AGreyOneIsAsAWhiteOne) {
    // Of every brightness and opacity, with what dither and rounding make of it.
    Image grey = image_of(kTextureSide, kTextureSide, 0), white = grey;
    for (std::size_t i = 0; i < grey.pixel_count(); ++i) {
        const float alpha = static_cast<float>(i % 128) / 127,
                    light = static_cast<float>(i / 128) / 127;
        for (std::size_t c = 0; c < 3; ++c) {
            grey.pixels[4 * i + c] = light * alpha;
            white.pixels[4 * i + c] = alpha;
        }
        grey.pixels[4 * i + 3] = white.pixels[4 * i + 3] = alpha;
    }
    const auto a = read_texture("mine", png_of(grey)), b = read_texture("mine", png_of(white));
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_TRUE((*a)->color.empty());
    EXPECT_EQ((*a)->hash, (*b)->hash);
}

TEST(TextureFile, AnOblongStandsInTheMiddleOfItsSquare) {
    const auto texture = read_texture("mine", png_of(image_of(300, 100, 1)));
    ASSERT_TRUE(texture.ok()) << texture.error().message;
    for (int y = 0; y < kTextureSide; ++y) {
        const int at = (*texture)->depth[static_cast<std::size_t>(y * kTextureSide + 64)];
        // A third of the side; what lies across the border is what it covers.
        const double covered = y < 42 || y > 85 ? 0 : y > 42 && y < 85 ? 1 : 1.0 / 3;
        EXPECT_NEAR(at, 255 * covered, covered > 0 && covered < 1 ? 1 : 0) << y;
    }
}

TEST(TextureFile, OtherKindsAreRead) {
    Image image = image_of(32, 32, 0.5f);
    const auto texture = read_texture("mine", encode_exr(image, Precision::kHalf).value());
    ASSERT_TRUE(texture.ok()) << texture.error().message;
    EXPECT_NEAR((*texture)->depth[5000], 128, 1);
    // A PPM, P6: luminance.
    std::string ppm = "P6\n2 1\n255\n";
    ppm += std::string("\xff\xff\xff\x00\x00\x00", 6);
    const auto other = read_texture("other", ppm);
    ASSERT_TRUE(other.ok()) << other.error().message;
    EXPECT_EQ((*other)->depth[64 * kTextureSide], 255);
    EXPECT_EQ((*other)->depth[64 * kTextureSide + 127], 0);
}

// PNGs of every kind: bits, palette, interlaced. What counts is the alpha, or the luminance where there is none.
struct PngKind {
    int colour, bits, interlace;
    // The bytes of a pixel whose alpha (or grey, or all of its colours) is `value`.
    std::string (*pixel)(std::uint8_t value);
};

std::string png_of_kind(const PngKind& kind, const std::vector<std::uint8_t>& values) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto write = [](png_structp from, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(from))
            ->append(reinterpret_cast<const char*>(data), size);
    };
    png_set_write_fn(png, &bytes, write, [](png_structp) {});
    png_set_IHDR(png, info, kTextureSide, kTextureSide, kind.bits, kind.colour, kind.interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (kind.colour == PNG_COLOR_TYPE_PALETTE) {
        std::array<png_color, 256> palette{};
        std::array<png_byte, 256> alpha{};
        for (std::size_t i = 0; i < 256; ++i) alpha[i] = static_cast<png_byte>(255 - i);
        png_set_PLTE(png, info, palette.data(), 256);
        png_set_tRNS(png, info, alpha.data(), 256, nullptr);
    }
    std::vector<std::string> rows(kTextureSide);
    std::vector<png_bytep> starts;
    for (std::size_t y = 0; y < kTextureSide; ++y) {
        for (std::size_t x = 0; x < kTextureSide; ++x)
            rows[y] += kind.pixel(values[y * kTextureSide + x]);
        starts.push_back(reinterpret_cast<png_bytep>(rows[y].data()));
    }
    png_set_rows(png, info, starts.data());
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

TEST(TextureFile, PngsOfEveryKindAreRead) {
    std::vector<std::uint8_t> values(kTextureSide * kTextureSide);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint8_t>(i * 7 + i / 128);
    using Value = std::uint8_t;
    const PngKind kinds[] = {
        {PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_NONE,
         [](Value v) { return std::string(1, static_cast<char>(v)); }},
        {PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_ADAM7,
         [](Value v) { return std::string(2, static_cast<char>(v)); }},
        {PNG_COLOR_TYPE_PALETTE, 8, PNG_INTERLACE_ADAM7,
         [](Value v) { return std::string(1, static_cast<char>(255 - v)); }},
        {PNG_COLOR_TYPE_GRAY_ALPHA, 8, PNG_INTERLACE_NONE,
         [](Value v) { return "x" + std::string(1, static_cast<char>(v)); }},
        {PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7,
         [](Value v) { return std::string(3, static_cast<char>(v)); }},
        {PNG_COLOR_TYPE_RGB_ALPHA, 16, PNG_INTERLACE_ADAM7,
         [](Value v) { return "RrGgBb" + std::string(2, static_cast<char>(v)); }},
    };
    for (const PngKind& kind : kinds) {
        const auto texture = read_texture("mine", png_of_kind(kind, values));
        ASSERT_TRUE(texture.ok()) << kind.colour << ": " << texture.error().message;
        EXPECT_EQ((*texture)->depth, values) << kind.colour << ' ' << kind.bits;
    }
}

TEST(TextureFile, WhatIsNoPictureIsRefused) {
    expect_refused("", ErrorCode::kInvalidScene, "no picture");
    expect_refused("{\"cubes\": []}", ErrorCode::kInvalidScene, "no picture");
    expect_refused(std::string(5000, 'x'), ErrorCode::kInvalidScene, "no picture");
    expect_refused(png_of(image_of(8, 8, 0)), ErrorCode::kInvalidScene, "nothing in it");
    expect_refused(png_of(image_of(8, 8, 1)), ErrorCode::kInvalidScene, "name", "../up");
    expect_refused(png_of(image_of(8, 8, 1)), ErrorCode::kInvalidScene, "own", "soft");
}

TEST(TextureFile, WhatIsTooLargeIsRefusedBeforeItIsRead) {
    // A PNG of 100,000 x 100,000 pixels, as its head says: the checksum of the head is right.
    std::string png = png_of(image_of(8, 8, 1));
    const std::uint8_t head[] = {0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0};
    std::memcpy(&png[16], head, sizeof head);
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= static_cast<std::uint8_t>(png[i]);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xedb88320 & (0 - (crc & 1)));
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i) png[29 + i] = static_cast<char>(crc >> (24 - 8 * i));
    expect_refused(png, ErrorCode::kTooLarge, "pixels");
    expect_refused(std::string(limits::kMaxTextureBytes + 1, 'x'), ErrorCode::kTooLarge, "bytes");
}

#ifndef AWAN_SANITIZED  // whose own memory is far beyond any of these
// Where a process may have so much memory only, it is not the picture's fault that there is not enough.
TEST(TextureFile, WithoutMemoryItIsNotThePictureThatIsWrong) {
    Image image = image_of(3000, 2000, 1);
    image.opaque = true;
    const std::string png = png_of(image);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    int read = 0, refused = 0;
    for (rlim_t mebibytes = 150; mebibytes <= 950; mebibytes += 100) {
        rlimit less = before;
        less.rlim_cur = mebibytes << 20;
        ASSERT_EQ(setrlimit(RLIMIT_AS, &less), 0);
        const auto texture = read_texture("mine", png);
        ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
        if (texture.ok()) {
            ++read;
            continue;
        }
        ++refused;
        EXPECT_EQ(texture.error().code, ErrorCode::kOutOfMemory)
            << mebibytes << " MiB: " << texture.error().message;
    }
    EXPECT_GT(read, 0);
    EXPECT_GT(refused, 0);
}
#endif

// Whatever is broken off or changed: an error or a texture. Each is read by a process of its own, so a few of them do.
TEST(TextureFile, BrokenFilesAreErrors) {
    Image image = image_of(40, 30, 0.7f);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] *= static_cast<float>(0.5 + 0.5 * std::sin(0.1 * static_cast<double>(i)));
    const std::string files[] = {png_of(image), encode_exr(image, Precision::kHalf).value()};
    for (const std::string& file : files) {
        for (std::size_t size = 1; size < file.size(); size += 1 + file.size() / 3)
            EXPECT_FALSE(read_texture("mine", file.substr(0, size)).ok()) << size;
        for (std::size_t at = 9; at < file.size(); at += 1 + file.size() / 4) {
            std::string changed = file;
            changed[at] = static_cast<char>(~changed[at]);
            const auto texture = read_texture("mine", changed);
            if (texture.ok()) {
                EXPECT_EQ((*texture)->depth.size(), std::size_t{kTextureSide * kTextureSide});
            }
        }
    }
}

// A GIF of 42 bytes whose screen has 65,535 x 65,535 pixels: 16 GiB, which its reader makes before anybody can ask how
// large it is.
TEST(TextureFile, ABombEndsInABoundOfItsOwn) {
    using namespace std::string_literals;
    const std::string gif =
        "GIF89a\xff\xff\xff\xff\x80\0\0\0\0\0\xff\xff\xff"s
        ",\0\0\0\0\1\0\1\0\0\2\2\x44\1\0;"s;
    const auto texture = read_texture("mine", gif);
    ASSERT_FALSE(texture.ok());
    EXPECT_TRUE(texture.error().code == ErrorCode::kTooLarge ||
                texture.error().code == ErrorCode::kInvalidScene);
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    // KiB.
    EXPECT_LT(children.ru_maxrss, 600 << 10);
}

std::string segment(int marker, std::string_view data) {
    std::string out = {'\xff', static_cast<char>(marker)};
    out += {static_cast<char>((data.size() + 2) >> 8), static_cast<char>((data.size() + 2) & 255)};
    return out.append(data);
}

// A progressive JPEG of 4096 x 4096, all grey, that says "nothing new" of all blocks so many times: 32 bytes each, over
// which a reader takes a millisecond and more.
std::string jpeg_of_scans(int scans) {
    using namespace std::string_literals;
    const auto code = [](int place, int symbol) {
        return segment(0xC4, std::string{static_cast<char>(place), 1} + std::string(15, '\0') +
                                 static_cast<char>(symbol));
    };
    std::string jpeg = "\xff\xd8"s + segment(0xDB, "\0"s + std::string(64, '\1'));
    jpeg += segment(0xC2, "\x08\x10\0\x10\0\1\1\x11\0"s);
    jpeg += code(0x00, 0x00) + segment(0xDA, "\1\1\0\0\0\0"s) + std::string(512 * 512 / 8, '\0');
    jpeg += code(0x10, 0xE0);
    // Of 15 bits each, the end of 2^14 + 2^14 - 1 blocks, eight times.
    std::string bits;
    for (int i = 0; i < 8; ++i) bits += "0" + std::string(14, '1');
    std::string ends;
    for (std::size_t i = 0; i < bits.size(); i += 8) {
        ends += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
        if (ends.back() == '\xff') ends += '\0';
    }
    for (int i = 0; i < scans; ++i) jpeg += segment(0xDA, "\1\1\0\1\x3f\0"s) + ends;
    return jpeg + "\xff\xd9"s;
}

TEST(TextureFile, ADeadlineEndsWhatCannotBeToldToStop) {
    ASSERT_TRUE(read_texture("mine", jpeg_of_scans(1)).ok());
    const auto start = Deadline::Clock::now();
    const auto texture =
        read_texture("mine", jpeg_of_scans(100'000), {start + std::chrono::seconds(1), {}});
    ASSERT_FALSE(texture.ok());
    EXPECT_EQ(texture.error().code, ErrorCode::kOverDeadline);
    EXPECT_LT(ms_since(start), 1500);
    // Nothing of it is left.
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

}  // namespace
}  // namespace awan
