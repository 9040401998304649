#include "server/document/scene_text.h"

#include <strings.h>

#include <algorithm>

#include "core/formats/awa.h"
#include "core/formats/awn.h"
#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "server/document/json.h"
#include "server/document/media_types.h"
#include "server/document/text_bytes.h"

namespace awan {

namespace {

Result<SceneDraft> read_as(SceneFormat format, std::string_view bytes,
                           const ParticleReading& reading) {
    switch (format) {
        case SceneFormat::kAwn:
            return read_awn(bytes);
        case SceneFormat::kAwa:
            return read_awa(bytes);
        case SceneFormat::kPly:
            return read_particles_ply(bytes, reading);
        case SceneFormat::kCsv:
            return read_particles_csv(bytes, reading);
        case SceneFormat::kJson:
            break;
    }
    return parse_scene(without_byte_order_mark(bytes));
}

// Gives the radius to all ready particles; false when there are none to give it to.
bool set_radii(SceneDraft& draft, double radius) {
    bool any = false;
    for (Cloud& cloud : draft.clouds) {
        if (cloud.model != CloudModel::kParticles) continue;
        any = true;
        std::fill(cloud.ready.radii.begin(), cloud.ready.radii.end(), static_cast<float>(radius));
    }
    return any;
}

}  // namespace

Result<SceneDraft> read_scene(SceneFormat format, std::string_view bytes,
                              const ParticleReading& reading) {
    if (bytes.starts_with("PK\x03\x04"))
        return Error{ErrorCode::kMalformed, "",
                     "this is a ZIP archive, as .xlsx, .ods and .npz files are; save a table as "
                     "CSV"};
    std::optional<std::string> text;
    if (format != SceneFormat::kPly || !bytes.starts_with("ply")) {
        auto converted = from_utf16(bytes);
        if (!converted) return converted.error();
        text = *std::move(converted);
        if (text && reading.notes != nullptr) reading.notes->push_back("the text is in UTF-16");
    }
    auto draft = read_as(format, text ? *text : bytes, reading);
    if (draft && reading.radius && format != SceneFormat::kPly && format != SceneFormat::kCsv &&
        !set_radii(*draft, *reading.radius))
        return Error{ErrorCode::kInvalidScene, "",
                     "radius is for particles that come ready-made, and the scene has none"};
    return draft;
}

std::optional<SceneFormat> scene_format_of_type(std::string_view media_type) {
    const std::string_view type = usual_media_type(media_type);
    if (type == "application/json" || (type.starts_with("application/") && type.ends_with("+json")))
        return SceneFormat::kJson;
    if (type == "text/x-awn") return SceneFormat::kAwn;
    if (type == "text/x-awa") return SceneFormat::kAwa;
    if (type == "application/x-ply") return SceneFormat::kPly;
    if (type == "text/csv" || type == "text/tab-separated-values") return SceneFormat::kCsv;
    return std::nullopt;
}

std::optional<SceneFormat> scene_format_of_name(std::string_view file_name) {
    const auto ends_with = [&](std::string_view extension) {
        return file_name.size() > extension.size() &&
               strncasecmp(file_name.data() + file_name.size() - extension.size(), extension.data(),
                           extension.size()) == 0;
    };
    if (ends_with(".gz")) file_name.remove_suffix(3);
    if (ends_with(".json")) return SceneFormat::kJson;
    if (ends_with(".awn")) return SceneFormat::kAwn;
    if (ends_with(".awa")) return SceneFormat::kAwa;
    if (ends_with(".ply")) return SceneFormat::kPly;
    if (ends_with(".csv") || ends_with(".tsv") || ends_with(".xyz") || ends_with(".asc"))
        return SceneFormat::kCsv;
    return std::nullopt;
}

namespace {

// How many words a line has; more than two are counted as two.
int words_of(std::string_view line) {
    line = trim(line);
    if (line.empty()) return 0;
    return line.find_first_of(" \t,;|") == std::string_view::npos ? 1 : 2;
}

// Layouts begin with two lines of one number each; tables of numbers have several in their lines.
bool is_layout(std::string_view text) {
    for (int lines = 0; lines < 2 && !text.empty();) {
        const int words = words_of(take_line(text));
        if (words > 1) return false;
        lines += words;
    }
    return true;
}

// A text of JSON, which is no scene, or the first name of a table.
bool is_one_string(std::string_view bytes) {
    const std::size_t end = bytes.find('"', 1);
    return end == std::string_view::npos ||
           bytes.find_first_not_of(" \t\r\n", end + 1) == std::string_view::npos;
}

}  // namespace

SceneFormat sniff_scene_format(std::string_view bytes) {
    bytes = without_byte_order_mark(bytes);
    // Of UTF-16 the first letters are enough.
    const auto converted =
        from_utf16(bytes.substr(0, std::min<std::size_t>(bytes.size(), 512) & ~std::size_t{1}));
    if (converted && *converted) return sniff_scene_format(**converted);
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return SceneFormat::kJson;
    bytes.remove_prefix(start);
    if (bytes.front() == '{' || bytes.front() == '[') return SceneFormat::kJson;
    if (bytes.front() == '"') return is_one_string(bytes) ? SceneFormat::kJson : SceneFormat::kCsv;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return SceneFormat::kPly;
    if (is_awa(bytes)) return SceneFormat::kAwa;
    const std::string_view line = bytes.substr(0, std::min(bytes.find('\n'), bytes.size()));
    // A layout's first line is numbers, whose only letter is the e of an exponent.
    const bool letters = std::any_of(line.begin(), line.end(), [](char c) {
        const char l = static_cast<char>(c | 0x20);
        return l >= 'a' && l <= 'z' && l != 'e';
    });
    // Comments stand in tables only.
    if (line.starts_with("#") || line.starts_with("//") || line.starts_with("%"))
        return SceneFormat::kCsv;
    return letters || !is_layout(bytes) ? SceneFormat::kCsv : SceneFormat::kAwn;
}

}  // namespace awan
