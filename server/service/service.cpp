#include "server/service/service.h"

#include <algorithm>
#include <array>

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

    std::string_view allow() const { return post ? "POST, OPTIONS" : "GET, HEAD, OPTIONS"; }
};

Route find_route(const Service::State& state, std::string_view path) {
    for (const std::string_view post : std::initializer_list<std::string_view>{
             "/v1/particles", "/v1/render", "/v1/plan", kAccuracyPath})
        if (path == post) return {post, true, true};
    for (const std::string_view get :
         {"/healthz", "/readyz", "/metrics", "/version", "/v1/presets"})
        if (path == get) return {get, true, false};
    for (const Preset& preset : state.presets)
        if (path.starts_with("/v1/presets/") && path.substr(12) == preset.entry.name)
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
    response.headers.emplace_back("Content-Security-Policy", kContentSecurityPolicy);
    response.headers.emplace_back("Referrer-Policy", "no-referrer");
    return response;
}

// Why nothing can be rendered now, or "".
std::string not_ready(const Service::State& state) {
    if (state.draining) return "the server is stopping";
    const RenderThread::Info info = state.renderer.info();
    if (info.state == RenderThread::Info::State::kStarting) return "the renderer is starting";
    if (info.state == RenderThread::Info::State::kNoRenderer)
        return "there is no renderer: " + info.reason;
    return {};
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
        return problem_retry(503, reason, kDrainRetrySeconds, request.id);
    }
    if (route.pattern == "/metrics")
        return text_answer("text/plain; version=0.0.4; charset=utf-8",
                           state.metrics.text(state.renderer.waiting(), not_ready(state).empty()));
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
    const bool reading = request.method == "GET" || request.method == "HEAD";
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
    if (route.post ? request.method != "POST" : !reading) {
        Response response =
            problem(405, "this path takes " + std::string(route.allow()) + " only", "", request.id);
        response.headers.emplace_back("Allow", route.allow());
        return response;
    }
    if (!route.post) return std::nullopt;
    if (state.draining && !request.admitted)
        return problem_retry(503, "the server is stopping", kDrainRetrySeconds, request.id);
    return check_scene_request(request);
}

Response finished(Service::State& state, const Route& route, const Request& request,
                  Response response, double seconds) {
    for (const auto& [name, value] :
         {std::pair<std::string_view, std::string_view>("X-Request-Id", request.id),
          {"X-Content-Type-Options", "nosniff"}})
        if (find_header(response.headers, name).empty()) response.headers.emplace_back(name, value);
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
    : state_(std::make_unique<State>(renderer, metrics, options)) {
    std::vector<PresetEntry> entries;
    for (const Preset& preset : state_->presets) entries.push_back(preset.entry);
    state_->presets_json = presets_to_json(entries.data(), entries.size());
    state_->presets_etag = make_etag({state_->presets_json});
}

Service::~Service() = default;

void Service::drain() {
    state_->draining = true;
}

int Service::retry_after_seconds() const {
    return state_->renderer.retry_after_seconds();
}

std::optional<Response> Service::refuse(const Request& request) {
    const Route route = find_route(*state_, request.path);
    std::optional<Response> response = check(*state_, route, request);
    if (!response) return std::nullopt;
    return finished(*state_, route, request, std::move(*response), 0);
}

Response Service::answer(const Request& request) {
    const auto start = Clock::now();
    Route route;
    Response response;
    try {
        route = find_route(*state_, request.path);
        if (auto refused = check(*state_, route, request)) {
            response = std::move(*refused);
        } else {
            response =
                route.post ? answer_scene_request(*state_, request) : get(*state_, route, request);
            compress(request, response);
        }
    } catch (const std::bad_alloc&) {
        response = problem_retry(503, "there is not enough memory for this now",
                                 retry_after_seconds(), request.id);
    } catch (const std::exception&) {
        response = problem(Error{ErrorCode::kInternal, "", ""}, request.id);
    }
    const std::chrono::duration<double> took = Clock::now() - start;
    return finished(*state_, route, request, std::move(response), took.count());
}

}  // namespace awan
