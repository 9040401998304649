// The frames of a sequence side by side on one picture (a "flipbook" or "sprite sheet"), as game engines play them.
#pragma once

#include <cstdint>

#include "core/base/image.h"
#include "core/base/result.h"

namespace awan {

// Where frames lie on their sheet: row by row from the top left, each of the same size, without gaps.
struct SheetLayout {
    int columns = 1, rows = 1;
    // Pixels of a frame.
    int width = 1, height = 1;
    std::uint64_t frames = 1;

    int sheet_width() const { return columns * width; }
    int sheet_height() const { return rows * height; }
    // Pixels, of the top left corner of a frame.
    int x(std::uint64_t frame) const;
    int y(std::uint64_t frame) const;
};

// frames >= 1. columns: 0 makes the sheet about as wide as it is high. Errors: kTooLarge, the sheet would be larger
// than a picture may be (limits::kMaxImageSide, limits::kMaxPixels); kInvalidScene, more columns than frames.
Result<SheetLayout> sheet_layout(std::uint64_t frames, int width, int height, int columns = 0);

// An empty sheet: transparent, or opaque where all frames are and none of its places stays empty.
Image begin_sheet(const SheetLayout& layout, bool opaque);

// Puts a picture of the layout's size in the place of a frame < layout.frames.
void put_on_sheet(const SheetLayout& layout, std::uint64_t frame, const Image& picture,
                  Image& sheet);

}  // namespace awan
