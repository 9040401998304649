// Sheets of frames: every frame has a place of its own, nothing is lost, and nothing is larger than a picture may be.
#include "core/formats/sheet.h"

#include <gtest/gtest.h>

#include "core/scene/limits.h"

namespace awan {
namespace {

Image frame_of(int width, int height, float first) {
    Image image{width, height, true, {}};
    for (std::size_t i = 0; i < 4 * image.pixel_count(); ++i)
        image.pixels.push_back(first + static_cast<float>(i));
    return image;
}

TEST(Sheet, AFrameIsWhereTheLayoutSays) {
    for (const std::uint64_t frames : {1u, 2u, 3u, 5u, 12u})
        for (const int columns : {0, 1, 2}) {
            if (static_cast<std::uint64_t>(columns) > frames) continue;
            const auto layout = sheet_layout(frames, 3, 2, columns);
            ASSERT_TRUE(layout.ok());
            if (columns > 0) {
                EXPECT_EQ(layout->columns, columns);
            }
            Image sheet = begin_sheet(*layout, true);
            for (std::uint64_t i = 0; i < frames; ++i)
                put_on_sheet(*layout, i, frame_of(3, 2, 100.0f * static_cast<float>(i + 1)), sheet);
            for (std::uint64_t i = 0; i < frames; ++i)
                for (int y = 0; y < 2; ++y)
                    for (int x = 0; x < 12; ++x) {
                        const int at = 4 * ((layout->y(i) + y) * sheet.width + layout->x(i)) + x;
                        EXPECT_EQ(
                            sheet.pixels[static_cast<std::size_t>(at)],
                            100.0f * static_cast<float>(i + 1) + static_cast<float>(12 * y + x));
                    }
            // What is empty is transparent.
            const std::uint64_t places = static_cast<std::uint64_t>(layout->columns) *
                                         static_cast<std::uint64_t>(layout->rows);
            EXPECT_EQ(sheet.opaque, places == frames);
            EXPECT_LT(places - frames, static_cast<std::uint64_t>(layout->columns));
            if (places > frames) {
                EXPECT_EQ(sheet.pixels.back(), 0.0f);
            }
        }
}

TEST(Sheet, IsAboutASquare) {
    EXPECT_EQ(sheet_layout(16, 64, 64)->columns, 4);
    EXPECT_EQ(sheet_layout(64, 128, 32)->columns, 4);
    EXPECT_EQ(sheet_layout(3, 10, 1000)->columns, 3);
}

TEST(Sheet, IsNotLargerThanAPictureMayBe) {
    const int side = limits::kMaxImageSide;
    EXPECT_TRUE(sheet_layout(2, side / 2, side / 2).ok());
    for (const auto& layout :
         {sheet_layout(2, side, side / 2, 2), sheet_layout(2, 1, side, 1),
          sheet_layout(4, side / 2, side / 2), sheet_layout(1'000'000, 1000, 1000)}) {
        ASSERT_FALSE(layout.ok());
        EXPECT_EQ(layout.error().code, ErrorCode::kTooLarge);
        EXPECT_EQ(layout.error().pointer, "/sequence/frames");
    }
    const auto wide = sheet_layout(3, 8, 8, 4);
    ASSERT_FALSE(wide.ok());
    EXPECT_EQ(wide.error().code, ErrorCode::kInvalidScene);
}

}  // namespace
}  // namespace awan
