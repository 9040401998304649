#include "core/formats/sheet.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/scene/limits.h"

namespace awan {

int SheetLayout::x(std::uint64_t frame) const {
    return static_cast<int>(frame % static_cast<std::uint64_t>(columns)) * width;
}

int SheetLayout::y(std::uint64_t frame) const {
    return static_cast<int>(frame / static_cast<std::uint64_t>(columns)) * height;
}

Result<SheetLayout> sheet_layout(std::uint64_t frames, int width, int height, int columns) {
    if (columns > 0 && static_cast<std::uint64_t>(columns) > frames)
        return Error{ErrorCode::kInvalidScene, "/sequence/frames",
                     "a sheet of " + std::to_string(columns) +
                         " columns needs as many frames, and "
                         "there are " +
                         std::to_string(frames)};
    // As wide as it is high: columns * width = frames / columns * height.
    const double square =
        std::ceil(std::sqrt(static_cast<double>(frames) * static_cast<double>(height) / width));
    const std::uint64_t across =
        columns > 0 ? static_cast<std::uint64_t>(columns)
                    : std::clamp<std::uint64_t>(static_cast<std::uint64_t>(square), 1, frames);
    const std::uint64_t down = (frames + across - 1) / across;
    const std::uint64_t w = across * static_cast<std::uint64_t>(width);
    const std::uint64_t h = down * static_cast<std::uint64_t>(height);
    constexpr auto kSide = static_cast<std::uint64_t>(limits::kMaxImageSide);
    if (w > kSide || h > kSide || w * h > static_cast<std::uint64_t>(limits::kMaxPixels))
        return Error{ErrorCode::kTooLarge, "/sequence/frames",
                     "a sheet of " + std::to_string(frames) + " frames would have " +
                         std::to_string(w) + " x " + std::to_string(h) + " pixels; allowed are " +
                         std::to_string(kSide) + " a side and " +
                         std::to_string(limits::kMaxPixels) +
                         " in all: ask for fewer or smaller frames"};
    return SheetLayout{static_cast<int>(across), static_cast<int>(down), width, height, frames};
}

Image begin_sheet(const SheetLayout& layout, bool opaque) {
    Image sheet{layout.sheet_width(), layout.sheet_height(), false, {}};
    sheet.opaque = opaque && layout.frames == static_cast<std::uint64_t>(layout.columns) *
                                                  static_cast<std::uint64_t>(layout.rows);
    sheet.pixels.assign(4 * sheet.pixel_count(), 0.0f);
    return sheet;
}

void put_on_sheet(const SheetLayout& layout, std::uint64_t frame, const Image& picture,
                  Image& sheet) {
    const std::size_t row = 4 * static_cast<std::size_t>(layout.width);
    const auto x = static_cast<std::size_t>(layout.x(frame));
    const auto y = static_cast<std::size_t>(layout.y(frame));
    for (std::size_t line = 0; line < static_cast<std::size_t>(layout.height); ++line)
        std::copy_n(
            picture.pixels.data() + line * row, row,
            sheet.pixels.data() + 4 * ((y + line) * static_cast<std::size_t>(sheet.width) + x));
}

}  // namespace awan
