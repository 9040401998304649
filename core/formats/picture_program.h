// What the program says that reads pictures, awan_pictures. OpenImageIO brings more libraries than all else together,
// its readers are of all ages, keep every word of a file's metadata for as long as their process lives, and cannot be
// told to stop: so each picture is read by a process of its own, within bounds, that is ended when nobody waits.
#pragma once

#include <cstdint>

namespace awan {

// What it may take: memory, bytes, for the pixels as the file has them, up to 16 bytes each, as they are read, and the
// libraries' own; and seconds of a processor, of which the largest picture of the slowest kind takes a few.
inline constexpr std::uint64_t kPictureMemory = 384u << 20;
inline constexpr std::uint64_t kPictureSeconds = 30;

// Its name, beside the program or in ../lib/awan of it.
inline constexpr const char* kPictureProgram = "awan_pictures";

enum class PictureOutcome : std::int32_t { kRead, kTooLarge, kNoMemory, kRefused };

// Its standard output begins with this. Its standard input is a file, the picture. What follows: of kRead width x
// height bytes, row by row from the top left, the alpha of each pixel or where there is none its luminance; then across
// x down numbers of 16 bits, as the machine has them, the luminance whatever the alpha, by means over areas; then,
// where it is not grey, kPictureHues x kPictureHues times red, green and blue, the hue of what lies there when the
// picture is laid into a square, in the middle: the means of its colours, brought up so that the largest is 255. Else
// what is wrong, in words.
struct PictureHead {
    PictureOutcome outcome = PictureOutcome::kRefused;
    std::int32_t width = 0, height = 0;
    // At most kPictureHeights.
    std::int32_t across = 0, down = 0;
    // 1: its hues follow.
    std::int32_t colored = 0;
};
inline constexpr std::int32_t kPictureHeights = 512;
inline constexpr std::int32_t kPictureHues = 128;

}  // namespace awan
