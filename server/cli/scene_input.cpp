#include "server/cli/scene_input.h"

#include <cstdio>
#include <optional>

#include "core/formats/texture_file.h"
#include "core/generate/automaton/kept_states.h"
#include "core/scene/validate.h"
#include "server/cli/files.h"
#include "server/document/overrides.h"
#include "server/document/scene_text.h"
#include "server/document/text_bytes.h"

namespace awan {
namespace {

// A gzip file may hold this much: more than any scene is allowed to be.
constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

// Of the states that a run keeps of its automata: 400 of the source's size.
constexpr std::size_t kKeptStatesBytes = std::size_t{256} << 20;

Result<SceneDraft> read_file(const SceneInput& input, std::vector<std::string>& notes) {
    auto bytes = read_input(input.path);
    if (!bytes) return bytes.error();
    if (is_gzip(*bytes)) {
        auto unpacked = gunzip(*bytes, kMostUnpacked);
        if (!unpacked) return unpacked.error();
        *bytes = *std::move(unpacked);
    }
    const auto format = scene_format_of_name(input.path);
    return read_scene(format ? *format : sniff_scene_format(*bytes), *bytes,
                      {input.radius, &notes});
}

// The file of /place=@file, whose content is the value.
std::optional<std::string> file_of_set(const std::string& set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals + 1 == set.size() || set[equals + 1] != '@')
        return std::nullopt;
    return set.substr(equals + 2);
}

Status apply_set(const std::string& set, SceneDraft& draft) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos)
        return Error{ErrorCode::kInvalidScene, "",
                     "--set " + set + ": must be a place and a value, /sun/elevation=12"};
    const std::string_view place = std::string_view(set).substr(0, equals);
    if (const auto file = file_of_set(set)) {
        const auto bytes = read_input(*file);
        if (!bytes) return bytes.error();
        return set_in_scene(place, *bytes, draft);
    }
    return set_in_scene(place, std::string_view(set).substr(equals + 1), draft);
}

Error bad_texture(const std::string& given, const std::string& what) {
    return {ErrorCode::kInvalidScene, "", "--texture " + given + ": " + what};
}

Status add_texture(const std::string& given, SceneDraft& draft) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos)
        return bad_texture(given, "must be a name and a file, puff=my-puff.png");
    if (draft.textures.size() == limits::kMaxTextures)
        return bad_texture(given, "is one too many; at most " +
                                      std::to_string(limits::kMaxTextures) + " are allowed");
    auto bytes = read_input(given.substr(equals + 1));
    if (!bytes) return bytes.error();
    auto texture = read_texture(given.substr(0, equals), *bytes);
    if (!texture) return texture.error();
    draft.textures.push_back(*std::move(texture));
    return std::nullopt;
}

}  // namespace

Result<SceneDraft> read_scene_input(const SceneInput& input) {
    std::vector<std::string> notes;
    auto draft = read_file(input, notes);
    if (!draft) return draft.error();
    for (const std::string& note : notes)
        std::fprintf(stderr, "awan: %s: %s\n", input.path.c_str(), note.c_str());
    for (const std::string& set : input.sets)
        if (const Status wrong = apply_set(set, *draft)) return *wrong;
    for (const std::string& given : input.textures)
        if (const Status wrong = add_texture(given, *draft)) return *wrong;
    if (input.seed) draft->seed = *input.seed;
    if (const Status wrong = begin_with_states(input.states, *draft)) return *wrong;
    automaton::keep_states(*draft, std::make_shared<automaton::KeptStates>(kKeptStatesBytes));
    return draft;
}

Result<Scene> read_valid_scene(const SceneInput& input) {
    auto draft = read_scene_input(input);
    if (!draft) return draft.error();
    return validate(*std::move(draft));
}

std::vector<std::string> files_of(const SceneInput& input) {
    std::vector<std::string> files;
    if (!input.path.empty() && input.path != "-") files.push_back(input.path);
    for (const std::string& path : input.states)
        if (path != "-") files.push_back(path);
    for (const std::string& given : input.textures)
        files.push_back(given.substr(given.find('=') + 1));
    for (const std::string& set : input.sets)
        if (auto file = file_of_set(set)) files.push_back(*std::move(file));
    return files;
}

Status write_dependencies(const std::string& depfile, const std::vector<std::string>& outputs,
                          const SceneInput& input) {
    if (depfile.empty()) return std::nullopt;
    return write_depfile(depfile, outputs, files_of(input));
}

}  // namespace awan
