// What lies where in an impostor's atlas, as JSON beside it.
#pragma once

#include <string>
#include <string_view>

#include "core/impostor.h"

namespace awan {

// image: the atlas's file. has_depth: whether that has a channel depth.Z.
std::string impostor_to_json(const Impostor& impostor, std::string_view image, bool has_depth);

}  // namespace awan
