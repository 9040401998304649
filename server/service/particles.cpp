// POST /v1/particles: from a scene to its particles, with the light of each where it is asked for.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formats/awa.h"
#include "core/formats/awn.h"
#include "core/formats/image_file.h"
#include "core/formats/particle_files.h"
#include "core/formats/quote.h"
#include "core/generate/generate.h"
#include "core/lit_particles.h"
#include "core/scene/fingerprint.h"
#include "server/document/json.h"
#include "server/service/negotiation.h"
#include "server/service/scene_request.h"
#include "server/service/state.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

constexpr std::string_view kAsJson = kParticleOffers[0], kAsCsv = kParticleOffers[1],
                           kAsPly = kParticleOffers[2], kAsAwn = kParticleOffers[3],
                           kAsAwa = kParticleOffers[4];

// A particle answer in pieces: the memory of its text is one piece, however long it is.
struct ParticleText {
    std::string_view type;
    ParticleSet particles;
    // Of each particle; EMPTY: it was not asked for.
    std::vector<glm::vec3> light;
    std::uint64_t seed = 1;
    // Held until the last piece is written.
    WorkBudget::Lease lease;
    std::size_t next = 0;

    void append_head(std::string& out) const {
        if (type == kAsJson) out += particles_json_head(particles, seed);
        if (type == kAsCsv) append_csv_header(out);
        if (type == kAsPly) append_ply_header(particles, out, light);
    }
    // False when that was the last piece.
    bool append_piece(std::string& out) {
        if (next == 0) append_head(out);
        const std::size_t last = std::min(next + limits::kParticlesPerPiece, particles.size());
        if (type == kAsJson) append_particles_json(particles, next, last, out);
        if (type == kAsCsv) append_csv(particles, next, last, out);
        if (type == kAsPly) append_ply(particles, next, last, out, light);
        next = last;
        if (next < particles.size()) return true;
        if (type == kAsJson) out += particles_json_tail();
        return false;
    }
};

// The light of the particles, within the request's deadline and lane, as a plan and a coarse render are. Grids are kept
// beside those of sequences: the eye may move around the cloud.
Result<std::vector<glm::vec3>> light_of_text(Service::State& state, const Request& request,
                                             const Scene& scene, ParticleText& text,
                                             Lanes::Pass& pass, std::optional<Response>& refused) {
    const Error none{ErrorCode::kCancelled, "", "it got no lane"};
    const auto coarse = scene_of_light(scene);
    if (!coarse) return coarse.error();
    const int threads = threads_of_one(state);
    auto planned =
        plan_generated(*coarse, text.particles, threads, request.deadline, state.options.speed, {});
    if (!planned) return planned.error();
    const double expected_ms = planned->plan.predicted.time_ms;
    refused = not_kept_in(state, request, expected_ms, pass);
    if (refused) return none;
    if (!text.lease.grow(static_cast<std::size_t>(std::max(planned->plan.predicted.bytes, 0.0)))) {
        refused = no_memory(state, request);
        return none;
    }
    return light_particles(*coarse, *std::move(planned), text.particles,
                           {&state.settling_lights, threads}, request.deadline);
}

}  // namespace

Response answer_particles(Service::State& state, const Request& request, const Scene& scene,
                          std::string_view type, Lanes::Pass& pass) {
    const auto wanted = query_flag(request, kLightName);
    if (!wanted) return fail(wanted.error(), request);
    const bool light = *wanted;
    if (light && type != kAsPly)
        return fail({ErrorCode::kMalformed, "",
                     "only application/x-ply holds the light of particles (`light`)"},
                    request);
    const std::string etag =
        make_etag({"particles", fingerprint(scene), engine_version(), type, light ? "light" : ""});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    Response response = ok_answer(type, etag);
    if (type == kAsAwn || type == kAsAwa) {
        auto layout = type == kAsAwn ? write_awn(*scene) : write_awa(*scene);
        if (!layout) return fail(layout.error(), request);
        response.body = std::move(layout).value();
        return response;
    }
    auto text = std::make_shared<ParticleText>();
    text->lease = state.budget.take(work_bytes(*scene, false));
    if (!text->lease) return no_memory(state, request);

    const auto start = Clock::now();
    auto particles = generate(scene, threads_of_one(state), request.deadline);
    if (!particles) return fail(particles.error(), request);
    const double generate_ms = ms_since(start);
    state.metrics.stage_done("generate", generate_ms);

    text->type = type;
    text->particles = std::move(particles).value();
    text->seed = scene->seed;
    response.headers.emplace_back("Awan-Particles", std::to_string(text->particles.size()));
    response.stages = {{"queue", pass.waited_ms()}, {"generate", generate_ms}};
    if (light && text->particles.size() > 0) {
        const auto lighting = Clock::now();
        std::optional<Response> refused;
        auto known = light_of_text(state, request, scene, *text, pass, refused);
        if (refused) return *std::move(refused);
        if (!known) return fail(known.error(), request);
        text->light = *std::move(known);
        const double light_ms = ms_since(lighting);
        state.metrics.stage_done("light", light_ms);
        response.stages.emplace_back("light", light_ms);
        response.headers.emplace_back("Awan-Exposure", std::to_string(exposure_of(scene)));
    }
    pass.leave();
    if (text->particles.size() <= limits::kParticlesPerPiece) {
        text->append_piece(response.body);
    } else {
        response.stream = [text](std::string& piece) { return text->append_piece(piece); };
    }
    return response;
}

}  // namespace awan
