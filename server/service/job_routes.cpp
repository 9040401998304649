// /v1/jobs: work that is asked for now and fetched later.
#include <algorithm>
#include <thread>

#include "core/formats/numbers.h"
#include "core/formats/quote.h"
#include "core/scene/rungs.h"
#include "server/document/job_text.h"
#include "server/document/scene_text.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/scene_request.h"
#include "server/service/state.h"

namespace awan {
namespace {

// Without anything to tell, a stream says that it lives, which also finds out whether anybody listens.
constexpr std::chrono::seconds kStillHere{1};

// What a kind of job makes: its formats, the first by default, and the request whose answer is its result.
struct JobKind {
    std::string_view name, path;
    // Word and media type.
    std::vector<std::pair<std::string_view, std::string_view>> formats;
};

const std::vector<JobKind>& job_kinds() {
    static const std::vector<JobKind> kinds = {
        {"render", "/v1/render", {{"", ""}, {"png", "image/png"}, {"exr", "image/x-exr"}}},
        {"accuracy",
         "/v1/accuracy",
         {{"json", "application/json"}, {"csv", "text/csv"}, {"png", "image/png"}}},
        {"sequence",
         "",
         {{"webp", "image/webp"},
          {"apng", "image/apng"},
          {"zip", "application/zip"},
          {"flipbook", "application/zip"}}},
        {"fly",
         "",
         {{"webp", "image/webp"},
          {"apng", "image/apng"},
          {"zip", "application/zip"},
          {"json", "application/json"}}},
        {"impostor", "", {{"zip", "application/zip"}}}};
    return kinds;
}

Error wrong(const std::string& pointer, std::string message) {
    return {ErrorCode::kInvalidScene, pointer, std::move(message)};
}

// "\"a\", \"b\"".
std::string listed(std::span<const char* const> words) {
    std::string all;
    for (const char* const word : words)
        all += (all.empty() ? "\"" : ", \"") + std::string(word) + '"';
    return all;
}

// The place of a word among those there are.
Result<std::size_t> word_at(std::string_view word, std::span<const char* const> words,
                            const char* pointer) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) return wrong(pointer, "must be one of " + listed(words));
    return static_cast<std::size_t>(found - words.begin());
}

// What a job of kind fly asks for; no other has such members.
Result<FlightWish> flight_wish(const JobText& text) {
    FlightWish wish;
    const std::pair<const char*, std::string_view> given[] = {
        {"/path", text.path},           {"/mode", text.mode},
        {"/frames", text.frames},       {"/rung", text.rung},
        {"/impostors", text.impostors}, {"/impostor_pixels", text.impostor_pixels}};
    for (const auto& [pointer, value] : given)
        if (!value.empty() && text.kind != "fly")
            return wrong(pointer, "belongs to a job of kind \"fly\"");
    if (!text.path.empty()) {
        const auto path = word_at(text.path, kFlightPathWords, "/path");
        if (!path) return path.error();
        wish.path = static_cast<FlightPath>(*path);
    }
    if (!text.mode.empty()) {
        const auto mode = word_at(text.mode, kThicknessWords, "/mode");
        if (!mode) return mode.error();
        wish.thickness = static_cast<Thickness>(*mode);
    }
    if (!text.frames.empty()) {
        wish.frames = read_number<std::uint64_t>(text.frames);
        if (!wish.frames || *wish.frames < 1 || *wish.frames > limits::kMaxCameraKeys)
            return wrong("/frames",
                         "must be an integer from 1 to " + std::to_string(limits::kMaxCameraKeys));
    }
    if (!text.rung.empty()) {
        std::vector<const char*> rungs;
        for (const Rung& rung : ladder()) rungs.push_back(rung.name);
        if (const auto known = word_at(text.rung, rungs, "/rung"); !known) return known.error();
        wish.rung = text.rung;
    }
    return wish;
}

// Likewise.
Result<FlightImpostorWish> flight_impostors(const JobText& text) {
    FlightImpostorWish wish;
    if (!text.impostors.empty()) {
        const auto mode = word_at(text.impostors, kImpostorsWords, "/impostors");
        if (!mode) return mode.error();
        wish.mode = static_cast<Impostors>(*mode);
    }
    if (text.impostor_pixels.empty()) return wish;
    const auto pixels = read_number<double>(text.impostor_pixels);
    if (!pixels || !(*pixels >= kLeastImpostorPixels && *pixels <= kMostImpostorPixels))
        return wrong("/impostor_pixels", "must be a number from 0.05 to 64 (pixels)");
    wish.pixels = *pixels;
    return wish;
}

Result<int> count_at(std::string_view text, int least, int most, int usual, const char* pointer) {
    if (text.empty()) return usual;
    const auto count = read_number<int>(text);
    if (count && *count >= least && *count <= most) return *count;
    return wrong(pointer, "must be an integer from " + std::to_string(least) + " to " +
                              std::to_string(most));
}

Result<ImpostorWish> impostor_wish(const JobText& text) {
    ImpostorWish wish;
    if (text.kind != "impostor") {
        for (const auto& [value, pointer] :
             {std::pair(text.views, "/views"), std::pair(text.size, "/size"),
              std::pair(text.mapping, "/mapping")})
            if (!value.empty()) return wrong(pointer, "is of jobs of kind impostor");
        return wish;
    }
    const auto views = count_at(text.views, 2, kMostImpostorViews, wish.views, "/views");
    if (!views) return views.error();
    const auto size = count_at(text.size, 1, kMostImpostorSize, wish.size, "/size");
    if (!size) return size.error();
    wish.views = *views;
    wish.size = *size;
    if (wish.views * wish.size > limits::kMaxImageSide)
        return wrong("/size", "times views must be at most " +
                                  std::to_string(limits::kMaxImageSide) + " pixels");
    if (!text.mapping.empty()) {
        const auto mapping = word_at(text.mapping, kImpostorWords, "/mapping");
        if (!mapping) return mapping.error();
        wish.mapping = static_cast<ImpostorMapping>(*mapping);
    }
    return wish;
}

// The request whose answer is the job's result.
Result<JobWork> work_of(const JobText& text, const Request& request) {
    const auto kind = std::find_if(job_kinds().begin(), job_kinds().end(),
                                   [&](const JobKind& k) { return k.name == text.kind; });
    if (kind == job_kinds().end())
        return wrong("/kind", R"(must be "render", "accuracy", "sequence", "fly" or "impostor")");
    const auto format = text.format.empty()
                            ? kind->formats.begin()
                            : std::find_if(kind->formats.begin(), kind->formats.end(),
                                           [&](const auto& f) { return f.first == text.format; });
    if (format == kind->formats.end()) {
        std::string known;
        for (const auto& [word, type] : kind->formats)
            if (!word.empty()) known += (known.empty() ? "\"" : ", \"") + std::string(word) + '"';
        return wrong("/format", "must be one of " + known);
    }
    auto flight = flight_wish(text);
    if (!flight) return flight.error();
    const auto flown = flight_impostors(text);
    if (!flown) return flown.error();
    const auto impostor = impostor_wish(text);
    if (!impostor) return impostor.error();
    JobWork work;
    work.flight_impostors = *flown;
    work.impostor = *impostor;
    work.flight = *std::move(flight);
    work.id = request_id_from("");
    work.kind = text.kind;
    work.format = format->first;
    work.request.method = "POST";
    work.request.path = kind->path;
    work.request.headers = {{"Content-Type", "application/json"}};
    if (!format->second.empty()) work.request.headers.emplace_back("Accept", format->second);
    work.request.body = text.scene;
    work.request.id = request.id;
    work.request.client = request.client;
    return work;
}

Response accepted(std::string_view id, const JobView& view, std::string_view kind) {
    Response response;
    response.status = 202;
    response.headers = {{"Content-Type", "application/json"},
                        {"Cache-Control", "no-store"},
                        {"Location", "/v1/jobs/" + std::string(id)}};
    response.body = job_to_json({id, kind, name_of(view.state), view.progress, view.age_seconds,
                                 view.result ? view.result->status : 0});
    return response;
}

// Whether the scene can be, before anything is promised. In a lane, as everything that computes.
std::optional<Response> refuse_scene(Service::State& state, const Request& request,
                                     const JobWork& work) {
    const Weight weight = request.body.size() > (1u << 20) ? Weight::kLong : Weight::kShort;
    Lanes::Pass pass(state.lanes);
    if (auto refused =
            not_let_in(pass.enter({weight, kTypical_ms, request.client}, request.deadline),
                       state.lanes, weight, request))
        return refused;
    const WorkBudget::Lease reading = state.budget.take(reading_bytes(request.body.size()));
    if (!reading) return no_memory(state, request);
    auto scene = read_request_scene(state, work.request);
    if (!scene) {
        Error error = scene.error();
        error.pointer = "/scene" + error.pointer;
        return fail(error, request);
    }
    if (work.kind == "sequence" && !(*scene)->sequence)
        return fail(wrong("/scene/sequence", "a job of a sequence needs one"), request);
    if (work.flight.path == FlightPath::kKeys &&
        !((*scene)->sequence && !(*scene)->sequence->camera.empty()))
        return fail(wrong("/scene/sequence/camera", "there are no keys to fly along"), request);
    return std::nullopt;
}

// Server-sent events (WHATWG HTML, 9.2): `state` with what GET of the job says, at every change; the last one tells the
// end.
struct EventStream {
    Service::State& state;
    std::string id, kind;
    Deadline::Clock::time_point until = Deadline::Clock::now() + limits::kEventsDeadline;
    std::optional<std::uint64_t> version;

    EventStream(Service::State& s, std::string i, std::string k)
        : state(s), id(std::move(i)), kind(std::move(k)) {}
    ~EventStream() { --state.streams; }
    EventStream(const EventStream&) = delete;
    EventStream& operator=(const EventStream&) = delete;

    // False when that was the last.
    bool append(std::string& out) {
        const auto view =
            version ? state.jobs->wait(id, *version, kStillHere) : state.jobs->view(id);
        if (!view) return false;
        if (version && *version == view->version) {
            out += ":\n\n";
        } else {
            out += "event: state\nid: " + std::to_string(view->version) + "\ndata: " +
                   job_to_json({id, kind, name_of(view->state), view->progress, view->age_seconds,
                                view->result ? view->result->status : 0}) +
                   "\n\n";
        }
        version = view->version;
        return !view->finished() && !state.draining && Deadline::Clock::now() < until;
    }
};

Response stream_events(Service::State& state, const Request& request, const JobWork& work) {
    if (++state.streams > limits::kEventStreams) {
        --state.streams;
        return problem_retry(429, "too many follow jobs; ask for the job now and then", 5,
                             request.id);
    }
    const auto events = std::make_shared<EventStream>(state, work.id, work.kind);
    Response response;
    response.headers = {{"Content-Type", "text/event-stream"}, {"Cache-Control", "no-store"}};
    response.stream = [events](std::string& piece) { return events->append(piece); };
    return response;
}

Response tell_result(const JobView& view, const Request& request) {
    if (view.state == JobState::kCancelled)
        return problem(410, "the job was cancelled", "", request.id);
    if (!view.finished()) {
        Response response =
            problem_retry(409, "the job has not finished; ask for its state", 1, request.id);
        return response;
    }
    if (!view.result)
        return problem(503, "there was not enough memory for its result", "", request.id);
    Response response = *view.result;
    // The answer is of this request now.
    std::erase_if(response.headers, [](const auto& h) { return h.first == "X-Request-Id"; });
    const std::string_view tag = response.header("ETag");
    if (response.status == 200 && !tag.empty() &&
        none_match_names(joined_header(request, "If-None-Match"), tag))
        return not_modified(tag, false);
    return response;
}

}  // namespace

std::optional<Response> check_job_request(const Request& request) {
    if (!request.query.empty())
        return problem(400,
                       "there is no query parameter " + short_quote(request.query[0].first) +
                           " here; a job says all in its body",
                       "", request.id);
    const std::string type = media_type(request.header("Content-Type"));
    if (scene_format_of_type(type) != SceneFormat::kJson) {
        Response response =
            problem(415, "a job comes as application/json, in UTF-8", "", request.id);
        response.headers.emplace_back("Accept", "application/json");
        return response;
    }
    if (request.header("Idempotency-Key").size() > limits::kMaxKeyBytes)
        return problem(400,
                       "an Idempotency-Key has at most " + std::to_string(limits::kMaxKeyBytes) +
                           " characters",
                       "", request.id);
    return std::nullopt;
}

Response submit_job(Service::State& state, const Request& request) {
    const std::string key(request.header("Idempotency-Key"));
    const auto unpacked = unpacked_body(request);
    if (!unpacked) return fail(unpacked.error(), request);
    const std::string_view body = *unpacked ? std::string_view(**unpacked) : request.body;
    const std::string digest = make_etag({body});
    const auto text = parse_job(body);
    if (!text) return fail(text.error(), request);
    auto work = work_of(*text, request);
    if (!work) return fail(work.error(), request);
    if (auto refused = refuse_scene(state, request, *work)) return std::move(*refused);
    // Two with one key may come at the same time.
    const std::lock_guard lock(state.submitting);
    if (!key.empty())
        if (const auto before = state.jobs->with_key(key)) {
            if (before->second != digest)
                return problem(422, "this Idempotency-Key came with another body before", "",
                               request.id);
            if (const auto view = state.jobs->view(before->first))
                return accepted(before->first, *view, work->kind);
        }
    work->idempotency_key = key;
    work->digest = digest;
    const std::string id = work->id;
    const std::string kind = work->kind;
    if (!state.jobs->submit(*std::move(work)))
        return problem_retry(429, "so many jobs wait already",
                             seconds_from_ms(state.lanes.wait_ms(Weight::kLong)), request.id);
    return accepted(id, state.jobs->view(id).value_or(JobView{}), kind);
}

Response tell_job(Service::State& state, const Request& request) {
    const std::string_view rest = std::string_view(request.path).substr(kJobsPath.size() + 1);
    const std::string_view id = rest.substr(0, rest.find('/'));
    const auto view = state.jobs->view(id);
    const auto work = state.jobs->work(id);
    if (!view || !work)
        return problem(404, "there is no such job, or its result was dropped", "", request.id);
    if (request.method == "DELETE") {
        state.jobs->remove(id);
        Response response;
        response.status = 204;
        return response;
    }
    if (rest.ends_with("/events")) return stream_events(state, request, *work);
    if (rest.ends_with("/result")) return tell_result(*view, request);
    Response response = accepted(id, *view, work->kind);
    response.status = 200;
    std::erase_if(response.headers, [](const auto& h) { return h.first == "Location"; });
    return response;
}

Status enter_patiently(Lanes::Pass& pass, const Request& request) {
    const LaneWork lane{Weight::kLong, 2 * kShort_ms, request.client};
    while (pass.enter(lane, request.deadline) != Lanes::Entry::kIn) {
        if (auto over = request.deadline.over()) return over;
        std::this_thread::sleep_for(kLinesAreFull);
    }
    return std::nullopt;
}

Result<Scene> read_job_scene(Service::State& state, const Request& request) {
    const std::size_t bytes = reading_bytes(request.body.size());
    WorkBudget::Lease reading = state.budget.take(bytes);
    while (!reading) {
        if (const auto over = request.deadline.over()) return *over;
        std::this_thread::sleep_for(kLinesAreFull);
        reading = state.budget.take(bytes);
    }
    Lanes::Pass pass(state.lanes);
    if (const Status over = enter_patiently(pass, request)) return *over;
    return read_request_scene(state, request);
}

Response answer_job_work(Service::State& state, const JobWork& work, const Request& request) {
    if (work.kind == "sequence" || work.kind == "fly") return answer_sequence(state, request, work);
    if (work.kind == "impostor") return answer_impostor(state, request, work);
    return answer_scene_request(state, request);
}

}  // namespace awan
