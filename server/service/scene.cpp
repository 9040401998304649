// POST /v1/particles, /v1/render, /v1/plan: from a body to an answer. /v1/accuracy begins here and
// goes on in accuracy.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "core/formats/awn.h"
#include "core/formats/image_file.h"
#include "core/formats/particle_files.h"
#include "core/generate/generate.h"
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
constexpr std::string_view kPly = "application/x-ply";
constexpr std::string_view kAwn = "text/x-awn";
constexpr std::string_view kPng = "image/png";
constexpr std::string_view kExr = "image/x-exr";
constexpr std::array kParticleOffers = {kJson, kCsv, kPly, kAwn};
constexpr std::array kPlanOffers = {kJson};
constexpr std::array kAccuracyOffers = {kJson, kCsv, kPng};
constexpr std::array kImageOffers = {kPng, kExr};
constexpr std::array kImageOffersExrFirst = {kExr, kPng};

std::span<const std::string_view> offers_of(std::string_view path) {
    if (path == "/v1/particles") return kParticleOffers;
    if (path == "/v1/render") return kImageOffers;
    if (path == kAccuracyPath) return kAccuracyOffers;
    return kPlanOffers;
}

Response ok(std::string_view content_type, std::string_view etag) {
    Response response;
    response.headers = {{"Content-Type", std::string(content_type)},
                        {"ETag", std::string(etag)},
                        {"Cache-Control", "no-cache"},
                        {"Vary", "Accept"}};
    return response;
}

// Predicted times are of this machine, and so is every rung that is chosen by them.
std::string speed_text(const Service::State& state) {
    return std::to_string(state.options.speed.slowness);
}

// --- /v1/particles

// A particle answer in pieces: the memory of its text is one piece, however long it is.
struct ParticleText {
    std::string_view type;
    ParticleSet particles;
    std::uint64_t seed = 1;
    // Held until the last piece is written.
    WorkBudget::Lease lease;
    std::size_t next = 0;

    void append_head(std::string& out) const {
        if (type == kJson) out += particles_json_head(particles, seed);
        if (type == kCsv) append_csv_header(out);
        if (type == kPly) append_ply_header(particles, out);
    }
    // False when that was the last piece.
    bool append_piece(std::string& out) {
        if (next == 0) append_head(out);
        const std::size_t last = std::min(next + limits::kParticlesPerPiece, particles.size());
        if (type == kJson) append_particles_json(particles, next, last, out);
        if (type == kCsv) append_csv(particles, next, last, out);
        if (type == kPly) append_ply(particles, next, last, out);
        next = last;
        if (next < particles.size()) return true;
        if (type == kJson) out += particles_json_tail();
        return false;
    }
};

Response answer_particles(Service::State& state, const Request& request, const Scene& scene,
                          std::string_view type, WorkGate::Pass& pass) {
    const std::string etag = make_etag({"particles", fingerprint(scene), engine_version(), type});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    Response response = ok(type, etag);
    if (type == kAwn) {
        auto layout = write_awn(*scene);
        if (!layout) return fail(layout.error(), request);
        response.body = std::move(layout).value();
        return response;
    }
    auto text = std::make_shared<ParticleText>();
    text->lease = state.budget.take(work_bytes(*scene, false));
    if (!text->lease) return busy(state, request, "other requests use the memory this one needs");

    const auto start = Clock::now();
    auto particles = generate(scene, state.options.threads, request.deadline);
    if (!particles) return fail(particles.error(), request);
    state.metrics.stage_done("generate", ms_since(start));
    pass.leave();

    text->type = type;
    text->particles = std::move(particles).value();
    text->seed = scene->seed;
    response.headers.emplace_back("Awan-Particles", std::to_string(text->particles.size()));
    if (text->particles.size() <= limits::kParticlesPerPiece) {
        text->append_piece(response.body);
    } else {
        response.stream = [text](std::string& piece) { return text->append_piece(piece); };
    }
    return response;
}

// --- /v1/plan

Response answer_plan(Service::State& state, const Request& request, const Scene& scene) {
    const std::string etag =
        make_etag({"plan", fingerprint(scene), engine_version(), speed_text(state)});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    const WorkBudget::Lease lease = state.budget.take(work_bytes(*scene, false));
    if (!lease) return busy(state, request, "other requests use the memory this one needs");
    auto planned = plan_only(scene, state.options.threads, request.deadline, state.options.speed);
    if (!planned) return fail(planned.error(), request);
    state.metrics.stage_done("generate", planned->times.generate_ms);
    state.metrics.stage_done("survey", planned->times.survey_ms);
    Response response = ok(kJson, etag);
    response.body = plan_to_json(planned->survey, planned->plan);
    return response;
}

// --- /v1/render

struct Timing {
    double queue_ms = 0;
    StageTimes stages;
    double encode_ms = 0;
};

// The stages, in order, then those effects whose share of them can be told apart.
std::string report(Metrics& metrics, const Timing& timing) {
    std::vector<std::pair<const char*, double>> entries = {
        {"queue", timing.queue_ms},          {"generate", timing.stages.generate_ms},
        {"survey", timing.stages.survey_ms}, {"light", timing.stages.light_ms},
        {"draw", timing.stages.draw_ms},     {"measure", timing.stages.measure_ms},
        {"encode", timing.encode_ms}};
    for (const auto& [name, ms] : entries) metrics.stage_done(name, ms);
    for (int i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        const double ms = timing.stages.effects.of(effect);
        if (ms > 0) entries.emplace_back(effect_name(effect), ms);
    }
    return server_timing(entries);
}

std::string effects_on(const Plan& plan) {
    std::string names;
    for (const EffectDecision& decision : plan.effects)
        if (decision.on)
            names += (names.empty() ? "" : ", ") + std::string(effect_name(decision.effect));
    return names;
}

Result<std::string> encode(const Rendered& rendered, const Scene& scene, std::string_view type) {
    if (type == kExr) return encode_exr(rendered.image, scene->image.precision, notes_of(rendered));
    return encode_png(rendered.image, scene->image.exposure.value_or(auto_exposure(scene)));
}

// A number as text for a header.
std::string number_text(const char* format, double value) {
    std::array<char, 64> text{};
    const int length = std::snprintf(text.data(), text.size(), format, value);
    return {text.data(), static_cast<std::size_t>(std::min<int>(length, text.size() - 1))};
}

std::string seconds_text(double ms) {
    return number_text("%.2g s", ms / 1000);
}

// A prediction may be this many times too long. What would be too slow even then is refused before it costs anything.
constexpr double kHopeless = 3;

// Why a plan cannot be carried out before the deadline, and what could be; nothing when it may.
std::optional<std::string> hopeless(const Plan& plan, const Deadline& deadline) {
    if (deadline.until == Clock::time_point::max() || plan.predicted.rung == nullptr)
        return std::nullopt;
    const double left_ms =
        std::chrono::duration<double, std::milli>(deadline.until - Clock::now()).count();
    if (!(plan.predicted.time_ms > kHopeless * std::max(left_ms, 0.0))) return std::nullopt;
    const RungForecast* best = nullptr;
    for (const RungForecast& forecast : plan.forecasts)
        if (forecast.time_ms < 0.7 * left_ms && (best == nullptr || forecast.error < best->error))
            best = &forecast;
    std::string detail = "rung " + plan.rung + " would take about " +
                         seconds_text(plan.predicted.time_ms) + " and " + seconds_text(left_ms) +
                         " are left; ask for a smaller picture";
    if (best != nullptr)
        detail += number_text(", or for \"accuracy\": {\"time_ms\": %.0f}", 0.7 * left_ms) +
                  ", which would be rung " + best->rung->name;
    return detail;
}

void add_errors(const Rendered& rendered, Response& response) {
    const RungForecast& predicted = rendered.plan.predicted;
    if (std::isfinite(rendered.stated_error))
        response.headers.emplace_back("Awan-Error", number_text("%.3g", rendered.stated_error));
    if (predicted.rung == nullptr) return;
    if (std::isfinite(predicted.error))
        response.headers.emplace_back("Awan-Error-Forecast", number_text("%.3g", predicted.error));
    if (std::isfinite(predicted.time_ms))
        response.headers.emplace_back("Awan-Time", number_text("%.1f", predicted.time_ms));
}

Response answer_render(Service::State& state, const Request& request, const Scene& scene,
                       std::string_view type, double waited_ms, WorkGate::Pass& pass) {
    if (const Status over = state.renderer.wait_until_started(request.deadline))
        return fail(*over, request);
    const RenderThread::Info info = state.renderer.info();
    if (info.state == RenderThread::Info::State::kNoRenderer)
        return problem(503, "there is no renderer here: " + info.reason, "", request.id);
    const std::string etag =
        make_etag({"render", fingerprint(scene), engine_version(), info.device.renderer,
                   info.device.version, type, scene->accuracy.rung ? "" : speed_text(state)});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);

    const RenderThread::Place place = state.renderer.take_place();
    if (!place) return busy(state, request, "the render queue is full");
    const WorkBudget::Lease lease = state.budget.take(work_bytes(*scene, true));
    if (!lease) return busy(state, request, "other requests use the memory this one needs");

    Timing timing;
    auto planned = plan_scene(scene, state.options.threads, request.deadline, state.options.speed,
                              &state.tiles, &state.settling_lights);
    if (!planned) return fail(planned.error(), request);
    if (const auto reason = hopeless(planned->plan, request.deadline))
        return problem(504, *reason, "", request.id);
    // The passes run on the render thread; others may compute meanwhile.
    pass.leave();
    RenderJobResult job =
        state.renderer.render(place, scene, std::move(planned).value(), request.deadline);
    timing.queue_ms = waited_ms + job.queue_ms;
    if (!job.rendered) return fail(job.rendered.error(), request);

    const auto encode_queued = Clock::now();
    if (const Status over = pass.enter(request.deadline)) return fail(*over, request);
    timing.queue_ms += ms_since(encode_queued);
    const auto start = Clock::now();
    auto bytes = encode(*job.rendered, scene, type);
    timing.encode_ms = ms_since(start);
    if (!bytes) return fail(bytes.error(), request);
    timing.stages = job.rendered->times;

    Response response = ok(type, etag);
    response.headers.emplace_back("Server-Timing", report(state.metrics, timing));
    response.headers.emplace_back("Awan-Effects", effects_on(job.rendered->plan));
    response.headers.emplace_back("Awan-Rung", job.rendered->plan.rung);
    add_errors(*job.rendered, response);
    response.headers.emplace_back("Awan-Particles", std::to_string(job.rendered->survey.particles));
    response.body = std::move(bytes).value();
    return response;
}

}  // namespace

Response fail(const Error& error, const Request& request) {
    Response response = problem(error, request.id);
    response.abandoned = error.code == ErrorCode::kCancelled;
    return response;
}

Response busy(Service::State& state, const Request& request, std::string_view detail) {
    return problem_retry(429, detail, state.renderer.retry_after_seconds(), request.id);
}

std::string server_timing(std::span<const std::pair<const char*, double>> milliseconds) {
    std::string header;
    for (const auto& [name, ms] : milliseconds) {
        header += header.empty() ? "" : ", ";
        header += name + number_text(";dur=%.3f", ms);
    }
    return header;
}

namespace {

Response not_offered(const Request& request, int status, std::string_view what) {
    std::string detail(what);
    const auto offers = offers_of(request.path);
    for (const std::string_view offer : offers)
        detail.append(offer == offers.front() ? " " : ", ").append(offer);
    return problem(status, detail, "", request.id);
}

Response answer_as(Service::State& state, const Request& request, const Scene& scene,
                   std::string_view type, double waited_ms, WorkGate::Pass& pass) {
    if (request.path == "/v1/render")
        return answer_render(state, request, scene, type, waited_ms, pass);
    if (request.path == "/v1/plan") return answer_plan(state, request, scene);
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
    const auto offers = offers_of(request.path);
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
    const auto start = Clock::now();
    WorkGate::Pass pass(state.gate);
    if (const Status over = pass.enter(request.deadline)) return fail(*over, request);
    const double waited_ms = ms_since(start);
    if (auto refused = check_scene_body(request)) return *std::move(refused);
    const auto read = read_scene_request(request);
    if (!read) return fail(read.error(), request);

    // What the client asks for; where it has no preference, what the document says.
    const bool exr = request.path == "/v1/render" && read->scene->image.format == ImageFormat::kExr;
    const auto type = chosen_offer(
        request, read->overrides.format.value_or(""),
        exr ? std::span<const std::string_view>(kImageOffersExrFirst) : offers_of(request.path));
    if (!type)
        return not_offered(request, 400,
                           "the field `format` names none of what can be answered here:");
    Response response = answer_as(state, request, read->scene, *type, waited_ms, pass);
    const std::string notes = notes_header(read->notes);
    if (!notes.empty()) response.headers.emplace_back("Awan-Notes", notes);
    return response;
}

}  // namespace awan
