// A POST that carries a scene: as a body of one of the scene's types, or in a form; packed or not; with a query that
// takes the place of what the document says.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/generate/automaton/kept_states.h"
#include "core/scene/scene.h"
#include "server/document/overrides.h"
#include "server/service/service.h"

namespace awan {

// The body as it was before it was packed (Content-Encoding: gzip), of limits::kMaxBodyBytes at most; nothing for one
// that came as it is.
Result<std::optional<std::string>> unpacked_body(const Request& request);

// What of a request can be looked at before its body: Content-Type (415), Content-Encoding (415), the names and values
// of its query (400).
std::optional<Response> check_scene_head(const Request& request);

// What a query may switch on: of /v1/particles (particles.cpp) and /v1/render (render.cpp).
inline constexpr std::string_view kLightName = "light", kPreviewName = "preview";

// Whether the query says `name`=1; an error where it says neither 0 nor 1, or says it twice.
Result<bool> query_flag(const Request& request, std::string_view name);

// 415 for JSON that is called a form, as `curl -d @scene.json` does.
std::optional<Response> check_scene_body(const Request& request);

// Whether a form seems to hold a texture, which takes limits::kTextureWorkBytes to read.
bool may_bring_texture(const Request& request);

struct SceneRequest {
    Scene scene;
    // From the query and the fields of a form.
    Overrides overrides;
    // What was taken for what in a file of particles, for Awan-Notes.
    std::vector<std::string> notes;
};
// textures: that may be named, beside those that are in the form and Awan's own. kept: where its automata keep their
// states.
Result<SceneRequest> read_scene_request(const Request& request, GivenTextures textures,
                                        const std::shared_ptr<automaton::KeptStates>& kept);

// The offer that is answered: what `format` says ("" nothing), else what Accept prefers; nothing when neither fits.
std::optional<std::string_view> chosen_offer(const Request& request, std::string_view format,
                                             std::span<const std::string_view> offers);

// Notes as one header's value; "" for none.
std::string notes_header(const std::vector<std::string>& notes);

}  // namespace awan
