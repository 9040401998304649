// Request -> response: routing, content types, statuses, headers. No sockets (server/http/server.h) and no GL.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/deadline.h"
#include "core/base/progress.h"
#include "server/limits.h"
#include "server/service/disk_cache.h"
#include "server/service/lanes.h"
#include "server/service/metrics.h"
#include "server/service/render_thread.h"

namespace awan {

// A request as the transport has understood it.
struct Request {
    // In upper case.
    std::string method;
    // Decoded, without the query.
    std::string path;
    // Decoded names and values.
    std::vector<std::pair<std::string, std::string>> query;
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;
    // The id that is echoed in X-Request-Id: the client's if it is 1..128 of [A-Za-z0-9._-], else a new one.
    std::string id;
    // Its `cancelled` becomes true when the client goes away.
    Deadline deadline;
    // How far it has come, for whoever watches. May be empty.
    Progress progress;
    // Whose turn it is (server/service/lanes.h): the client's address.
    std::string client;
    // It came before the server began to drain, and is finished.
    bool admitted = false;

    // "" when absent; names ignore case.
    std::string_view header(std::string_view name) const;
};

// An answer for the transport to write.
struct Response {
    int status = 200;
    // Content-Length is not among them; the transport adds it.
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;
    // Instead of `body`: bytes that are kept for others too, so that however many take them at once, they stand in
    // memory once. Not empty.
    std::shared_ptr<const std::string> shared;
    // Instead of both: appends the next piece to its argument; false when that was the last. Must
    // not throw.
    std::function<bool(std::string& piece)> stream;
    // Nobody waits for it any more: it need not be written.
    bool abandoned = false;
    // Of the metrics and the log: the route's pattern; what each stage took, ms; why there is no other answer ("").
    std::string_view route = "other";
    std::vector<std::pair<const char*, double>> stages;
    std::string_view reason;

    // Of `body` or `shared`; "" of a stream.
    std::string_view bytes() const { return shared ? *shared : body; }
    // From now on, what is in `body` is shared.
    void share();
    // "" when absent; names ignore case.
    std::string_view header(std::string_view name) const;
};

// How much the service may do at once.
struct ServiceOptions {
    // Threads of one request, for generate, survey, and the rungs without a device.
    int threads = 1;
    // Scales the times that are predicted.
    MachineSpeed speed;
    // Of the requests that compute. The renderer has a line of its own, as long.
    LanesOptions lanes;
    // See server/service/work_budget.h.
    std::size_t work_bytes = limits::kWorkBytes;
    // Of answers that are kept; see server/service/result_cache.h.
    std::size_t cache_bytes = 0;
    // Where answers are kept beyond that; null: nowhere.
    std::shared_ptr<DiskCache> disk;
    // Renders what needs no device; empty: processor_renderer().
    RenderOnProcessor on_processor;
    // Jobs that run at once, each in lanes as any request.
    std::size_t jobs = 2;
};

// Answers requests.
class Service {
  public:
    Service(RenderThread& renderer, Metrics& metrics, ServiceOptions options);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    // Thread-safe. Never throws: a bug inside becomes a 500 without details of the exception.
    // Anything but POST is answered from memory and never waits for a render or another request; but what
    // waits_for_events says is a stream that waits for what it tells.
    Response answer(const Request& request);
    static bool waits_for_events(std::string_view target);

    // What answer() would say whatever the body is: for clients that ask before they send it
    // (Expect: 100-continue) or announce a long one. Nothing: the body is wanted.
    std::optional<Response> refuse(const Request& request);

    // From now on /readyz says 503 and new work is refused with 503 + Retry-After; health and what
    // has begun go on.
    void drain();

    // What the page is made of, and the contract: the same for everyone. A browser fetches it before it can show a
    // token.
    std::vector<std::string> page_paths() const;

    // When a client that was refused for load may come again, seconds.
    int retry_after_seconds() const;

    // How many POSTs are being answered, waiting ones among them.
    std::size_t in_progress() const;
    // How many of these wait for a lane.
    std::size_t in_line() const;

    struct State;

  private:
    std::unique_ptr<State> state_;
};

}  // namespace awan
