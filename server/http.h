// HTTP/1.1 on one port: framing, deadlines, budgets, Host and Origin, keep-alive, a graceful stop.
// http.cpp is the only user of cpp-httplib. What is answered is service.h's business.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "server/limits.h"
#include "server/service.h"

namespace awan {

struct HttpOptions {
    std::string host = "127.0.0.1";
    int port = 8080;          // 0: any free port
    std::size_t workers = 8;  // threads that hold a connection each
    // Names by which clients may call this server (Host header), without port, beside localhost,
    // 127.0.0.1, [::1] and `host`. A foreign Host is answered 421: it guards against DNS rebinding.
    std::vector<std::string> allowed_hosts;
    // Origins (scheme://host:port) of pages that may post, beside this server's own. Others get
    // 403.
    std::vector<std::string> allowed_origins;

    // Overridable so that tests need not wait; defaults from limits.h.
    std::size_t max_body_bytes = limits::kMaxBodyBytes;
    std::chrono::milliseconds head_deadline = limits::kHeadDeadline;
    std::chrono::milliseconds body_deadline = limits::kBodyDeadline;
    std::chrono::milliseconds write_deadline = limits::kWriteDeadline;
    std::chrono::milliseconds request_deadline = limits::kRequestDeadline;
    std::chrono::milliseconds drain_deadline = limits::kDrainDeadline;
};

class HttpServer {
  public:
    HttpServer(Service& service, Metrics& metrics, HttpOptions options);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    // Binds and listens. Fails with kIo when the port is taken (no second server on one port).
    Status bind();
    int port() const;  // after bind()

    // Serves until stop(); then finishes what is in flight (at most drain_deadline). Call from one
    // thread.
    void run();
    // Async-signal-unsafe but thread-safe: call from another thread.
    void stop();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace awan
