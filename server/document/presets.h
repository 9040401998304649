// The scenes that ship with the program (web/presets), and documents that begin with one: {"preset": "...", ...}.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

struct PresetEntry {
    std::string_view name, title;
    std::string_view text;  // the document
    std::string_view
        genus{};  // what meteorologists call such a cloud, "cumulus congestus"; of some
};

// In the order of web/presets/index.json.
std::vector<PresetEntry> preset_entries();

// Whether that is its name or its genus, of any case, with blanks or '_' for '-'.
bool is_called(const PresetEntry& preset, std::string_view name);

// The one that is called so; null where there is none.
const PresetEntry* find_preset(const std::vector<PresetEntry>& presets, std::string_view name);

// "congestus (cumulus congestus), ...": all that there are, for messages.
std::string names_of(const std::vector<PresetEntry>& presets);

// The document that a document with the member `preset` stands for: that preset with the other members merged into it
// (RFC 7396: objects are merged, whatever else stands in the preset's place, null takes a member away). `cubes` and
// `clouds` replace either; `accuracy` is replaced as a whole, as is where the sun stands. Errors: kMalformed;
// kInvalidScene at /preset when there is none of that name, or a document over limits::kMaxPresetDocument.
Result<std::string> with_preset(std::string_view document);

}  // namespace awan
