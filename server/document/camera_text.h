// Camera keys in a file of their own.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/scene/scene.h"

namespace awan {

// Puts keys into the scene's sequence: text is JSON, either a list of keys as `sequence.camera` has them, or an object
// as `sequence`, in whose place it comes. A scene without a sequence gets one, from the first of the keys to the last,
// in which its clouds stand. Pointers of errors are into the text; ranges are validate()'s business, whose pointers
// text_pointer() turns into such.
Status set_camera_keys(std::string_view text, SceneDraft& draft);

// The pointer into that text of a pointer into the scene.
std::string text_pointer(std::string_view text, std::string_view pointer);

}  // namespace awan
