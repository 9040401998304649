#include "server/document/scene_text.h"

#include <strings.h>

#include <algorithm>

#include "core/formats/awn.h"
#include "core/formats/particle_files.h"
#include "server/document/json.h"

namespace awan {

Result<SceneDraft> read_scene(SceneFormat format, std::string_view bytes) {
    switch (format) {
        case SceneFormat::kAwn:
            return read_awn(bytes);
        case SceneFormat::kPly:
            return read_particles_ply(bytes);
        case SceneFormat::kCsv:
            return read_particles_csv(bytes);
        case SceneFormat::kJson:
            break;
    }
    return parse_scene(bytes);
}

std::optional<SceneFormat> scene_format_of_type(std::string_view media_type) {
    if (media_type == "application/json") return SceneFormat::kJson;
    if (media_type == "text/x-awn") return SceneFormat::kAwn;
    if (media_type == "application/x-ply") return SceneFormat::kPly;
    if (media_type == "text/csv") return SceneFormat::kCsv;
    return std::nullopt;
}

std::optional<SceneFormat> scene_format_of_name(std::string_view file_name) {
    const auto ends_with = [&](std::string_view extension) {
        return file_name.size() > extension.size() &&
               strncasecmp(file_name.data() + file_name.size() - extension.size(), extension.data(),
                           extension.size()) == 0;
    };
    if (ends_with(".json")) return SceneFormat::kJson;
    if (ends_with(".awn")) return SceneFormat::kAwn;
    if (ends_with(".ply")) return SceneFormat::kPly;
    if (ends_with(".csv")) return SceneFormat::kCsv;
    return std::nullopt;
}

SceneFormat sniff_scene_format(std::string_view bytes) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return SceneFormat::kJson;
    bytes.remove_prefix(start);
    if (bytes.front() == '{' || bytes.front() == '[' || bytes.front() == '"')
        return SceneFormat::kJson;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return SceneFormat::kPly;
    const std::string_view line = bytes.substr(0, std::min(bytes.find('\n'), bytes.size()));
    // A layout's first line is numbers, whose only letter is the e of an exponent.
    const bool letters = std::any_of(line.begin(), line.end(), [](char c) {
        const char l = static_cast<char>(c | 0x20);
        return l >= 'a' && l <= 'z' && l != 'e';
    });
    return letters ? SceneFormat::kCsv : SceneFormat::kAwn;
}

}  // namespace awan
