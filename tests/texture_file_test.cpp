// Pictures as textures: what is taken, to the byte, and what is refused.
#include "core/formats/texture_file.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// Whatever is broken off or changed: an error or a texture, never an end of the program.
TEST(TextureFile, BrokenFilesAreErrors) {
    Image image = image_of(40, 30, 0.7f);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] *= static_cast<float>(0.5 + 0.5 * std::sin(0.1 * static_cast<double>(i)));
    const std::string files[] = {png_of(image), encode_exr(image, Precision::kHalf).value()};
    for (const std::string& file : files) {
        std::size_t refused = 0;
        for (std::size_t size = 0; size < file.size(); size += 1 + file.size() / 60)
            refused += read_texture("mine", file.substr(0, size)).ok() ? 0 : 1;
        EXPECT_GT(refused, 30U);
        for (std::size_t at = 0; at < file.size(); at += 1 + file.size() / 150) {
            std::string changed = file;
            changed[at] = static_cast<char>(~changed[at]);
            const auto texture = read_texture("mine", changed);
            if (texture.ok()) {
                EXPECT_EQ((*texture)->depth.size(), std::size_t{kTextureSide * kTextureSide});
            }
        }
    }
}

}  // namespace
}  // namespace awan
