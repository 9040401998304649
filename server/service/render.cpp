// POST /v1/render: from a scene to its picture, within one deadline over all stages.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/formats/image_file.h"
#include "core/scene/fingerprint.h"
#include "core/scene/layers.h"
#include "server/document/json.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/result_cache.h"
#include "server/service/scene_request.h"
#include "server/service/state.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

constexpr std::string_view kPng = "image/png";
constexpr std::string_view kExr = "image/x-exr";

struct Timing {
    double queue_ms = 0;
    StageTimes stages;
    double encode_ms = 0;
};

// The stages, in order, then those effects whose share of them can be told apart.
std::vector<std::pair<const char*, double>> stages_of(const Timing& timing, Metrics& metrics) {
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
    return entries;
}

std::string effects_on(const Plan& plan) {
    std::string names;
    for (const EffectDecision& decision : plan.effects)
        if (decision.on)
            names += (names.empty() ? "" : ", ") + std::string(effect_name(decision.effect));
    return names;
}

// Channels of a picture's layers.
double layer_channels(const Scene& scene) {
    const auto layers = read_layers(scene->image.layers);
    double channels = 0;
    for (int i = 0; i < kLayerCount; ++i) {
        const auto layer = static_cast<Layer>(i);
        if (!layers || !layers->has(layer)) continue;
        channels += layer == Layer::kDepth || layer == Layer::kTransmittance ? 1 : 3;
    }
    return channels;
}

// What encoding a pixel takes, ns, on the machine of the calibration: 17 to 27 of PNG (800 x 600), 65 to 70 of half
// floats and 275 of floats (2048 x 1024) were measured; that, and half as much again. Of an EXR, threads share all but
// a tenth, which hands the lines over.
double encode_ms(const Scene& scene, std::string_view type, const MachineSpeed& speed,
                 int threads) {
    const double ns = type == kPng ? 40 : scene->image.precision == Precision::kHalf ? 105 : 415;
    const double share = type == kPng ? 1 : 0.1 + 0.9 / threads;
    // Those figures are of four channels.
    const double channels = type == kPng ? 4 : 4 + layer_channels(scene);
    return 1e-6 * ns * channels / 4 * share * speed.slowness * scene->image.width *
           scene->image.height;
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

// What was predicted may take this share of the time there is, to be asked for with good hope.
constexpr double kFits = 0.7;

// What could be had within so many ms; never more time than was asked for and did not do.
std::string what_fits(const Scene& scene, const Plan& plan, double ms) {
    ms = std::min(ms, scene->accuracy.time_ms.value_or(ms));
    const RungForecast* best = nullptr;
    for (const RungForecast& forecast : plan.forecasts)
        if (forecast.time_ms < kFits * ms && (best == nullptr || forecast.error < best->error))
            best = &forecast;
    std::string detail = "ask for a smaller picture";
    if (best != nullptr)
        detail += number_text(", or for \"accuracy\": {\"time_ms\": %.0f}", kFits * ms) +
                  ", which would be rung " + best->rung->name;
    return detail;
}

// Of the stages between the plan and encoding, as predicted.
double to_come_ms(const Planned& planned) {
    const double done_ms = planned.times.generate_ms + planned.times.survey_ms;
    const double all_ms = planned.plan.predicted.time_ms;
    return std::isfinite(all_ms) ? std::max(all_ms - done_ms, 0.0) : 0;
}

// One render on its way: what is known of it, and how it ends.
struct Way {
    Service::State& state;
    const Request& request;
    const Scene& scene;
    std::string_view type;
    Clock::time_point began = Clock::now();
    // What the plan and what is left of it are expected to take.
    double encode_ms = 0;

    // Why a plan cannot be carried out before the deadline, and what could be; nothing when it may.
    std::optional<Response> hopeless(const Planned& planned) const {
        const double needed = to_come_ms(planned) + encode_ms;
        const double wait =
            needs_device(planned.plan) ? state.device_lane.wait_ms(weight_of(needed)) : 0;
        const double left = std::max(left_ms(request.deadline) - wait, 0.0);
        if (planned.plan.predicted.rung == nullptr || !(needed > kHopeless * left))
            return std::nullopt;
        Response response =
            problem(504,
                    "rung " + planned.plan.rung + " would take about " + seconds_text(needed) +
                        " and " + seconds_text(left) + " are left; " +
                        what_fits(scene, planned.plan, left - encode_ms),
                    "", request.id);
        response.reason = "hopeless";
        return response;
    }
    // An error after the plan.
    Response failed(const Error& error, const Plan& plan) const {
        if (error.code != ErrorCode::kOverDeadline) return fail(error, request);
        const std::chrono::duration<double, std::milli> all = request.deadline.until - began;
        return fail({error.code, "",
                     error.message + "; " + what_fits(scene, plan, all.count() - encode_ms)},
                    request);
    }
};

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

bool keeps_answers(const Service::State& state) {
    return state.results.keeps() || state.options.disk;
}

// An answer that is good without being kept is not lost for want of the memory to keep it. What is kept is shared with
// the answer; what is too large for either place stays the answer's own.
void keep_answer(Service::State& state, const std::string& etag, Response& response) {
    const DiskCache* const disk = state.options.disk.get();
    if (response.body.size() >
        std::max(state.results.most_of_one(), disk ? disk->most_of_one() : 0))
        return;
    try {
        response.share();
        const auto kept =
            std::make_shared<const KeptResult>(KeptResult{response.headers, response.shared});
        state.results.keep(etag, kept);
        if (state.options.disk) state.options.disk->keep(etag, kept);
    } catch (const std::bad_alloc&) {
    }
}

// What a kept answer has of its own: not the time it took, not what is said of keeping it.
Response kept_answer(const KeptResult& kept, const char* where, std::string_view reason) {
    Response response;
    response.headers = kept.headers;
    response.shared = kept.body;
    response.headers.emplace_back("Awan-Cache", where);
    response.reason = reason;
    return response;
}

std::optional<Response> answer_from_disk(Service::State& state, const std::string& etag) {
    if (!state.options.disk) return std::nullopt;
    const auto kept = state.options.disk->find(etag);
    if (!kept) return std::nullopt;
    state.results.keep(etag, kept);
    return kept_answer(*kept, "disk", "disk hit");
}

// What an answer depends on beside scene and renderer: a rung that is chosen by predicted times is this machine's, with
// these threads. Named rungs are chosen by nothing, and down to the default error only threads shift what is cheaper.
std::string chosen_by(const Service::State& state, const Accuracy& accuracy) {
    if (accuracy.rung) return {};
    const std::string threads = std::to_string(state.options.threads);
    const bool by_time = accuracy.time_ms || accuracy.error.value_or(kDefaultError) < kDefaultError;
    return by_time ? threads + " " + speed_text(state) : threads;
}

}  // namespace

double left_ms(const Deadline& deadline) {
    if (deadline.until == Clock::time_point::max()) return std::numeric_limits<double>::infinity();
    const std::chrono::duration<double, std::milli> left = deadline.until - Clock::now();
    return std::max(left.count(), 0.0);
}

std::string server_timing(std::span<const std::pair<const char*, double>> milliseconds) {
    std::string header;
    for (const auto& [name, ms] : milliseconds) {
        header += header.empty() ? "" : ", ";
        header += name + number_text(";dur=%.3f", ms);
    }
    return header;
}

Result<std::string> encode_picture(const Rendered& rendered, const Scene& scene,
                                   std::string_view type, const Deadline& deadline) {
    if (type == kExr)
        return encode_exr(rendered.image, scene->image.precision, notes_of(rendered), deadline,
                          channels_of(rendered.layers));
    return encode_png(rendered.image, film_of(scene),
                      scene->image.format == ImageFormat::kPng16 ? 16 : 8, deadline);
}

Drawn draw_in_lanes(Service::State& state, const Request& request, const Scene& scene,
                    Planned planned, double encode_ms, Lanes::Pass& pass) {
    const Deadline& deadline = request.deadline;
    const double expected_ms = to_come_ms(planned) + encode_ms;
    const auto no_lane = [](Response response) {
        return Drawn{std::move(response), Error{ErrorCode::kCancelled, "", "it got no lane"}};
    };
    if (!needs_device(planned.plan)) {
        if (auto refused = not_kept_in(state, request, expected_ms, pass))
            return no_lane(std::move(*refused));
        return {std::nullopt,
                state.options.on_processor(scene, std::move(planned), threads_of_one(state),
                                           request.progress, deadline)};
    }
    pass.leave();
    const LaneWork work{weight_of(expected_ms), expected_ms, request.client};
    Lanes::Pass drawing(state.device_lane);
    if (auto refused =
            not_let_in(drawing.enter(work, deadline), state.device_lane, work.weight, request))
        return no_lane(std::move(*refused));
    RenderJobResult job = state.renderer.render(scene, std::move(planned), deadline);
    const double queue_ms = drawing.waited_ms() + job.queue_ms;
    drawing.leave();
    const LaneWork encoding{weight_of(encode_ms), encode_ms, request.client};
    if (job.rendered)
        if (auto refused =
                not_let_in(pass.enter(encoding, deadline), state.lanes, encoding.weight, request))
            return no_lane(std::move(*refused));
    return {std::nullopt, std::move(job.rendered), queue_ms};
}

Response answer_render(Service::State& state, const Request& request, const Scene& asked,
                       std::string_view type, Lanes::Pass& pass) {
    // The answer's tag names the renderer.
    if (const Status over = state.renderer.wait_until_started(request.deadline))
        return fail(*over, request);
    const auto preview = query_flag(request, kPreviewName);
    if (!preview) return fail(preview.error(), request);
    const Scene scene = *preview ? for_preview(asked) : asked;
    const RenderThread::Info info = state.renderer.info();
    const std::string etag = make_etag({*preview ? "preview" : "render", fingerprint(scene),
                                        engine_version(), info.device.renderer, info.device.version,
                                        type, chosen_by(state, scene->accuracy)});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    if (const auto kept = state.results.find(etag)) {
        state.metrics.cache_asked(true);
        return kept_answer(*kept, "hit", "cache hit");
    }

    Way way{state, request, scene, type};
    way.encode_ms = encode_ms(scene, type, state.options.speed, threads_of_one(state));
    WorkBudget::Lease lease = state.budget.take(work_bytes(*scene, true));
    if (!lease) return no_memory(state, request);
    if (auto kept = answer_from_disk(state, etag)) return *std::move(kept);
    auto planned = plan_scene(scene, state.options.threads, request.deadline, state.options.speed,
                              &state.tiles, &state.settling_lights);
    if (!planned) return fail(planned.error(), request);
    if (*preview) planned = as_preview(scene, *std::move(planned));
    if (needs_device(planned->plan) && info.state == RenderThread::Info::State::kNoRenderer)
        return problem(503,
                       "rung " + planned->plan.rung +
                           " needs a renderer, and there is none here: " + info.reason,
                       "", request.id);
    if (auto hopeless = way.hopeless(*planned)) return std::move(*hopeless);
    // A lane first: who waits for one needs no memory to compute in, and would keep it from those that have one.
    if (!needs_device(planned->plan))
        if (auto refused = not_kept_in(state, request, to_come_ms(*planned) + way.encode_ms, pass))
            return std::move(*refused);
    if (!lease.grow(static_cast<std::size_t>(std::max(planned->plan.predicted.bytes, 0.0))))
        return no_memory(state, request);

    Timing timing;
    const Plan plan = planned->plan;
    Drawn drawn = draw_in_lanes(state, request, scene, *std::move(planned), way.encode_ms, pass);
    if (drawn.refused) return std::move(*drawn.refused);
    Result<Rendered>& rendered = drawn.rendered;
    timing.queue_ms = drawn.queue_ms;
    if (!rendered) return way.failed(rendered.error(), plan);
    const auto start = Clock::now();
    auto bytes = encode_picture(*rendered, scene, type, request.deadline);
    timing.encode_ms = ms_since(start);
    if (!bytes) return way.failed(bytes.error(), plan);
    if (const Status over = request.deadline.over()) return way.failed(*over, plan);
    timing.queue_ms += pass.waited_ms();
    timing.stages = rendered->times;

    Response response = ok_answer(type, etag);
    response.headers.emplace_back("Awan-Effects", effects_on(rendered->plan));
    response.headers.emplace_back("Awan-Rung", rendered->plan.rung);
    add_errors(*rendered, response);
    response.headers.emplace_back("Awan-Particles", std::to_string(rendered->survey.particles));
    response.body = std::move(bytes).value();
    if (keeps_answers(state)) {
        state.metrics.cache_asked(false);
        keep_answer(state, etag, response);
        response.headers.emplace_back("Awan-Cache", "miss");
    }
    response.stages = stages_of(timing, state.metrics);
    response.headers.emplace_back("Server-Timing", server_timing(response.stages));
    return response;
}

}  // namespace awan
