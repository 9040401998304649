// POST /v1/accuracy: what accuracy costs this scene, here and now.
#include <algorithm>
#include <chrono>
#include <thread>

#include "core/accuracy/plot.h"
#include "core/formats/numbers.h"
#include "core/scene/rungs.h"
#include "server/document/accuracy_text.h"
#include "server/document/overrides.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

// The share of a request's time that a sweep may take. The rest is for predictions that were too low, and for the
// plot.
constexpr double kShareOfDeadline = 0.75;
// What a query may ask of the reference at most: pixels along its longer side, paths a pixel, runs of each rung.
constexpr int kLargestSide = 512;
constexpr std::uint32_t kMostSamples = 1u << 20;
constexpr int kMostRuns = 100;
// How often a full queue is asked again.
constexpr std::chrono::milliseconds kLook{20};

struct Query {
    AccuracyOptions options;
    PlotTheme theme = PlotTheme::kLight;
};

Error malformed(std::string message) {
    return {ErrorCode::kMalformed, "", std::move(message)};
}

template <typename T>
Status read_integer(const std::string& name, const std::string& value, T least, T most, T& to) {
    const auto number = read_number<T>(value);
    if (!number || *number < least || *number > most)
        return malformed("query parameter `" + name + "` must be an integer from " +
                         std::to_string(least) + " to " + std::to_string(most) + ", not " +
                         short_quote(value));
    to = *number;
    return std::nullopt;
}

Status read_rungs(const std::string& value, std::vector<std::string>& rungs) {
    for (std::size_t at = 0; at <= value.size();) {
        const std::size_t end = std::min(value.find(',', at), value.size());
        const std::string name = value.substr(at, end - at);
        if (!find_rung(name)) {
            std::string names;
            for (const Rung& rung : ladder())
                names += (names.empty() ? "" : ", ") + std::string(rung.name);
            return malformed(
                "query parameter `rungs` must be names of rungs with commas between "
                "them, from " +
                names + ", not " + short_quote(name));
        }
        rungs.push_back(name);
        at = end + 1;
    }
    return std::nullopt;
}

Result<Query> read_query(const Request& request) {
    Query query;
    for (const auto& [name, value] : request.query) {
        Status wrong;
        if (name == "theme") {
            if (value != "light" && value != "dark")
                return malformed("query parameter `theme` must be light or dark, not " +
                                 short_quote(value));
            query.theme = value == "dark" ? PlotTheme::kDark : PlotTheme::kLight;
        } else if (name == "size") {
            wrong = read_integer(name, value, 8, kLargestSide, query.options.reference_side);
        } else if (name == "samples") {
            wrong = read_integer(name, value, 2u, kMostSamples, query.options.samples);
        } else if (name == "runs") {
            wrong = read_integer(name, value, 1, kMostRuns, query.options.runs);
        } else if (name == "rungs") {
            wrong = read_rungs(value, query.options.rungs);
        } else if (!is_override(name)) {
            return malformed("there is no query parameter " + short_quote(name) +
                             "; there are theme, size, samples, runs and rungs");
        }
        if (wrong) return *wrong;
    }
    return query;
}

// One render of a sweep, with nothing kept from another. What needs no device is rendered here. What
// does waits for the renderer as all do, so that other requests are served between two of them. The line may be full at
// a moment; a sweep has time, and must not be lost for that.
Result<Rendered> render_one(Service::State& state, const Scene& scene, const std::string& client,
                            const Deadline& deadline, double& queue_ms) {
    const ServiceOptions& options = state.options;
    auto planned = plan_scene(scene, options.threads, deadline, options.speed);
    if (!planned) return planned.error();
    if (!needs_device(planned->plan))
        return render_planned(scene, *std::move(planned),
                              {nullptr, options.threads, nullptr, {}, options.speed}, deadline);
    const auto start = Clock::now();
    const double expected_ms = planned->plan.predicted.time_ms;
    Lanes::Pass pass(state.device_lane);
    for (;;) {
        const auto entry = pass.enter({weight_of(expected_ms), expected_ms, client}, deadline);
        if (entry == Lanes::Entry::kIn) break;
        if (const auto over = deadline.over()) return *over;
        std::this_thread::sleep_for(kLook);
    }
    queue_ms += ms_since(start);
    RenderJobResult job = state.renderer.render(scene, *std::move(planned), deadline);
    queue_ms += job.queue_ms;
    return std::move(job.rendered);
}

// Where there is no renderer, what can be measured without: all rungs but the splats and, as always, truth.
void leave_out_splats(AccuracyOptions& options) {
    if (!options.rungs.empty()) return;
    for (const Rung& rung : ladder())
        if (rung.method == Method::kMarch) options.rungs.emplace_back(rung.name);
}

}  // namespace

Status check_accuracy_query(const Request& request) {
    const auto query = read_query(request);
    if (!query) return query.error();
    return std::nullopt;
}

Response answer_accuracy(Service::State& state, const Request& request, const Scene& scene,
                         std::string_view type) {
    const auto start = Clock::now();
    auto query = read_query(request);
    if (!query) return fail(query.error(), request);
    if (const Status over = state.renderer.wait_until_started(request.deadline))
        return fail(*over, request);
    const RenderThread::Info info = state.renderer.info();
    AccuracyOptions& options = query->options;
    if (info.state == RenderThread::Info::State::kNoRenderer) leave_out_splats(options);
    const std::unique_lock sweep(state.sweeping, std::try_to_lock);
    if (!sweep) {
        const std::chrono::duration<double, std::milli> left =
            state.sweeps_until.load() - Clock::now();
        return problem_retry(429, "another request measures what accuracy costs",
                             seconds_from_ms(left.count()), request.id);
    }
    const WorkBudget::Lease lease = state.budget.take(work_bytes(*scene, true));
    if (!lease) return no_memory(state, request);

    options.threads = state.options.threads;
    options.speed = state.options.speed;
    const double left_ms =
        request.deadline.until == Clock::time_point::max()
            ? std::chrono::duration<double, std::milli>(limits::kRequestDeadline).count()
            : std::chrono::duration<double, std::milli>(request.deadline.until - start).count();
    options.time_ms = std::max(kShareOfDeadline * left_ms, 1.0);
    state.sweeps_until =
        Clock::now() + std::chrono::milliseconds(static_cast<int>(options.time_ms));
    double queue_ms = 0;
    const auto render = [&](const Scene& one, const Deadline& deadline) {
        return render_one(state, one, request.client, deadline, queue_ms);
    };
    NamedAccuracy named;
    auto report = measure_accuracy(scene, options, render, request.progress, request.deadline);
    if (!report) return fail(report.error(), request);
    named.report = *std::move(report);
    const double measured_ms = ms_since(start);

    const auto encode_start = Clock::now();
    Response response;
    response.headers = {{"Content-Type", std::string(type)},
                        // Times differ from one sweep to the next, so nothing is to be kept.
                        {"Cache-Control", "no-store"},
                        {"Vary", "Accept"}};
    if (type == "image/png") {
        const AccuracyPlot plot{"", &named.report};
        auto png = plot_accuracy({&plot, 1}, query->theme);
        if (!png) return fail(png.error(), request);
        if (const Status over = request.deadline.over()) return fail(*over, request);
        response.body = *std::move(png);
    } else {
        response.body =
            type == "text/csv" ? accuracy_to_csv({&named, 1}) : accuracy_to_json({&named, 1});
    }
    const double reference_ms = named.report.reference.time_ms;
    const std::pair<const char*, double> timing[] = {
        {"queue", queue_ms},
        {"reference", reference_ms},
        {"rungs", std::max(measured_ms - reference_ms - queue_ms, 0.0)},
        {"encode", ms_since(encode_start)}};
    response.headers.emplace_back("Server-Timing", server_timing(timing));
    response.stages.assign(std::begin(timing), std::end(timing));
    return response;
}

}  // namespace awan
