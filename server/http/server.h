// HTTP/1.1 on one port: deadlines, budgets, Host and Origin, keep-alive, a graceful stop. What is
// answered is service.h's business; framing is framing.h's; cpp-httplib stays in codec.
//
// One thread polls all connections: it accepts, reads heads and bodies, and answers everything but
// POST itself, since those answers come from memory. A POST goes to a worker only when it is whole.
// So a client that is slow, or silent, costs a few kilobytes and no thread, and /healthz is reached
// however many such clients there are and however long the render queue is. What a client is slow
// to take of an answer waits with its connection, not with a worker.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "server/http/access_log.h"
#include "server/limits.h"
#include "server/service/service.h"

namespace awan {

// Where and how to serve.
struct HttpOptions {
    std::string host = "127.0.0.1";
    // 0: any free port.
    int port = 8080;
    // Threads that answer POSTs, one request each. Most of them wait in the lines for lanes, so there should be more
    // than those have places: else they never fill and everybody waits for a worker.
    std::size_t workers = 3 * limits::kRenderQueue + 8;
    // Names by which clients may call this server (Host header), without port, beside localhost,
    // 127.0.0.1, [::1], `host` and the address they reached. A foreign Host is answered 421: it
    // guards against DNS rebinding.
    std::vector<std::string> allowed_hosts;
    // Origins (scheme://host:port) of pages that may post, beside this server's own. Others get
    // 403.
    std::vector<std::string> allowed_origins;
    // That clients have to show, see access.h; "": none.
    std::string token;
    // Called with every answer, from any thread; see access_log.h. May be empty; must not throw.
    std::function<void(const AccessRecord&)> log;

    // Overridable so that tests need not wait; defaults from limits.h.
    std::size_t max_connections = limits::kMaxConnections;
    std::size_t waiting_requests = limits::kWaitingRequests;
    std::size_t max_body_bytes = limits::kMaxBodyBytes;
    std::size_t max_body_bytes_in_all = limits::kMaxBodyBytesInAll;
    std::size_t requests_per_connection = limits::kRequestsPerConnection;
    std::chrono::milliseconds head_deadline = limits::kHeadDeadline;
    std::chrono::milliseconds idle_deadline = limits::kIdleDeadline;
    std::chrono::milliseconds body_deadline = limits::kBodyDeadline;
    std::chrono::milliseconds write_deadline = limits::kWriteDeadline;
    std::chrono::milliseconds request_deadline = limits::kRequestDeadline;
    std::chrono::milliseconds drain_deadline = limits::kDrainDeadline;
};

// The transport in front of a Service.
class HttpServer {
  public:
    HttpServer(Service& service, Metrics& metrics, HttpOptions options);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    // Binds and listens. Fails with kIo when the port is taken (no second server on one port).
    Status bind();
    // The port it listens on; after bind().
    int port() const;

    // Serves until stop(); then finishes what is in flight (at most drain_deadline), and tells whoever comes meanwhile
    // that it stops. Call from one thread. Throws std::system_error where the system has no thread for it.
    void run();
    // Thread-safe, but not for signal handlers: call it from another thread.
    void stop();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace awan
