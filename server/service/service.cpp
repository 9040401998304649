#include "server/service/service.h"

#include <algorithm>
#include <array>

#include "core/base/thrown.h"
#include "server/document/json.h"
#include "server/header_text.h"
#include "server/service/compression.h"
#include "server/service/forms.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

// Seconds for Retry-After. By then another instance, or this one started anew, is up.
constexpr int kDrainRetrySeconds = 5;

// Counts the requests that are being answered.
class InProgress {
  public:
    explicit InProgress(std::atomic<std::size_t>* count) : count_(count) {
        if (count_) ++*count_;
    }
    ~InProgress() {
        if (count_) --*count_;
    }
    InProgress(const InProgress&) = delete;
    InProgress& operator=(const InProgress&) = delete;

  private:
    std::atomic<std::size_t>* count_;
};

ServiceOptions with_defaults(ServiceOptions options) {
    if (!options.on_processor) options.on_processor = processor_renderer();
    return options;
}

std::string_view find_header(const std::vector<std::pair<std::string, std::string>>& headers,
                             std::string_view name) {
    for (const auto& [key, value] : headers)
        if (same(key, name)) return value;
    return {};
}

// Where a path leads. `pattern` is its label in the metrics, so it is never the client's text.
struct Route {
    std::string_view pattern = "other";
    bool known = false;
    bool post = false;
    const Page* page = nullptr;
    const Preset* preset = nullptr;

    // Of jobs: one of them may be deleted. Of textures: one may be put there too.
    bool job = false, deletable = false;
    bool texture = false, puttable = false;

    std::string_view allow() const {
        if (puttable) return "GET, HEAD, PUT, DELETE, OPTIONS";
        if (deletable) return "GET, HEAD, DELETE, OPTIONS";
        return post ? "POST, OPTIONS" : "GET, HEAD, OPTIONS";
    }
    bool takes(std::string_view method) const {
        if (post) return method == "POST";
        return method == "GET" || method == "HEAD" || (puttable && method == "PUT") ||
               (deletable && method == "DELETE");
    }
};

Route job_route(std::string_view rest) {
    Route route{"/v1/jobs/{id}", true, false};
    route.job = true;
    const std::size_t slash = rest.find('/');
    const std::string_view below = slash == std::string_view::npos ? "" : rest.substr(slash);
    if (below.empty()) {
        route.deletable = true;
    } else if (below == "/events") {
        route.pattern = "/v1/jobs/{id}/events";
    } else if (below == "/result") {
        route.pattern = "/v1/jobs/{id}/result";
    } else {
        return {};
    }
    return rest.substr(0, slash).empty() ? Route{} : route;
}

Route texture_route(std::string_view below) {
    Route route{below.empty() ? "/v1/textures" : "/v1/textures/{name}", true, false};
    route.texture = true;
    route.deletable = route.puttable = !below.empty();
    return route;
}

Route find_route(const Service::State& state, std::string_view path) {
    for (const std::string_view post : std::initializer_list<std::string_view>{
             "/v1/particles", "/v1/render", "/v1/plan", kSkyPath, kAccuracyPath, kJobsPath})
        if (path == post) return {post, true, true};
    if (path.starts_with("/v1/jobs/")) return job_route(path.substr(9));
    if (path == kTexturesPath) return texture_route("");
    if (path.starts_with("/v1/textures/") && path.size() > 13 &&
        path.substr(13).find('/') == std::string_view::npos)
        return texture_route(path.substr(13));
    for (const std::string_view get :
         {"/healthz", "/readyz", "/metrics", "/version", "/v1/presets"})
        if (path == get) return {get, true, false};
    for (const Preset& preset : state.presets)
        if (path.starts_with("/v1/presets/") && is_called(preset.entry, path.substr(12)))
            return {"/v1/presets/{name}", true, false, nullptr, &preset};
    for (const Page& page : state.pages)
        if (path == page.path)
            return {path == "/openapi.json" ? "/openapi.json" : "page", true, false, &page};
    return {};
}

std::string_view without_slash(std::string_view path) {
    path.remove_suffix(1);
    return path;
}
bool known_without_slash(const Service::State& state, std::string_view path) {
    return path.size() > 1 && path.ends_with('/') && find_route(state, without_slash(path)).known;
}

Response text_answer(std::string_view content_type, std::string body) {
    Response response;
    response.headers = {{"Content-Type", std::string(content_type)}, {"Cache-Control", "no-store"}};
    response.body = std::move(body);
    return response;
}

// Something that changes only with the program: cached, but asked about each time.
Response constant_answer(const Request& request, std::string_view content_type,
                         std::string_view etag, std::string_view body) {
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, false);
    Response response;
    response.headers = {{"Content-Type", std::string(content_type)},
                        {"Cache-Control", "no-cache"},
                        {"ETag", std::string(etag)}};
    response.body = body;
    return response;
}

Response page_answer(const Request& request, const Page& page) {
    Response response = constant_answer(request, page.content_type, page.etag, page.text);
    send_packed(request, page.packed, response);
    response.headers.emplace_back("Content-Security-Policy", kContentSecurityPolicy);
    // Not "no-referrer": with that, browsers call the origin of a form `null`, which may not post.
    response.headers.emplace_back("Referrer-Policy", "same-origin");
    return response;
}

// Why nothing can be rendered now, or "".
std::string not_ready(const Service::State& state) {
    if (state.draining) return "the server is stopping";
    const RenderThread::Info info = state.renderer.info();
    if (info.state == RenderThread::Info::State::kStarting) return "the renderer is starting";
    if (state.lanes.load().full) return "saturated: as many requests wait as may";
    return {};
}

// For whoever comes before anything is known of what it asks. Work that turns out to be long waits in any number: then
// it is that which fills the server, and a place becomes free when a long one ends.
int retry_seconds(const Service::State& state) {
    const bool full_of_long = state.lanes.load().waiting_long >= state.options.lanes.line;
    return seconds_from_ms(std::max(state.lanes.wait_ms(Weight::kShort),
                                    full_of_long ? state.lanes.next_end_ms(Weight::kLong) : 0.0));
}

Gauges gauges(const Service::State& state) {
    Gauges now;
    now.ready = not_ready(state).empty();
    now.renderer = state.renderer.info().state == RenderThread::Info::State::kReady;
    now.renderer_reopened = state.renderer.reopened();
    now.in_progress = state.in_progress;
    now.lanes = state.lanes.load();
    now.device_lane = state.device_lane.load();
    now.work_bytes = state.budget.taken();
    now.work_bytes_most = state.budget.bytes();
    now.cache_bytes = state.results.bytes_in_use();
    now.cache_entries = state.results.entries();
    if (state.options.disk) now.disk = state.options.disk->counts();
    const Jobs::Load jobs = state.jobs->load();
    now.jobs_waiting = jobs.waiting;
    now.jobs_running = jobs.running;
    now.job_bytes = jobs.bytes;
    return now;
}

Response get(Service::State& state, const Route& route, const Request& request) {
    if (route.page) return page_answer(request, *route.page);
    if (route.preset)
        return constant_answer(request, "application/json", route.preset->etag,
                               route.preset->entry.text);
    if (route.pattern == "/v1/presets")
        return constant_answer(request, "application/json", state.presets_etag, state.presets_json);
    if (route.pattern == "/healthz") return text_answer("text/plain; charset=utf-8", "ok\n");
    if (route.pattern == "/readyz") {
        const std::string reason = not_ready(state);
        if (reason.empty()) return text_answer("text/plain; charset=utf-8", "ready\n");
        const int seconds = state.draining ? kDrainRetrySeconds : retry_seconds(state);
        return problem_retry(503, reason, seconds, request.id);
    }
    if (route.pattern == "/metrics")
        return text_answer("text/plain; version=0.0.4; charset=utf-8",
                           state.metrics.text(gauges(state)));
    // Here the path is /version.
    const RenderThread::Info info = state.renderer.info();
    const bool ready = info.state == RenderThread::Info::State::kReady;
    const bool starting = info.state == RenderThread::Info::State::kStarting;
    return text_answer("application/json",
                       version_to_json(ready ? &info.device : nullptr,
                                       starting ? "the renderer is starting" : info.reason));
}

// What can be said before the body: unknown paths, wrong methods, a server that stops, wrong types.
std::optional<Response> check(const Service::State& state, const Route& route,
                              const Request& request) {
    if (request.method == "OPTIONS" && (route.known || request.path == "*")) {
        Response response;
        response.status = 204;
        response.headers = {
            {"Allow", std::string(route.known ? route.allow() : "GET, HEAD, POST, OPTIONS")}};
        return response;
    }
    if (!route.known && known_without_slash(state, request.path)) {
        // With the method and the body as they are.
        const std::string_view path = without_slash(request.path);
        Response response =
            problem(308, "this path has no slash at its end: " + std::string(path), "", request.id);
        response.headers.emplace_back("Location", std::string(path) + query_text(request.query));
        return response;
    }
    if (!route.known) return problem(404, "there is nothing at this path", "", request.id);
    if (!route.takes(request.method)) {
        Response response =
            problem(405, "this path takes " + std::string(route.allow()) + " only", "", request.id);
        response.headers.emplace_back("Allow", route.allow());
        return response;
    }
    if (!route.post && request.method != "PUT") return std::nullopt;
    if (state.draining && !request.admitted)
        return problem_retry(503, "the server is stopping", kDrainRetrySeconds, request.id);
    if (!route.post) return std::nullopt;
    return route.pattern == kJobsPath ? check_job_request(request) : check_scene_request(request);
}

Response route_answer(Service::State& state, const Route& route, const Request& request) {
    if (route.job) return tell_job(state, request);
    if (route.texture) return answer_texture_request(state, request);
    if (!route.post) return get(state, route, request);
    return route.pattern == kJobsPath ? submit_job(state, request)
                                      : answer_scene_request(state, request);
}

Response finished(Service::State& state, const Route& route, const Request& request,
                  Response response, double seconds) {
    response.route = route.pattern;
    for (const auto& [name, value] :
         {std::pair<std::string_view, std::string_view>("X-Request-Id", request.id),
          {"X-Content-Type-Options", "nosniff"}})
        if (find_header(response.headers, name).empty()) response.headers.emplace_back(name, value);
    // Nobody reads the status of an answer whose client has gone; 499 is what nginx counts it as.
    if (response.abandoned) response.status = kClientGone;
    state.metrics.request_done(route.pattern, response.status, seconds);
    return response;
}

}  // namespace

std::string_view Request::header(std::string_view name) const {
    return find_header(headers, name);
}
std::string_view Response::header(std::string_view name) const {
    return find_header(headers, name);
}

void Response::share() {
    if (body.empty()) return;
    // Where there is no memory for this, the body is still where it was.
    const auto bytes = std::make_shared<std::string>();
    bytes->swap(body);
    shared = bytes;
}

std::string joined_header(const Request& request, std::string_view name) {
    std::string all;
    for (const auto& [key, value] : request.headers)
        if (same(key, name)) all += (all.empty() ? "" : ", ") + value;
    return all;
}

Response not_modified(std::string_view etag, bool varies) {
    Response response;
    response.status = 304;
    response.headers = {{"ETag", std::string(etag)}, {"Cache-Control", "no-cache"}};
    if (varies) response.headers.emplace_back("Vary", "Accept");
    return response;
}

Service::Service(RenderThread& renderer, Metrics& metrics, ServiceOptions options)
    : state_(std::make_unique<State>(renderer, metrics, with_defaults(std::move(options)))) {
    std::vector<PresetEntry> entries;
    for (const Preset& preset : state_->presets) entries.push_back(preset.entry);
    state_->presets_json = presets_to_json(entries.data(), entries.size());
    state_->presets_etag = make_etag({state_->presets_json});
    JobsOptions jobs;
    jobs.runners = state_->options.jobs;
    state_->jobs = std::make_unique<Jobs>(
        jobs, [state = state_.get()](const JobWork& work, const Request& request) {
            return answer_job_work(*state, work, request);
        });
}

Service::~Service() = default;

bool Service::waits_for_events(std::string_view target) {
    const std::string_view path = target.substr(0, target.find('?'));
    return path.starts_with("/v1/jobs/") && path.ends_with("/events");
}

void Service::drain() {
    state_->draining = true;
}

std::vector<std::string> Service::page_paths() const {
    std::vector<std::string> paths;
    for (const Page& page : state_->pages) paths.push_back(page.path);
    return paths;
}

int Service::retry_after_seconds() const {
    return retry_seconds(*state_);
}

std::size_t Service::in_progress() const {
    return state_->in_progress;
}

std::size_t Service::in_line() const {
    std::size_t waiting = 0;
    for (const Lanes* lanes : {&state_->lanes, &state_->device_lane}) {
        const Lanes::Load load = lanes->load();
        waiting += load.waiting_short + load.waiting_long;
    }
    return waiting;
}

std::optional<Response> Service::refuse(const Request& request) {
    const Route route = find_route(*state_, request.path);
    std::optional<Response> response = check(*state_, route, request);
    if (!response) return std::nullopt;
    show_problem(joined_header(request, "Accept"), *response);
    return finished(*state_, route, request, std::move(*response), 0);
}

Response Service::answer(const Request& request) {
    const auto start = Clock::now();
    Route route;
    Response response;
    const bool works = request.method == "POST" || request.method == "PUT";
    const InProgress counted(works ? &state_->in_progress : nullptr);
    try {
        route = find_route(*state_, request.path);
        if (auto refused = check(*state_, route, request)) {
            response = std::move(*refused);
        } else {
            response = route_answer(*state_, route, request);
        }
        show_problem(joined_header(request, "Accept"), response);
        compress(request, response);
    } catch (const std::exception& e) {
        response = fail(error_of_thrown(e), request);
    }
    if (response.status == 503 && response.header("Retry-After").empty())
        response.headers.emplace_back("Retry-After", std::to_string(retry_seconds(*state_)));
    const std::chrono::duration<double> took = Clock::now() - start;
    return finished(*state_, route, request, std::move(response), took.count());
}

}  // namespace awan
