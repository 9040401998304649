// Pictures of users, read by a program of its own (picture_program.h).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/deadline.h"
#include "core/base/result.h"

namespace awan {

// A byte a pixel, row by row from the top left: its alpha, or where it has none its luminance. And its luminance alone,
// brought down to across x down pixels, at most kPictureHeights either way (picture_program.h); 65535 white. And its
// hue at kPictureHues^2 places, 3 bytes each; EMPTY where it is grey.
struct GreyPicture {
    int width = 0, height = 0;
    std::vector<unsigned char> values;
    int across = 0, down = 0;
    std::vector<std::uint16_t> luminance;
    std::vector<unsigned char> hues;
};

// The first picture of `bytes`. Errors: kInvalidScene (no picture, a broken one, one that takes more than
// kPictureMemory or kPictureSeconds to read), kTooLarge (limits::kMaxTexturePixels,
// kMaxTexturePictureSide), kUnsupported (the program is not there), kOutOfMemory (there is none to start it), and the
// deadline's; the program has ended by then.
Result<GreyPicture> read_picture(std::string_view bytes, const Deadline& deadline);

}  // namespace awan
