// What the module that reads pictures gives to the program. OpenImageIO brings more libraries than all else together,
// so it is loaded when a texture is given.
#pragma once

#include <cstddef>

namespace awan {

struct PictureBounds {
    // At most, in all and along either side.
    unsigned long long pixels;
    int side;
    // What is said of a picture beyond them.
    const char* too_large;
};
// A byte a pixel, row by row from the top left: its alpha, or where it has none its luminance.
using TakePicture = void(void* to, int width, int height, const unsigned char* values);

// Gives the picture in `bytes`, the first where there are several, to take(to, ...). Null, or what is wrong with it
// (for ever valid). Not more than 5 bytes a pixel are held beside what its reader needs.
using ReadPicture = const char*(const char* bytes, std::size_t size, const PictureBounds& bounds,
                                TakePicture* take, void* to);
inline constexpr const char* kReadPicture = "awan_read_picture";
inline constexpr const char* kPictureModule = "awan_pictures.so";

}  // namespace awan
