#include "server/service/scene_request.h"

#include <algorithm>
#include <array>

#include "core/formats/quote.h"
#include "core/formats/texture_file.h"
#include "core/scene/validate.h"
#include "server/document/scene_text.h"
#include "server/document/text_bytes.h"
#include "server/header_text.h"
#include "server/limits.h"
#include "server/service/forms.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

constexpr std::string_view kUrlencoded = "application/x-www-form-urlencoded",
                           kMultipart = "multipart/form-data";

// The query of /v1/accuracy beside the overrides (accuracy.cpp).
constexpr std::array<std::string_view, 5> kAccuracyNames = {"theme", "size", "samples", "runs",
                                                            "rungs"};

// Of a picture that is rendered; a plot has no such thing.
constexpr std::string_view kPng16Word = kImageFormatWords[static_cast<int>(ImageFormat::kPng16)];

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kFormats = {
    {{"json", "application/json"},
     {"csv", "text/csv"},
     {"ply", "application/x-ply"},
     {"awn", "text/x-awn"},
     {"awa", "text/x-awa"},
     {"png", "image/png"},
     {kPng16Word, "image/png"},
     {"exr", "image/x-exr"}}};

bool is_form(std::string_view type) {
    return type == kUrlencoded || type == kMultipart;
}

// A map of the sky has nothing else of a picture.
Status check_of_map(const Request& request, std::string_view what, std::string_view name) {
    if (request.path != kSkyPath || name == "width" || name == "format") return std::nullopt;
    return Error{ErrorCode::kMalformed, "",
                 "there is no " + std::string(what) + " " + short_quote(name) +
                     " of a map; there are width and format"};
}

Status check_names(const Request& request) {
    const bool accuracy = request.path == kAccuracyPath;
    const bool particles = request.path == kParticlesPath, render = request.path == kRenderPath;
    for (const auto& [name, value] : request.query) {
        if (Status wrong = check_of_map(request, "query parameter", name)) return wrong;
        if (is_override(name)) continue;
        if (accuracy &&
            std::find(kAccuracyNames.begin(), kAccuracyNames.end(), name) != kAccuracyNames.end())
            continue;
        if (particles && name == kLightName) continue;
        if (render && name == kPreviewName) continue;
        return Error{ErrorCode::kMalformed, "",
                     "there is no query parameter " + short_quote(name) + "; there are " +
                         std::string(kOverrideNames) + (particles ? ", and here light" : "") +
                         (render ? ", and here preview" : "") +
                         (accuracy ? ", and here theme, size, samples, runs, rungs" : "")};
    }
    return std::nullopt;
}

Response wrong_type(std::string_view detail, const Request& request) {
    Response response = problem(415, detail, "", request.id);
    response.headers.emplace_back("Accept", kSceneTypes);
    return response;
}

bool is_packed(const Request& request) {
    const std::string_view encoding = request.header("Content-Encoding");
    return same(encoding, "gzip") || same(encoding, "x-gzip");
}

// A scene in a body, before it is read.
struct SceneBytes {
    SceneFormat format = SceneFormat::kJson;
    // Nothing: the body as it came.
    std::optional<std::string> bytes;
    // The query, and then what a form adds.
    std::vector<std::pair<std::string, std::string>> fields;
    // Fields of a form that are named by a place in the document.
    std::vector<PlacedValue> placed;
    // Files of a form.
    GivenTextures textures;
};

// The format of a part by what says it best: its type, its file's name, its bytes.
SceneFormat format_of(const FormPart& part) {
    if (const auto format = scene_format_of_type(media_type(part.content_type))) return *format;
    if (const auto format = scene_format_of_name(part.file_name)) return *format;
    return sniff_scene_format(part.value);
}

bool is_scene(const FormPart& part) {
    return part.name == "scene" || part.name == "layout";
}

// Which part is the scene: a page sends its text area and its chosen file, either of which may be left empty, and a
// file takes the place of the text.
Result<FormPart*> scene_part(std::vector<FormPart>& parts) {
    FormPart* text = nullptr;
    FormPart* file = nullptr;
    FormPart* empty = nullptr;
    for (FormPart& part : parts) {
        if (!is_scene(part)) continue;
        FormPart*& kind = part.value.empty() ? empty : part.file_name.empty() ? text : file;
        if (kind != nullptr && kind != empty)
            return Error{ErrorCode::kMalformed, "", "the form has more than one scene"};
        kind = &part;
    }
    for (FormPart* part : {file, text, empty})
        if (part != nullptr) return part;
    return Error{ErrorCode::kMalformed, "", "the form has no field `scene` (or `layout`)"};
}

// A texture is called as its file, without folder and ending.
Status add_texture(const FormPart& part, const Deadline& deadline, GivenTextures& textures) {
    // A page sends its chosen file, and if there is none, an empty one.
    if (part.value.empty() && part.file_name.empty()) return std::nullopt;
    if (textures.size() == limits::kMaxTextures)
        return Error{
            ErrorCode::kTooLarge, "",
            "a form may have at most " + std::to_string(limits::kMaxTextures) + " textures"};
    std::string_view name = part.file_name;
    name.remove_prefix(name.find_last_of("/\\") + 1);
    auto texture = read_texture(std::string(name.substr(0, name.rfind('.'))), part.value, deadline);
    if (!texture) return texture.error();
    textures.push_back(*std::move(texture));
    return std::nullopt;
}

Result<SceneBytes> of_form(const Request& request, std::vector<FormPart> parts, SceneBytes scene) {
    for (FormPart& part : parts) {
        if (is_scene(part)) continue;
        if (part.name == "texture") {
            if (const Status wrong = add_texture(part, request.deadline, scene.textures))
                return *wrong;
            continue;
        }
        const bool placed = part.name.starts_with('/');
        if (!placed)
            if (const Status wrong = check_of_map(request, "field", part.name)) return *wrong;
        if (!placed && !is_override(part.name))
            return Error{ErrorCode::kMalformed, "",
                         "there is no field " + short_quote(part.name) +
                             " in a form; there are scene (or layout), texture, places in the "
                             "document such as /sun/elevation, " +
                             std::string(kOverrideNames)};
        // Fields that are left empty on a page say nothing.
        if (part.value.empty()) continue;
        if (placed)
            scene.placed.push_back({std::move(part.name), std::move(part.value)});
        else
            scene.fields.emplace_back(std::move(part.name), std::move(part.value));
    }
    const auto found = scene_part(parts);
    if (!found) return found.error();
    scene.format = format_of(**found);
    scene.bytes = std::move((*found)->value);
    return scene;
}

Result<SceneBytes> scene_bytes(const Request& request) {
    SceneBytes scene;
    scene.fields = request.query;
    auto unpacked = unpacked_body(request);
    if (!unpacked) return unpacked.error();
    const std::string_view body = *unpacked ? std::string_view(**unpacked) : request.body;
    const std::string type = media_type(request.header("Content-Type"));
    if (type == kUrlencoded) {
        auto parts = read_urlencoded(body);
        if (!parts) return parts.error();
        return of_form(request, *std::move(parts), std::move(scene));
    }
    if (type == kMultipart) {
        auto parts = read_multipart(request.header("Content-Type"), body);
        if (!parts) return parts.error();
        return of_form(request, *std::move(parts), std::move(scene));
    }
    scene.format = *scene_format_of_type(type);
    scene.bytes = *std::move(unpacked);
    return scene;
}

}  // namespace

Result<std::optional<std::string>> unpacked_body(const Request& request) {
    if (!is_packed(request)) return std::optional<std::string>();
    auto out = gunzip(request.body, limits::kMaxBodyBytes);
    if (!out) return out.error();
    return std::optional<std::string>(*std::move(out));
}

Result<bool> query_flag(const Request& request, std::string_view name) {
    bool on = false;
    int times = 0;
    const auto wrong = [&](const std::string& what) {
        return Error{ErrorCode::kMalformed, "",
                     "query parameter `" + std::string(name) + "` " + what};
    };
    for (const auto& [given, value] : request.query) {
        if (given != name) continue;
        if (value != "0" && value != "1") return wrong("must be 0 or 1, not " + short_quote(value));
        on = value == "1";
        ++times;
    }
    if (times > 1) return wrong("stands twice");
    return on;
}

std::optional<Response> check_scene_head(const Request& request) {
    const std::string type = media_type(request.header("Content-Type"));
    if (!scene_format_of_type(type) && !is_form(type)) {
        return wrong_type("a scene comes as " + std::string(kSceneTypes) +
                              ", in UTF-8, or in a form; name it in Content-Type",
                          request);
    }
    if (const Status wrong = check_names(request)) return problem(*wrong, request.id);
    if (const auto overrides = read_overrides(request.query); !overrides)
        return problem(overrides.error(), request.id);
    return std::nullopt;
}

bool may_bring_texture(const Request& request) {
    if (media_type(request.header("Content-Type")) != kMultipart) return false;
    constexpr std::string_view kNotChosen = "; filename=\"\"";
    const std::string_view body = request.body;
    for (const std::string_view field : {"name=\"texture\"", "name=texture"})
        for (std::size_t at = body.find(field); at != std::string_view::npos;
             at = body.find(field, at + 1))
            if (!body.substr(at + field.size()).starts_with(kNotChosen)) return true;
    return false;
}

std::optional<Response> check_scene_body(const Request& request) {
    if (media_type(request.header("Content-Type")) != kUrlencoded) return std::nullopt;
    const std::size_t first = request.body.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || request.body[first] != '{') return std::nullopt;
    return wrong_type(
        "the body is JSON and its Content-Type a form's; send it with Content-Type: "
        "application/json",
        request);
}

Result<SceneRequest> read_scene_request(const Request& request, GivenTextures textures,
                                        const std::shared_ptr<automaton::KeptStates>& kept) {
    auto body = scene_bytes(request);
    if (!body) return body.error();
    auto overrides = read_overrides(body->fields);
    if (!overrides) return overrides.error();
    std::vector<std::string> notes;
    auto draft = read_scene(body->format, body->bytes ? *body->bytes : request.body,
                            {overrides->radius, &notes});
    if (!draft) return draft.error();
    // Its text is not needed any more, and may be long.
    body->bytes.reset();
    if (const Status wrong = set_in_scene(body->placed, *draft)) return *wrong;
    override_scene(*overrides, *draft);
    draft->textures = std::move(body->textures);
    draft->textures.insert(draft->textures.end(), textures.begin(), textures.end());
    automaton::keep_states(*draft, kept);
    auto scene = validate(*std::move(draft));
    if (!scene) return scene.error();
    return SceneRequest{*std::move(scene), *std::move(overrides), std::move(notes)};
}

std::optional<std::string_view> chosen_offer(const Request& request, std::string_view format,
                                             std::span<const std::string_view> offers) {
    if (format.empty()) return best_offer(joined_header(request, "Accept"), offers);
    if (format == kPng16Word && request.path != kRenderPath) return {};
    for (const auto& [name, type] : kFormats)
        if (name == format && std::find(offers.begin(), offers.end(), type) != offers.end())
            return type;
    return {};
}

std::string notes_header(const std::vector<std::string>& notes) {
    std::string all;
    for (const std::string& note : notes) all += (all.empty() ? "" : "; ") + note;
    return all;
}

}  // namespace awan
