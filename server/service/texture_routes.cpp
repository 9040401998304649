// /v1/textures: what there is to paint clouds with, and textures of clients' own.
#include "core/formats/image_file.h"
#include "core/formats/texture_file.h"
#include "core/generate/own_textures.h"
#include "server/document/json_text.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

void append_texture(std::string_view name, std::string_view hash, bool own, std::string_view says,
                    std::string& out) {
    out += out.back() == '[' ? "{" : ",{";
    json_text::member("name", name, out);
    json_text::member("hash", hash, out);
    json_text::member("own", own, out);
    if (!says.empty()) json_text::member("says", says, out);
    out += '}';
}

Response list_textures(const Service::State& state) {
    Response response;
    response.headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}};
    response.body = R"({"textures":[)";
    for (const OwnTexture& own : kOwnTextures)
        append_texture(own.name, own.hash, true, own.says, response.body);
    for (const auto& kept : state.textures.all())
        append_texture(kept->name, kept->hash, false, "", response.body);
    response.body += "]}\n";
    return response;
}

std::shared_ptr<const Texture> texture_of(const Service::State& state, std::string_view name) {
    if (auto kept = state.textures.find(name)) return kept;
    for (const OwnTexture& own : kOwnTextures)
        if (name == own.name || name == own.hash) return texture_of_hash(SceneDraft{}, own.hash);
    return nullptr;
}

// White, with the texture as its alpha: given back, it is the same texture. One with colours has them, at half the
// light: the tone curve leaves those as they are.
Response show_texture(const Texture& texture, const Request& request) {
    const std::string etag = make_etag({"texture", texture.hash});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, false);
    Image image{kTextureSide, kTextureSide, false, {}};
    const std::vector<float> colors = linear_colors(texture);
    const float light = texture.color.empty() ? 1.0f : 0.5f;
    for (std::size_t i = 0; i < texture.depth.size(); ++i) {
        const float alpha = static_cast<float>(texture.depth[i]) / 255.0f;
        for (std::size_t c = 0; c < 3; ++c)
            image.pixels.push_back(light * colors[3 * i + c] * alpha);
        image.pixels.push_back(alpha);
    }
    auto png = encode_png(image, {0, Tone::kNeutral});
    if (!png) return fail(png.error(), request);
    Response response;
    response.headers = {
        {"Content-Type", "image/png"}, {"ETag", etag}, {"Cache-Control", "no-cache"}};
    response.body = *std::move(png);
    return response;
}

Response keep_texture(Service::State& state, std::string_view name, const Request& request) {
    const LaneWork work{Weight::kShort, kTypical_ms, request.client};
    Lanes::Pass pass(state.lanes);
    if (auto refused =
            not_let_in(pass.enter(work, request.deadline), state.lanes, work.weight, request))
        return std::move(*refused);
    const WorkBudget::Lease lease = state.budget.take(limits::kTextureWorkBytes);
    if (!lease) return no_memory(state, request);
    auto texture = read_texture(std::string(name), request.body, request.deadline);
    if (!texture) return fail(texture.error(), request);
    std::string body = "{";
    json_text::member("name", (*texture)->name, body);
    json_text::member("hash", (*texture)->hash, body);
    body += "}\n";
    bool was_there = false;
    if (const Status failed = state.textures.keep(*std::move(texture), was_there))
        return fail(*failed, request);
    Response response;
    response.status = was_there ? 200 : 201;
    response.headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}};
    if (!was_there)
        response.headers.emplace_back("Location",
                                      std::string(kTexturesPath) + "/" + std::string(name));
    response.body = std::move(body);
    return response;
}

}  // namespace

Response answer_texture_request(Service::State& state, const Request& request) {
    if (request.path == kTexturesPath) return list_textures(state);
    const std::string_view name = std::string_view(request.path).substr(kTexturesPath.size() + 1);
    if (request.method == "PUT") return keep_texture(state, name, request);
    const auto texture = texture_of(state, name);
    if (!texture) return problem(404, "there is no texture of that name", "", request.id);
    if (request.method != "DELETE") return show_texture(*texture, request);
    if (!state.textures.remove(name))
        return problem(403, "this texture is not a client's: it stays", "", request.id);
    Response response;
    response.status = 204;
    return response;
}

}  // namespace awan
