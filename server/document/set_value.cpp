// set_in_scene(): the scene is written as a document, changed there, and read again, so that every rule of documents
// holds for what comes out.
#include <nlohmann/json.hpp>

#include "core/formats/numbers.h"
#include "core/formats/quote.h"
#include "server/document/json.h"
#include "server/document/overrides.h"
#include "server/document/particle_table.h"

namespace awan {
namespace {

using Json = nlohmann::json;

Error at_pointer(std::string_view pointer, std::string message) {
    return {ErrorCode::kInvalidScene, std::string(pointer), std::move(message)};
}

// Takes the next name off a pointer that begins with '/'.
std::string take_name(std::string_view& pointer) {
    pointer.remove_prefix(1);
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    std::string name;
    for (std::size_t i = 0; i < end; ++i) {
        const bool escaped =
            pointer[i] == '~' && i + 1 < end && (pointer[i + 1] == '0' || pointer[i + 1] == '1');
        name += escaped ? (pointer[i + 1] == '0' ? '~' : '/') : pointer[i];
        if (escaped) ++i;
    }
    pointer.remove_prefix(end);
    return name;
}

// The element of a list that a name means: its number, or "-" for one behind the last.
Result<Json*> element_of(Json& list, const std::string& name, std::string_view pointer) {
    if (name == "-") return &list.emplace_back();
    const auto index = read_number<std::uint64_t>(name);
    if (index && *index < list.size()) return &list[static_cast<std::size_t>(*index)];
    return at_pointer(pointer, "there is no element " + short_quote(name) + " in a list of " +
                                   std::to_string(list.size()) + "; - is one more");
}

// A value as people write it: JSON, a list without its brackets, or else a word.
Json value_of(std::string_view text) {
    Json value = Json::parse(text, nullptr, false);
    if (!value.is_discarded()) return value;
    if (text.find(',') != std::string_view::npos) {
        Json list = Json::parse("[" + std::string(text) + "]", nullptr, false);
        if (!list.is_discarded()) return list;
    }
    return Json(std::string(text));
}

// Particles that were moved elsewhere may come as a table; a list of JSON is one already.
bool is_particle_table(std::string_view pointer, std::string_view value) {
    const std::size_t begin = value.find_first_not_of(" \t\r\n");
    return pointer.ends_with("/implicit/particles") && begin != std::string_view::npos &&
           value[begin] != '[' && value.find('\n') != std::string_view::npos;
}

Status put(Json& document, std::string_view pointer, std::string_view value) {
    Json* at = &document;
    for (std::string_view rest = pointer; !rest.empty();) {
        const std::string name = take_name(rest);
        if (at->is_array()) {
            const auto element = element_of(*at, name, pointer);
            if (!element) return element.error();
            at = *element;
        } else if (at->is_object() || at->is_null()) {
            at = &(*at)[name];
        } else {
            return at_pointer(pointer, "what stands before " + short_quote(name) +
                                           " is neither an object nor a list");
        }
    }
    if (is_particle_table(pointer, value)) {
        const auto rows = particle_table_to_json(value, std::string(pointer));
        if (!rows) return rows.error();
        *at = Json::parse(*rows);
        return std::nullopt;
    }
    *at = value_of(value);
    return std::nullopt;
}

// A scene with more ready particles than this is not made a tree of JSON.
constexpr std::size_t kMostInTree = 100'000;

// Moves the particles of large clouds out of the scene, and leaves one of each: they come back by put_back().
std::vector<ReadyParticles> take_particles(SceneDraft& draft) {
    std::vector<ReadyParticles> taken(draft.clouds.size());
    for (std::size_t k = 0; k < taken.size(); ++k) {
        ReadyParticles& ready = draft.clouds[k].ready;
        if (ready.positions.size() <= kMostInTree) continue;
        taken[k] = std::exchange(ready, {});
        ready.positions = {taken[k].positions.front()};
        ready.radii = {1.0f};
    }
    return taken;
}

void put_back(std::vector<ReadyParticles> taken, SceneDraft& draft) {
    for (std::size_t k = 0; k < std::min(taken.size(), draft.clouds.size()); ++k)
        if (!taken[k].positions.empty()) draft.clouds[k].ready = std::move(taken[k]);
}

}  // namespace

Status set_in_scene(std::span<const PlacedValue> values, SceneDraft& draft) {
    if (values.empty()) return std::nullopt;
    for (const PlacedValue& placed : values)
        if (!placed.pointer.starts_with('/'))
            return at_pointer("", "a place in a scene is written as /sun/elevation, not " +
                                      short_quote(placed.pointer));
    try {
        std::vector<ReadyParticles> taken = take_particles(draft);
        const std::string text = scene_to_json(draft);
        Json document = Json::parse(text);
        for (const PlacedValue& placed : values)
            if (Status wrong = put(document, placed.pointer, placed.value)) return wrong;
        auto changed = parse_scene(document.dump());
        if (!changed) return changed.error();
        draft = *std::move(changed);
        put_back(std::move(taken), draft);
    } catch (const Json::exception& e) {
        return Error{ErrorCode::kInvalidScene, values.front().pointer,
                     "cannot be set: the value is not UTF-8"};
    }
    return std::nullopt;
}

Status set_in_scene(std::string_view pointer, std::string_view value, SceneDraft& draft) {
    const PlacedValue one{std::string(pointer), std::string(value)};
    return set_in_scene(std::span(&one, 1), draft);
}

}  // namespace awan
