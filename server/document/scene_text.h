// A scene as bytes, in any of the forms it may come in: HTTP bodies and files of the command line.
#pragma once

#include <optional>
#include <string_view>

#include "core/formats/particle_files.h"
#include "core/scene/scene.h"

namespace awan {

enum class SceneFormat { kJson, kAwn, kAwa, kPly, kCsv };

// Texts may be in UTF-8 or UTF-16. reading.radius is given to all particles of the scene that come ready-made; a scene
// without any is an error then.
Result<SceneDraft> read_scene(SceneFormat format, std::string_view bytes,
                              const ParticleReading& reading = {});

// From a media type as media_type() gives it; types that end with +json are JSON.
std::optional<SceneFormat> scene_format_of_type(std::string_view media_type);
inline constexpr std::string_view kSceneTypes =
    "application/json, text/x-awn, text/x-awa, application/x-ply, text/csv";

// From a file's name, by its extension (any case; .gz behind it does not count).
std::optional<SceneFormat> scene_format_of_name(std::string_view file_name);

// From the bytes themselves: '{' JSON, "ply" PLY, a "awa" a layout of textures, a first line with letters or with
// several numbers CSV, else a layout.
SceneFormat sniff_scene_format(std::string_view bytes);

}  // namespace awan
