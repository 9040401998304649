// Request -> response: routing, content types, statuses, headers. No sockets (server/http.h) and no
// GL.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/deadline.h"
#include "server/metrics.h"
#include "server/render_thread.h"

namespace awan {

struct Request {
    std::string method;  // upper case
    std::string path;    // decoded, without the query
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;
    std::string id;     // X-Request-Id: the client's if it is 1..128 of [A-Za-z0-9._-], else made
    Deadline deadline;  // its `cancelled` becomes true when the client goes away

    std::string_view header(std::string_view name) const;  // "" when absent; names ignore case
};

struct Response {
    int status = 200;
    std::vector<std::pair<std::string, std::string>> headers;  // without Content-Length
    std::string body;
    // Instead of `body`: appends the next piece to its argument; false when that was the last. Must
    // not throw.
    std::function<bool(std::string& piece)> stream;
};

struct ServiceOptions {
    int threads = 1;  // for generate and survey of one request
};

class Service {
  public:
    Service(RenderThread& renderer, Metrics& metrics, ServiceOptions options);

    // Thread-safe. Never throws: a bug inside becomes a 500 without details of the exception.
    Response answer(const Request& request);

    // From now on /readyz says 503 and new work is refused with 503 + Retry-After; health and what
    // has begun go on.
    void drain();

  private:
    RenderThread& renderer_;
    Metrics& metrics_;
    ServiceOptions options_;
    std::atomic<bool> draining_{false};
};

}  // namespace awan
