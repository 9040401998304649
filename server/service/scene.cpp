// The POST routes: from a body to an answer. /v1/plan is all here; the others go on in files of their own.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/formats/image_file.h"
#include "core/scene/fingerprint.h"
#include "server/document/json.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/scene_request.h"
#include "server/service/state.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

constexpr std::string_view kJson = "application/json";
constexpr std::string_view kCsv = "text/csv";

constexpr std::array kPlanOffers = {kJson};
constexpr std::array kAccuracyOffers = {kJson, kCsv, std::string_view("image/png")};
constexpr std::array<std::string_view, 2> kRenderOffers = {"image/png", "image/x-exr"};
// Where the document prefers it.
constexpr std::array<std::string_view, 2> kRenderOffersExrFirst = {"image/x-exr", "image/png"};
// Of a picture with layers.
constexpr std::array<std::string_view, 1> kLayerOffers = {"image/x-exr"};

// Documents over this many bytes, or scenes over this many particles, and sequences, whose rung is settled on three of
// their frames, take long before anything is planned.
constexpr std::size_t kLongDocument = 1u << 20;
constexpr std::uint64_t kManyParticles = 200'000;

std::span<const std::string_view> offers_of(const Request& request) {
    const std::string_view path = request.path;
    const std::pair<std::string, std::string> light{"light", "1"};
    const auto& query = request.query;
    // Only PLY holds it.
    if (path == kParticlesPath && std::find(query.begin(), query.end(), light) != query.end())
        return std::span(kParticleOffers).subspan(2, 1);
    if (path == kParticlesPath) return kParticleOffers;
    if (path == kRenderPath) return kRenderOffers;
    if (path == kSkyPath) return kRenderOffersExrFirst;
    if (path == kAccuracyPath) return kAccuracyOffers;
    return kPlanOffers;
}

// --- /v1/plan

Response answer_plan(Service::State& state, const Request& request, const Scene& scene,
                     const Lanes::Pass& pass) {
    const std::string etag =
        make_etag({"plan", fingerprint(scene), engine_version(), speed_text(state)});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    const WorkBudget::Lease lease = state.budget.take(work_bytes(*scene, false));
    if (!lease) return no_memory(state, request);
    auto planned = plan_only(scene, state.options.threads, request.deadline, state.options.speed);
    if (!planned) return fail(planned.error(), request);
    state.metrics.stage_done("generate", planned->times.generate_ms);
    state.metrics.stage_done("survey", planned->times.survey_ms);
    Response response = ok_answer(kJson, etag);
    response.body = plan_to_json(planned->survey, planned->plan);
    response.stages = {{"queue", pass.waited_ms()},
                       {"generate", planned->times.generate_ms},
                       {"survey", planned->times.survey_ms}};
    return response;
}

}  // namespace

Result<Scene> read_request_scene(const Service::State& state, const Request& request) {
    auto read = read_scene_request(request, state.textures.all(), state.kept);
    if (!read) return read.error();
    return std::move(read->scene);
}

Response fail(const Error& error, const Request& request) {
    Response response = problem(error, request.id);
    response.abandoned = error.code == ErrorCode::kCancelled;
    if (response.abandoned) response.reason = "client gone";
    if (error.code == ErrorCode::kOverDeadline) response.reason = "deadline";
    if (error.code == ErrorCode::kOutOfMemory) response.reason = "memory";
    return response;
}

Response no_memory(Service::State& state, const Request& request) {
    Response response =
        problem_retry(429, "other requests use the memory this one needs",
                      seconds_from_ms(state.lanes.wait_ms(Weight::kLong)), request.id);
    response.reason = "memory";
    return response;
}

std::optional<Response> not_let_in(Lanes::Entry entry, const Lanes& lanes, Weight weight,
                                   const Request& request) {
    if (entry == Lanes::Entry::kIn) return std::nullopt;
    if (entry == Lanes::Entry::kOver) return fail(*request.deadline.over(), request);
    const bool full = entry == Lanes::Entry::kFull;
    Response response =
        problem_retry(429,
                      full ? "too many requests wait"
                           : "its turn would come after its deadline, by what runs and waits",
                      seconds_from_ms(lanes.wait_ms(weight)), request.id);
    response.reason = full ? "queue full" : "too late";
    return response;
}

std::optional<Response> not_kept_in(Service::State& state, const Request& request,
                                    double expected_ms, Lanes::Pass& pass) {
    return not_let_in(pass.expect(expected_ms, request.deadline), state.lanes,
                      weight_of(expected_ms), request);
}

int threads_of_one(const Service::State& state) {
    const auto running = static_cast<int>(std::max<std::size_t>(state.lanes.load().running, 1));
    return (state.options.threads + running - 1) / running;
}

Response ok_answer(std::string_view content_type, std::string_view etag) {
    Response response;
    response.headers = {{"Content-Type", std::string(content_type)},
                        {"ETag", std::string(etag)},
                        {"Cache-Control", "no-cache"},
                        {"Vary", "Accept"}};
    return response;
}

std::string speed_text(const Service::State& state) {
    return std::to_string(state.options.speed.slowness);
}

namespace {

// A packed body may become so many times as long (zlib's technical details: 1032).
constexpr std::size_t kMostPacked = 1032;

std::size_t unpacked_bytes(const Request& request) {
    const std::size_t size = request.body.size();
    if (request.header("Content-Encoding").empty()) return size;
    return std::min(kMostPacked * size, limits::kMaxBodyBytes);
}

Response not_offered(const Request& request, int status, std::string_view what) {
    std::string detail(what);
    const auto offers = offers_of(request);
    for (const std::string_view offer : offers)
        detail.append(offer == offers.front() ? " " : ", ").append(offer);
    return problem(status, detail, "", request.id);
}

bool has_layers(std::string_view path, const Scene& scene) {
    return path == kRenderPath && wants_layers(scene);
}

// What there is of a scene, in the order that its document prefers.
std::span<const std::string_view> offers_of(const Request& request, const Scene& scene) {
    if (has_layers(request.path, scene)) return kLayerOffers;
    if (request.path == kRenderPath && scene->image.format == ImageFormat::kExr)
        return kRenderOffersExrFirst;
    return offers_of(request);
}

Response answer_as(Service::State& state, const Request& request, const Scene& scene,
                   const Overrides& overrides, std::string_view type, Lanes::Pass& pass) {
    if (request.path == kRenderPath) return answer_render(state, request, scene, type, pass);
    if (request.path == "/v1/plan") return answer_plan(state, request, scene, pass);
    if (request.path == kSkyPath)
        return answer_sky(state, request, scene, overrides.width, type, pass);
    if (request.path == kAccuracyPath) {
        // A sweep takes long, and there is one at most: others compute beside it.
        pass.leave();
        return answer_accuracy(state, request, scene, type);
    }
    return answer_particles(state, request, scene, type, pass);
}

}  // namespace

std::optional<Response> check_scene_request(const Request& request) {
    if (auto refused = check_scene_head(request)) return refused;
    if (request.path == kAccuracyPath)
        if (const Status wrong = check_accuracy_query(request)) return fail(*wrong, request);
    for (const std::string_view name : {kLightName, kPreviewName})
        if (const auto flag = query_flag(request, name); !flag) return fail(flag.error(), request);
    const auto offers = offers_of(request);
    for (const auto& [name, value] : request.query)
        if (name == "format") {
            if (chosen_offer(request, value, offers)) return std::nullopt;
            return not_offered(request, 400,
                               "query parameter `format` names none of what can be answered here:");
        }
    if (best_offer(joined_header(request, "Accept"), offers)) return std::nullopt;
    return not_offered(request, 406, "this can be answered as");
}

Response answer_scene_request(Service::State& state, const Request& request) {
    const bool large = request.body.size() > kLongDocument;
    const LaneWork work{large ? Weight::kLong : Weight::kShort, kTypical_ms, request.client};
    Lanes::Pass pass(state.lanes);
    if (auto refused =
            not_let_in(pass.enter(work, request.deadline), state.lanes, work.weight, request))
        return std::move(*refused);
    WorkBudget::Lease reading =
        state.budget.take(reading_bytes(unpacked_bytes(request)) +
                          (may_bring_texture(request) ? limits::kTextureWorkBytes : 0));
    if (!reading) return no_memory(state, request);
    if (auto refused = check_scene_body(request)) return *std::move(refused);
    const auto read = read_scene_request(request, state.textures.all(), state.kept);
    reading = {};
    if (!read) return fail(read.error(), request);
    const Scene& scene = read->scene;
    // Reading a long document may take seconds.
    if (const Status over = request.deadline.over()) return fail(*over, request);
    if (scene->sequence || particle_count(*scene) > kManyParticles)
        if (auto refused = not_kept_in(state, request, 2 * kShort_ms, pass))
            return std::move(*refused);

    const std::string format = read->overrides.format.value_or("");
    const auto type = chosen_offer(request, format, offers_of(request, scene));
    if (!type && has_layers(request.path, scene))
        return problem(format.empty() ? 406 : 400,
                       "only an EXR holds layers (" + scene->image.layers +
                           "): ask for image/x-exr, or with layers=none for a picture without them",
                       "/image/layers", request.id);
    if (!type)
        return not_offered(request, 400,
                           "the field `format` names none of what can be answered here:");
    Response response = answer_as(state, request, scene, read->overrides, *type, pass);
    const std::string notes = notes_header(read->notes);
    if (!notes.empty()) response.headers.emplace_back("Awan-Notes", notes);
    return response;
}

}  // namespace awan
