// Pictures of users as textures.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/base/deadline.h"
#include "core/scene/texture.h"

namespace awan {

// A texture from the bytes of a picture: PNG, JPEG, TIFF, OpenEXR, WebP and what else OpenImageIO reads of still
// pictures. Its alpha says how deep the matter is, or where it has none its luminance (as its numbers stand; of what is
// linear, 0 to 1); its hue tints the matter, and a grey picture is as a white one. It is laid into a square, in the
// middle, and brought to kTextureSide by means over areas. Errors: kInvalidScene (the name, no picture, a broken one,
// one in which there is nothing), kTooLarge (bytes, pixels), and those of read_picture (picture_reader.h).
Result<std::shared_ptr<const Texture>> read_texture(std::string name, std::string_view bytes,
                                                    const Deadline& deadline = {});

}  // namespace awan
