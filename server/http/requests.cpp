// From received bytes to a request, and from its answer to sent bytes.
#include <malloc.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "server/http/state.h"
#include "server/service/problem.h"

namespace awan {

using Clock = Connection::Clock;

namespace {

bool asks_for_health(const RequestHead& head) {
    return head.method != "POST" &&
           (head.target == "/healthz" || head.target == "/readyz" || head.target == "/metrics");
}

}  // namespace

// --- A request comes in

void HttpServer::State::advance(Connection& c) {
    while (c.socket.get() >= 0 && c.stand == Stand::kHead && !c.in.empty()) {
        const HeadEnd head_end = find_head_end(c.in, c.scanned);
        if (head_end.error)
            return refuse(c, head_end.error->status, head_end.error->detail, "framing");
        if (!head_end.bytes) return;
        ParsedHead parsed = parse_head(std::string_view(c.in).substr(0, *head_end.bytes));
        c.in.erase(0, *head_end.bytes);
        if (parsed.error) return refuse(c, parsed.error->status, parsed.error->detail, "framing");
        c.head = std::move(parsed.head);
        begin_request(c);
    }
}

void HttpServer::State::begin_request(Connection& c) {
    AccessRules here = rules;
    here.hosts.push_back(c.local_address);
    if (const auto error = check_access(c.head, here))
        return refuse(c, error->status, error->detail, "access");
    if (c.in_reserve && !asks_for_health(c.head))
        return refuse(c, 503, "there are too many connections", "connections");
    if (c.head.content_length > options.max_body_bytes)
        return refuse(
            c, 413, "the body is longer than " + std::to_string(options.max_body_bytes) + " bytes",
            "framing");
    c.body.clear();
    c.gone = std::make_shared<std::atomic<bool>>(false);
    c.voice = Connection::Voice::kNone;
    c.admitted = !draining;
    if (c.head.expects_continue || c.head.content_length > kLongBody) {
        std::optional<Response> refused;
        // The body may or may not follow: nobody could tell what comes next.
        c.close_after = true;
        answer_here(c, [&](const Request& request) {
            refused = service.refuse(request);
            if (refused) return *refused;
            Response nothing;
            nothing.abandoned = true;
            return nothing;
        });
        if (refused) return;
    }
    begin_body(c);
}

void HttpServer::State::begin_body(Connection& c) {
    const std::size_t here = std::min(c.in.size(), c.head.content_length);
    c.body.assign(c.in, 0, here);
    c.in.erase(0, here);
    c.stand = Stand::kBody;
    c.body_since = Clock::now();
    c.until = c.body_since + options.body_deadline;
    if (c.head.expects_continue && here == 0) {
        c.out += "HTTP/1.1 100 Continue\r\n\r\n";
        if (!send_unsent(c, parked)) return end(c);
    }
    charge_body(c, here);
    if (c.stand == Stand::kBody && c.body.size() == c.head.content_length) dispatch(c);
}

// Counts received bytes, not announced ones: a client that announces much and sends nothing must
// not keep others out. Short bodies always get in.
void HttpServer::State::charge_body(Connection& c, std::size_t bytes) {
    c.body_charged += bytes;
    body_bytes += bytes;
    if (body_bytes > options.max_body_bytes_in_all && c.body.size() > limits::kFreeBodyBytes)
        refuse(c, 429, "too much is being received at once", "memory");
}

void HttpServer::State::dispatch(Connection& c) {
    c.stand = Stand::kWorking;
    c.read_at = Clock::now();
    c.close_after = !c.head.keep_alive || ++c.served >= options.requests_per_connection ||
                    draining || c.in_reserve;
    if (c.head.method != "POST" && c.head.method != "PUT" &&
        !Service::waits_for_events(c.head.target))
        return taken_back(c, answer(c, codec, true));
    c.with_worker = workers->push(&c);
    if (c.with_worker) return;
    metrics.connection_refused("requests");
    const int seconds = service.retry_after_seconds();
    answer_here(c, [&](const Request& request) {
        Response response = problem_retry(429, "too many requests wait", seconds, request.id);
        response.reason = "queue full";
        metrics.request_done("other", response.status, 0);
        return response;
    });
}

// --- An answer goes out

void HttpServer::State::log(const Connection& c, const Response& response, std::string_view id,
                            std::size_t bytes_in) {
    if (!options.log) return;
    const std::chrono::duration<double> wall = std::chrono::system_clock::now().time_since_epoch();
    AccessRecord record;
    record.time = wall.count();
    record.client = c.client;
    record.id = id;
    record.method = c.head.method;
    record.target = c.head.target;
    record.route = response.route;
    record.status = response.status;
    record.bytes_in = bytes_in;
    record.bytes_out = response.bytes().size();
    if (c.stand == Stand::kWorking)
        record.seconds = std::chrono::duration<double>(Clock::now() - c.read_at).count();
    record.stages = &response.stages;
    record.reason = response.reason;
    options.log(record);
}

// What a worker does with a request. It tells the thread that polls whatever happens.
void HttpServer::State::answer_on_worker(Connection& c, HttpCodec& with) noexcept {
    const bool long_body = c.body.size() > kLongBody;
    try {
        c.alive = answer(c, with, false);
    } catch (const std::exception&) {
        c.alive = false;
    }
    // What a long document was read into is many small pieces, in heaps that glibc would keep.
    if (long_body) malloc_trim(0);
    {
        const std::lock_guard lock(done_mutex);
        c.done_before = std::exchange(done, &c);
    }
    const std::uint64_t one = 1;
    // A failed write means that the pipe is full: the thread is awake already.
    if (write(wake.get(), &one, sizeof one) < 0) return;
}

// Answers the connection's request, on the thread that polls (`here`) or on a worker.
bool HttpServer::State::answer(Connection& c, HttpCodec& with, bool here) {
    Request request;
    request.deadline = {c.read_at + options.request_deadline, c.gone};
    request.admitted = c.admitted;
    request.client = c.client;
    const std::string_view origin = allowed_foreign_origin(c.head, rules);
    Clock::time_point until = Clock::now() + options.request_deadline + options.write_deadline;
    ConnectionSink sink(c, parked, here, until);
    const bool whole = with.exchange(
        c.head, std::move(c.body), std::move(request), c.close_after,
        [&](const Request& r) {
            Response response = service.answer(r);
            log(c, response, r.id, r.body.size());
            begin_answer(c);
            // Each event leaves when it happens.
            if (response.header("Content-Type") == "text/event-stream") sink.gather_nothing();
            if (!origin.empty()) {
                response.headers.emplace_back("Access-Control-Allow-Origin", origin);
                response.headers.emplace_back("Access-Control-Expose-Headers", "*");
                response.headers.emplace_back("Vary", "Origin");
                if (r.method == "OPTIONS") {
                    response.headers.emplace_back("Access-Control-Allow-Methods",
                                                  response.header("Allow"));
                    response.headers.emplace_back(
                        "Access-Control-Allow-Headers",
                        "Accept, Authorization, Content-Type, Idempotency-Key, "
                        "If-None-Match, X-Request-Id");
                }
            }
            return response;
        },
        sink);
    return whole && sink.flush();
}

// An answer made on the spot, with the connection's head still to be echoed.
void HttpServer::State::answer_here(Connection& c, const HttpCodec::Answer& what) {
    ConnectionSink sink(c, parked, true, Clock::time_point::max());
    bool abandoned = false;
    const bool alive = codec.exchange(
                           c.head, {}, Request{}, c.close_after,
                           [&](const Request& request) {
                               Response response = what(request);
                               abandoned = response.abandoned;
                               if (!abandoned) log(c, response, request.id, 0);
                               return response;
                           },
                           sink) &&
                       sink.flush();
    if (!abandoned) taken_back(c, alive);
}

// The last answer on a connection: what follows on it cannot be trusted or is not wanted.
void HttpServer::State::refuse(Connection& c, int status, std::string_view detail,
                               std::string_view reason) {
    metrics.connection_refused(reason);
    metrics.request_done("other", status, 0);
    const std::string id = request_id_from(c.head.header("X-Request-Id"));
    Response response = problem(status, detail, "", id);
    response.reason = reason;
    show_problem(c.head.header("Accept"), response);
    log(c, response, id, 0);
    if (status == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
    if (status == 429 || status == 503)
        response.headers.emplace_back("Retry-After", std::to_string(service.retry_after_seconds()));
    c.close_after = true;
    ConnectionSink sink(c, parked, true, Clock::time_point::max());
    taken_back(c, codec.refuse(response, sink) && sink.flush());
}

void HttpServer::State::taken_back(Connection& c, bool alive) {
    body_bytes -= std::exchange(c.body_charged, 0);
    c.body = {};
    if (!alive) return end(c);
    c.stand = Stand::kWriting;
    c.until = Clock::now() + options.write_deadline;
    if (!c.unsent()) written(c);
}

void HttpServer::State::written(Connection& c) {
    const auto now = Clock::now();
    // More requests may have come before the client closed its side; that they end is found out by reading.
    c.half_closed = false;
    if (c.close_after) {
        shutdown(c.socket.get(), SHUT_WR);
        c.stand = Stand::kLingering;
        c.until = now + limits::kLingerDeadline;
        return;
    }
    c.stand = Stand::kHead;
    c.head = {};
    c.since = now;
    c.until = now + (c.in.empty() ? options.idle_deadline : options.head_deadline);
}

}  // namespace awan
