#include "server/document/presets.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "core/base/embedded.h"
#include "core/formats/quote.h"
#include "core/scene/limits.h"
#include "server/document/json_place.h"

namespace awan {
namespace {

using nlohmann::json;

std::string_view embedded(std::string_view name) {
    for (const EmbeddedFile& file : preset_files())
        if (file.name == name) return file.text;
    return {};
}

// The string after "key": in an object of index.json, which is ours, flat and without escapes (service_pages_test reads
// every entry); empty where there is none.
std::string_view value_of(std::string_view object, std::string_view key) {
    std::size_t at = object.find(key);
    if (at == std::string_view::npos) return {};
    at = object.find('"', object.find(':', at + key.size()));
    const std::size_t end = at == std::string_view::npos ? at : object.find('"', at + 1);
    return end == std::string_view::npos ? std::string_view{} : object.substr(at + 1, end - at - 1);
}

// "Cumulus congestus" is "cumulus-congestus".
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        plain += c == ' ' || c == '_'
                     ? '-'
                     : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return plain;
}

Error no_preset(const std::vector<PresetEntry>& presets, const json& named) {
    const std::string what =
        named.is_string() ? short_quote(named.get_ref<const std::string&>()) : named.type_name();
    return {ErrorCode::kInvalidScene, "/preset",
            "must be the name of a preset, not " + what + "; there are " + names_of(presets)};
}

// Of members that exclude each other, those that the document names stand alone.
void drop_replaced(const json& document, json& preset) {
    if (document.contains("cubes") || document.contains("clouds")) {
        preset.erase("cubes");
        preset.erase("clouds");
    }
    if (document.contains("accuracy")) preset.erase("accuracy");
    const auto sun = document.find("sun");
    if (sun == document.end() || !sun->is_object() || !preset.contains("sun")) return;
    if (sun->contains("direction")) {
        preset["sun"].erase("elevation");
        preset["sun"].erase("azimuth");
    } else if (sun->contains("elevation") || sun->contains("azimuth")) {
        preset["sun"].erase("direction");
    }
}

}  // namespace

std::vector<PresetEntry> preset_entries() {
    std::vector<PresetEntry> presets;
    std::string_view index = embedded("presets/index.json");
    for (std::size_t end = index.find('}'); end != std::string_view::npos; end = index.find('}')) {
        const std::string_view object = index.substr(0, end);
        index.remove_prefix(end + 1);
        const std::string_view name = value_of(object, "\"name\"");
        const std::string_view text = embedded("presets/" + std::string(name) + ".json");
        if (!text.empty())
            presets.push_back(
                {name, value_of(object, "\"title\""), text, value_of(object, "\"genus\"")});
    }
    return presets;
}

bool is_called(const PresetEntry& preset, std::string_view name) {
    const std::string plain = plain_name(name);
    return plain == preset.name || (!preset.genus.empty() && plain == plain_name(preset.genus));
}

const PresetEntry* find_preset(const std::vector<PresetEntry>& presets, std::string_view name) {
    const auto at = std::find_if(presets.begin(), presets.end(), [&](const PresetEntry& preset) {
        return is_called(preset, name);
    });
    return at == presets.end() ? nullptr : &*at;
}

std::string names_of(const std::vector<PresetEntry>& presets) {
    std::string names;
    for (const PresetEntry& preset : presets) {
        if (!names.empty()) names += ", ";
        names += preset.name;
        if (!preset.genus.empty()) names += " (" + std::string(preset.genus) + ")";
    }
    return names;
}

Result<std::string> with_preset(std::string_view text) {
    if (text.size() > limits::kMaxPresetDocument)
        return Error{ErrorCode::kInvalidScene, "/preset",
                     "a document that begins with a preset has at most " +
                         std::to_string(limits::kMaxPresetDocument) + " bytes"};
    bool too_deep = false;
    const auto keep = [&](int depth, json::parse_event_t, json&) {
        too_deep = too_deep || depth > limits::kMaxJsonDepth;
        return !too_deep;
    };
    json document;
    try {
        document = json::parse(text, keep);
    } catch (const json::parse_error& e) {
        const std::string_view what = e.what();
        const std::size_t reason = what.find(" - ");
        return Error{ErrorCode::kMalformed, "",
                     not_json(text, e.byte,
                              reason == std::string_view::npos ? "" : what.substr(reason + 3))};
    } catch (const json::exception&) {  // a number that overflows
        return Error{ErrorCode::kInvalidScene, "", "numbers must be finite: one overflows"};
    }
    if (too_deep)
        return Error{ErrorCode::kInvalidScene, "",
                     "nested deeper than " + std::to_string(limits::kMaxJsonDepth)};
    const json named = document["preset"];
    document.erase("preset");
    const std::vector<PresetEntry> presets = preset_entries();
    const PresetEntry* const found =
        named.is_string() ? find_preset(presets, named.get_ref<const std::string&>()) : nullptr;
    if (found == nullptr) return no_preset(presets, named);
    json preset = json::parse(found->text);
    drop_replaced(document, preset);
    preset.merge_patch(document);
    return preset.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace awan
