// A scene as bytes, in any of the forms it may come in: HTTP bodies and files of the command line.
#pragma once

#include <optional>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

enum class SceneFormat { kJson, kAwn, kPly, kCsv };

Result<SceneDraft> read_scene(SceneFormat format, std::string_view bytes);

// From a media type as media_type() gives it.
std::optional<SceneFormat> scene_format_of_type(std::string_view media_type);
inline constexpr std::string_view kSceneTypes =
    "application/json, text/x-awn, application/x-ply, text/csv";

// From a file's name, by its extension (any case).
std::optional<SceneFormat> scene_format_of_name(std::string_view file_name);

// From the bytes themselves: '{' JSON, "ply" PLY, a first line with letters CSV, else a layout.
SceneFormat sniff_scene_format(std::string_view bytes);

}  // namespace awan
