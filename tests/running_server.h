// A server in this process on a free port, with a fake renderer, for one test of the transport.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <utility>

#include "fake_renderer.h"
#include "raw_client.h"
#include "server/http/server.h"

namespace awan::test {

inline constexpr const char* kScene =
    R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],)"
    R"("image":{"width":16,"height":8},"accuracy":{"rung":"harris"}})";

inline std::string many_particles(int count) {
    return R"({"cubes":[{"particles":)" + std::to_string(count) +
           R"(,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
}

class Running {
  public:
    explicit Running(HttpOptions options = {}, std::size_t queue = 4)
        : renderer_thread_(renderer.opener()),
          service_(renderer_thread_, metrics_, options_of(renderer, queue)),
          http_(service_, metrics_, on_free_port(std::move(options))) {
        const Status failed = http_.bind();
        EXPECT_FALSE(failed) << failed->message;
        thread_ = std::thread([this] { http_.run(); });
    }
    ~Running() {
        renderer.release();
        stop();
        join();
    }

    void stop() { http_.stop(); }
    void join() {
        if (thread_.joinable()) thread_.join();
    }
    int port() const { return http_.port(); }
    // POSTs that are answered or wait.
    std::size_t waiting() const { return service_.in_progress(); }
    // POSTs that wait for a lane.
    std::size_t in_line() const { return service_.in_line(); }
    RawClient client() const { return RawClient(port()); }
    Answer ask(const std::string& bytes) const {
        RawClient c = client();
        c.send(bytes);
        return c.read();
    }
    std::string metrics() const { return ask(get("/metrics")).body; }

    FakeRenderer renderer;

  private:
    static ServiceOptions options_of(const FakeRenderer& renderer, std::size_t queue) {
        ServiceOptions options;
        options.lanes.line = queue;
        options.on_processor = renderer.on_processor();
        return options;
    }
    static HttpOptions on_free_port(HttpOptions options) {
        options.port = 0;
        return options;
    }

    Metrics metrics_;
    RenderThread renderer_thread_;
    Service service_;
    HttpServer http_;
    std::thread thread_;
};

// A POST whose headers beyond the first three lines are the test's.
inline std::string with(const std::string& headers, const std::string& body = "") {
    return "POST /v1/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n" +
           headers + "\r\n" + body;
}

}  // namespace awan::test
