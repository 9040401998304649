// Moving pictures: what is in the files, by their definitions and by other people's readers (Chromium plays them in
// page_test.sh's browser; here libwebp's container and OpenImageIO).
#include "core/formats/animation.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>

#include "core/formats/apng.h"
#include "core/formats/image_file.h"
#include "server/cli/frames.h"

namespace awan {
namespace {

Image picture(int width, int height, float level, bool opaque) {
    Image image{width, height, opaque, {}};
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float ramp = static_cast<float>(i % static_cast<std::size_t>(width));
        for (const float value : {level * ramp, level, 0.1f, opaque ? 1.0f : 0.5f})
            image.pixels.push_back(value);
    }
    return image;
}

struct Chunk {
    std::string type, data;
};

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

// Every chunk's sum is checked.
std::vector<Chunk> chunks_of(const std::string& png) {
    std::vector<Chunk> chunks;
    EXPECT_EQ(png.substr(0, 8), std::string("\x89PNG\r\n\x1a\n", 8));
    for (std::size_t at = 8; at < png.size();) {
        const std::uint32_t length = big_endian(png, at);
        const std::string body = png.substr(at + 4, length + 4);
        EXPECT_EQ(
            big_endian(png, at + 8 + length),
            crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
        chunks.push_back({body.substr(0, 4), body.substr(4)});
        at += 12 + length;
    }
    return chunks;
}

std::string pixels_of(const std::vector<Chunk>& chunks) {
    std::string all;
    for (const Chunk& chunk : chunks)
        if (chunk.type == "IDAT") all += chunk.data;
    return all;
}

TEST(Apng, HoldsEveryFramesPixelsAsTheyWere) {
    auto animation = Animation::begin(AnimationFormat::kApng, 8, 3);
    ASSERT_TRUE(animation.ok());
    std::vector<std::string> pixels;
    for (const float level : {0.1f, 0.4f, 0.9f}) {
        const Image image = picture(33, 17, level, false);
        pixels.push_back(pixels_of(chunks_of(*encode_png(image, {}))));
        ASSERT_FALSE(animation->add(image, {}).has_value());
    }
    auto file = animation->end();
    ASSERT_TRUE(file.ok());
    const std::vector<Chunk> chunks = chunks_of(*file);
    EXPECT_EQ(chunks.front().type, "IHDR");
    EXPECT_EQ(chunks.back().type, "IEND");
    std::uint32_t next = 0;
    std::vector<std::string> found;
    for (const Chunk& chunk : chunks) {
        if (chunk.type == "acTL") {
            EXPECT_EQ(big_endian(chunk.data, 0), 3U);
            EXPECT_EQ(big_endian(chunk.data, 4), 0U);  // for ever
        } else if (chunk.type == "fcTL") {
            EXPECT_EQ(big_endian(chunk.data, 0), next++);
            EXPECT_EQ(big_endian(chunk.data, 4), 33U);
            EXPECT_EQ(big_endian(chunk.data, 8), 17U);
            EXPECT_EQ(chunk.data.size(), 26U);
            EXPECT_EQ(big_endian(chunk.data, 20), (125U << 16) + 1000);  // an eighth of a second
            found.emplace_back();
        } else if (chunk.type == "fdAT") {
            EXPECT_EQ(big_endian(chunk.data, 0), next++);
            found.back() += chunk.data.substr(4);
        } else if (chunk.type == "IDAT") {
            found.back() += chunk.data;
        }
    }
    EXPECT_EQ(found, pixels);
}

TEST(Apng, RefusesFramesOfAnotherSizeAndWhatIsNoPng) {
    ApngWriter writer(40, 2);
    EXPECT_TRUE(writer.add("GIF89a").has_value());
    ASSERT_FALSE(writer.add(*encode_png(picture(8, 8, 1, true), {})).has_value());
    EXPECT_TRUE(writer.add(*encode_png(picture(9, 8, 1, true), {})).has_value());
    EXPECT_TRUE(writer.add(*encode_png(picture(8, 8, 1, false), {})).has_value());
    const std::string whole = *encode_png(picture(8, 8, 1, true), {});
    EXPECT_TRUE(writer.add(whole.substr(0, whole.size() / 2)).has_value());
}

// RIFF: a list of ANMF chunks with their times (https://developers.google.com/speed/webp/docs/riff_container).
TEST(Webp, HasEveryFrameForItsTime) {
    auto animation = Animation::begin(AnimationFormat::kWebp, 10, 4);
    ASSERT_TRUE(animation.ok());
    for (const float level : {0.1f, 0.3f, 0.6f, 0.9f})
        ASSERT_FALSE(animation->add(picture(40, 30, level, true), {}).has_value());
    auto file = animation->end();
    ASSERT_TRUE(file.ok());
    ASSERT_EQ(file->substr(0, 4), "RIFF");
    ASSERT_EQ(file->substr(8, 4), "WEBP");
    const auto little_endian = [&](std::size_t at, int bytes) {
        std::uint32_t value = 0;
        for (int i = bytes - 1; i >= 0; --i)
            value =
                value << 8 | static_cast<unsigned char>((*file)[at + static_cast<std::size_t>(i)]);
        return value;
    };
    int frames = 0;
    for (std::size_t at = 12; at + 8 <= file->size();) {
        const std::uint32_t length = little_endian(at + 4, 4);
        if (file->substr(at, 4) == "ANMF") {
            ++frames;
            EXPECT_EQ(little_endian(at + 8 + 12, 3), 100U);  // ms
        }
        if (file->substr(at, 4) == "VP8X") {
            EXPECT_EQ(little_endian(at + 8 + 4, 3) + 1, 40U);
            EXPECT_EQ(little_endian(at + 8 + 7, 3) + 1, 30U);
        }
        at += 8 + length + (length & 1);
    }
    EXPECT_EQ(frames, 4);
}

// No whole number of milliseconds makes thirty frames a second: over a second they come to one all the same.
TEST(Webp, FramesDoNotDrift) {
    auto animation = Animation::begin(AnimationFormat::kWebp, 30, 30);
    ASSERT_TRUE(animation.ok());
    for (int i = 0; i < 30; ++i)
        ASSERT_FALSE(animation->add(picture(8, 6, 0.02F * static_cast<float>(i) + 0.1F, true), {})
                         .has_value());
    const auto file = animation->end();
    ASSERT_TRUE(file.ok());
    int all_ms = 0;
    for (std::size_t at = 12; at + 8 <= file->size();) {
        const auto byte = [&](std::size_t i) {
            return static_cast<unsigned char>((*file)[at + i]);
        };
        const std::size_t length =
            byte(4) | byte(5) << 8 | byte(6) << 16 | static_cast<std::size_t>(byte(7)) << 24;
        if (file->substr(at, 4) == "ANMF") all_ms += byte(20) | byte(21) << 8 | byte(22) << 16;
        at += 8 + length + (length & 1);
    }
    EXPECT_EQ(all_ms, 1000);
}

TEST(Frames, AreReadAsWritten) {
    using List = std::vector<std::uint64_t>;
    EXPECT_EQ(*parse_frames("", 3), (List{0, 1, 2}));
    EXPECT_EQ(*parse_frames("all", 2), (List{0, 1}));
    EXPECT_EQ(*parse_frames("7", 8), (List{7}));
    EXPECT_EQ(*parse_frames("4-6,1", 8), (List{4, 5, 6, 1}));
    for (const char* const wrong : {"8", "-1", "3-1", "1,,2", "1-", "a", "1 2", "0-3,0-4", ",",
                                    "99999999999999999999", "0-18446744073709551615"})
        EXPECT_FALSE(parse_frames(wrong, 8).ok()) << wrong;
}

TEST(Frames, NumbersStandInNames) {
    EXPECT_EQ(numbered_name("a.%04d.png", 7), "a.0007.png");
    EXPECT_EQ(numbered_name("a.%d.png", 12), "a.12.png");
    EXPECT_EQ(numbered_name("a.%09d.png", 12), "a.000000012.png");
    EXPECT_EQ(numbered_name("a.%01d.png", 12), "a.12.png");
    EXPECT_EQ(numbered_name("100%/a%02d.png", 123), "100%/a123.png");
    EXPECT_EQ(numbered_name("a.png", 7), "a.png");
    EXPECT_EQ(numbered_name("%s%n.png", 7), "%s%n.png");  // no other letter means anything
    EXPECT_TRUE(check_numbered("a.png", 2).has_value());
    EXPECT_FALSE(check_numbered("a.png", 1).has_value());
    EXPECT_FALSE(check_numbered("a%03d.png", 9).has_value());
}

}  // namespace
}  // namespace awan
