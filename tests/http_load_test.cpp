// The transport, through real sockets: clients that are slow, gone or too many,
// and how it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "running_server.h"

namespace awan::test {
namespace {

using namespace std::chrono_literals;

// --- clients that are slow, gone or too many

TEST(SlowClients, DrippedHeadIsCut) {
    HttpOptions options;
    options.head_deadline = 300ms;
    const Running server(options);
    RawClient client = server.client();
    const auto start = Clock::now();
    for (int i = 0; i < 40 && client.send("G"); ++i) std::this_thread::sleep_for(25ms);
    EXPECT_EQ(client.read().status, 408);
    EXPECT_TRUE(client.closes_within(1s));
    EXPECT_LT(Clock::now() - start, 3s);
}

TEST(SlowClients, DrippedBodyIsCut) {
    HttpOptions options;
    options.body_deadline = 300ms;
    const Running server(options);
    RawClient client = server.client();
    client.send(with("Content-Length: 1000\r\n"));
    for (int i = 0; i < 20 && client.send(" "); ++i) std::this_thread::sleep_for(25ms);
    EXPECT_EQ(client.read().status, 408);
    EXPECT_TRUE(client.closes_within(3s));
}

TEST(SlowClients, SilentAndIdleOnesAreCutWithoutAWord) {
    HttpOptions options;
    options.head_deadline = 200ms;
    options.idle_deadline = 200ms;
    const Running server(options);
    RawClient silent = server.client();
    RawClient idle = server.client();
    idle.send(get("/healthz"));
    EXPECT_EQ(idle.read().status, 200);
    EXPECT_EQ(silent.rest(), "");
    EXPECT_EQ(idle.rest(), "");
}

TEST(SlowClients, OneThatDoesNotReadIsCut) {
    HttpOptions options;
    options.write_deadline = 300ms;
    const Running server(options);
    RawClient client(server.port(), 4096);
    client.send(post("/v1/particles", many_particles(100'000)));  // more than sockets hold
    EXPECT_TRUE(eventually([&] {
        return server.metrics().find("refused_total{reason=\"timeout\"} 1") != std::string::npos;
    }));
    EXPECT_EQ(client.read().status, 0) << "the answer was cut, so it must not look whole";
}

TEST(SlowClients, DoNotStandBeforeHealth) {
    Running server({}, 2);
    server.renderer.hold();
    std::vector<RawClient> slow;
    for (int i = 0; i < 40; ++i) slow.push_back(server.client());
    for (RawClient& client : slow) client.send("GET / HTTP/1.1\r\nHost: loc");
    std::vector<RawClient> bodies;
    for (int i = 0; i < 40; ++i) bodies.push_back(server.client());
    for (RawClient& client : bodies) client.send(with("Content-Length: 1000\r\n", "{"));
    std::vector<RawClient> renders;
    for (int i = 0; i < 3; ++i) renders.push_back(server.client());
    for (RawClient& client : renders) client.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.in_line() == 2; })) << "one is drawn";
    EXPECT_EQ(server.ask(post("/v1/render", kScene)).status, 429);

    const auto start = Clock::now();
    for (const char* path : {"/healthz", "/readyz", "/metrics", "/version", "/v1/presets"})
        EXPECT_EQ(server.ask(get(path)).status, 200) << path;
    EXPECT_EQ(server.ask(post("/v1/plan", kScene)).status, 200);
    EXPECT_LT(Clock::now() - start, 1s);
}

TEST(Connections, MakeRoomForNewOnes) {
    HttpOptions options;
    options.max_connections = 4;
    const Running server(options);
    std::vector<RawClient> idle;
    for (int i = 0; i < 4; ++i) idle.push_back(server.client());
    EXPECT_EQ(server.ask(get("/healthz")).status, 200);
    EXPECT_TRUE(idle[0].closes_within(1s)) << "the one that waited longest goes";
}

TEST(Connections, SlowBodiesMakeRoomToo) {
    HttpOptions options;
    options.max_connections = 4;
    const Running server(options);
    std::vector<RawClient> stuck;
    for (int i = 0; i < 4; ++i) {
        stuck.push_back(server.client());
        stuck.back().send(with("Content-Length: 1000\r\n", std::string(i == 2 ? 1u : 500u, ' ')));
    }
    // Until all of their heads have been read.
    std::this_thread::sleep_for(200ms);
    const auto start = Clock::now();
    EXPECT_EQ(server.ask(get("/healthz")).status, 200) << "a few places are left for this";
    EXPECT_LT(Clock::now() - start, 2s);
    std::this_thread::sleep_for(600ms);
    EXPECT_EQ(server.ask(post("/v1/plan", kScene)).status, 200);
    EXPECT_TRUE(stuck[2].closes_within(1s)) << "the slowest goes";
    EXPECT_FALSE(stuck[0].closes_within(100ms));
}

TEST(Connections, HealthIsAnsweredBesideSilentOnesThatHaveNoPlace) {
    HttpOptions options;
    options.max_connections = 4;
    const Running server(options);
    std::vector<RawClient> clients;
    for (int i = 0; i < 4; ++i) {
        clients.push_back(server.client());
        clients.back().send(with("Content-Length: 1000\r\n", "{"));
    }
    // Until their heads have been read; they have just come, so that none of them makes room.
    std::this_thread::sleep_for(50ms);
    for (int i = 0; i < 60; ++i) clients.push_back(server.client());
    EXPECT_EQ(server.ask(get("/healthz")).status, 200);
}

// As many as there is room for and more, each opened anew when it is closed; tests/bench/stuck.sh has a thousand.
TEST(Connections, HealthIsAnsweredBesideBodiesThatAreStuck) {
    constexpr std::size_t kPlaces = 100;
    HttpOptions options;
    options.max_connections = kPlaces;
    const Running server(options);
    const auto stuck_one = [&] {
        auto client = std::make_unique<RawClient>(server.port());
        client->send(with("Content-Length: 1000\r\n", "{"));
        return client;
    };
    std::vector<std::unique_ptr<RawClient>> stuck;
    for (std::size_t i = 0; i < kPlaces + 50; ++i) stuck.push_back(stuck_one());
    std::vector<double> seconds;
    for (std::size_t i = 0; i < 200; ++i) {
        stuck[i % stuck.size()] = stuck_one();
        const auto start = Clock::now();
        ASSERT_EQ(server.ask(get(i % 2 == 0 ? "/healthz" : "/metrics")).status, 200) << i;
        seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    std::sort(seconds.begin(), seconds.end());
    EXPECT_LT(seconds[197], 2) << "it was 31 s once";
}

TEST(Connections, TooManyAtWorkAreRefused) {
    HttpOptions options;
    options.max_connections = 2;
    Running server(options);
    server.renderer.hold();
    RawClient first = server.client();
    RawClient second = server.client();
    first.send(post("/v1/render", kScene));
    second.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.waiting() == 2; }));
    const Answer refused = server.ask(get("/v1/presets"));
    EXPECT_EQ(refused.status, 503);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    for (const char* path : {"/healthz", "/readyz", "/metrics"})
        EXPECT_EQ(server.ask(get(path)).status, 200) << path;
    server.renderer.release();
    EXPECT_EQ(first.read().status, 200);
    EXPECT_EQ(second.read().status, 200);
}

TEST(Queue, IsRefusedWhenFullWithATimeToComeAgain) {
    Running server({}, 1);
    server.renderer.hold();
    RawClient running = server.client();
    RawClient waiting = server.client();
    running.send(post("/v1/render", kScene));
    waiting.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.in_line() == 1; }));
    RawClient third = server.client();
    third.send(post("/v1/render", kScene));
    const Answer refused = third.read();
    EXPECT_EQ(refused.status, 429);
    EXPECT_GE(std::stoi(refused.header("Retry-After")), 1);
    server.renderer.release();
    EXPECT_EQ(running.read().status, 200);
    EXPECT_EQ(waiting.read().status, 200);
    third.send(post("/v1/render", kScene));  // the refusal left the connection as it was
    EXPECT_EQ(third.read().status, 200);
}

TEST(Queue, OfRequestsIsBoundedToo) {
    HttpOptions options;
    options.workers = 1;
    options.waiting_requests = 1;
    Running server(options);
    server.renderer.hold();
    RawClient running = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    RawClient waiting = server.client();
    waiting.send(post("/v1/plan", kScene));
    EXPECT_TRUE(eventually([&] { return server.ask(post("/v1/plan", kScene)).status == 429; }));
    server.renderer.release();
    EXPECT_EQ(running.read().status, 200);
    EXPECT_EQ(waiting.read().status, 200);
}

TEST(Queue, PassedDeadlineIs504) {
    HttpOptions options;
    options.request_deadline = 200ms;
    Running server(options);
    server.renderer.hold();
    RawClient running = server.client();
    RawClient waiting = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    waiting.send(post("/v1/render", kScene));
    EXPECT_EQ(running.read().status, 504);
    EXPECT_EQ(waiting.read().status, 504);
}

TEST(GoneClients, FreeTheirPlaces) {
    Running server;
    server.renderer.hold();
    RawClient running = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    RawClient waiting = server.client();
    waiting.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.waiting() == 2; }));
    waiting.close();
    EXPECT_TRUE(eventually([&] { return server.waiting() == 1; }));
    EXPECT_EQ(server.renderer.begun(), 1) << "it was dropped while it waited";
    running.close();
    EXPECT_TRUE(eventually([&] { return server.waiting() == 0; }));
    EXPECT_EQ(server.renderer.cancelled(), 1) << "it was cancelled while it ran";
}

// The answer, past an interim one by which the server finds out whether the client has gone.
Answer final_answer(RawClient& client) {
    Answer answer = client.read();
    return answer.status == 100 ? client.read() : answer;
}

// A client that has sent its request may close its side and wait: it has not gone.
TEST(GoneClients, AreNotThoseThatOnlySayTheyHaveSentAll) {
    Running server;
    server.renderer.hold();
    RawClient client = server.client();
    client.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    client.close_sending();
    std::this_thread::sleep_for(100ms);
    server.renderer.release();
    EXPECT_EQ(final_answer(client).status, 200);
    EXPECT_TRUE(client.closes_within(1s));
    EXPECT_EQ(server.renderer.cancelled(), 0);

    RawClient at_once = server.client();
    at_once.send(post("/v1/plan", kScene));
    at_once.close_sending();
    EXPECT_EQ(final_answer(at_once).status, 200);
}

// What it sent before it closed its side may hold more requests than the one that is at work.
TEST(GoneClients, AreAnsweredAllThatTheyHaveSent) {
    Running server;
    server.renderer.hold();
    RawClient client = server.client();
    client.send(post("/v1/render", kScene) + get("/healthz"));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    client.send(post("/v1/plan", kScene));
    client.close_sending();
    std::this_thread::sleep_for(100ms);
    server.renderer.release();
    EXPECT_EQ(final_answer(client).status, 200);
    EXPECT_EQ(client.read().body, "ok\n");
    EXPECT_EQ(final_answer(client).status, 200);
    EXPECT_TRUE(client.closes_within(1s));
}

TEST(SlowClients, AreAnsweredBehindWhatTheyTookLongToRead) {
    const Running server;
    RawClient client(server.port(), 4096);
    client.send(post("/v1/particles", many_particles(100'000)) + get("/healthz"));
    std::this_thread::sleep_for(300ms);  // until the rest of the answer waits in the server
    EXPECT_EQ(client.read().status, 200);
    EXPECT_EQ(client.read().body, "ok\n");
}

TEST(GoneClients, AreNoFailuresOfTheServer) {
    Running server;
    server.renderer.hold();
    RawClient client = server.client();
    client.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    client.close();
    EXPECT_TRUE(eventually([&] { return server.waiting() == 0; }));
    const std::string text = server.metrics();
    EXPECT_NE(text.find("{route=\"/v1/render\",status=\"499\"} 1"), std::string::npos) << text;
    EXPECT_EQ(text.find("status=\"50"), std::string::npos);
}

// --- starting and stopping

TEST(Listening, SecondServerOnOnePortIsRefused) {
    const Running server;
    Metrics metrics;
    RenderThread renderer(FakeRenderer().opener());
    Service service(renderer, metrics, {});
    HttpOptions options;
    options.port = server.port();
    HttpServer second(service, metrics, options);
    const Status failed = second.bind();
    ASSERT_TRUE(failed);
    EXPECT_EQ(failed->code, ErrorCode::kIo);
    EXPECT_NE(failed->message.find("taken"), std::string::npos) << failed->message;
    EXPECT_NE(failed->message.find(std::to_string(server.port())), std::string::npos);
}

TEST(Listening, UnknownHostIsRefused) {
    Metrics metrics;
    RenderThread renderer(FakeRenderer().opener());
    Service service(renderer, metrics, {});
    HttpOptions options;
    options.host = "no such host";
    HttpServer server(service, metrics, options);
    EXPECT_TRUE(server.bind());
}

TEST(Stopping, FinishesWhatIsInFlightAndRefusesTheRest) {
    Running server;
    server.renderer.hold();
    RawClient kept = server.client();
    kept.send(get("/healthz"));
    EXPECT_EQ(kept.read().status, 200);
    RawClient running = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    RawClient waiting = server.client();
    waiting.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.waiting() == 2; }));

    server.stop();
    EXPECT_TRUE(eventually([&] { return server.ask(get("/readyz")).status == 503; }));
    const Answer refused = server.ask(post("/v1/plan", kScene));
    EXPECT_EQ(refused.status, 503) << "who comes now is told to go elsewhere";
    EXPECT_FALSE(refused.header("Retry-After").empty());
    kept.send(get("/healthz"));
    const Answer health = kept.read();
    EXPECT_EQ(health.status, 200);
    EXPECT_EQ(health.header("Connection"), "close");

    server.renderer.release();
    EXPECT_EQ(running.read().status, 200);
    EXPECT_EQ(waiting.read().status, 200) << "it had begun before the stop";
    server.join();
}

TEST(Stopping, NewWorkOnKeptConnectionsIs503) {
    Running server;
    server.renderer.hold();
    RawClient kept = server.client();
    kept.send(get("/healthz"));
    EXPECT_EQ(kept.read().status, 200);
    RawClient ready = server.client();
    ready.send(get("/healthz"));
    EXPECT_EQ(ready.read().status, 200);
    RawClient running = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    server.stop();
    EXPECT_TRUE(eventually([&] { return server.ask(get("/readyz")).status == 503; }));
    kept.send(post("/v1/plan", kScene));
    const Answer refused = kept.read();
    EXPECT_EQ(refused.status, 503);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    EXPECT_EQ(refused.header("Connection"), "close");
    ready.send(get("/readyz"));
    EXPECT_EQ(ready.read().status, 503);
    server.renderer.release();
    EXPECT_EQ(running.read().status, 200);
}

TEST(Stopping, WaitsNoLongerThanItsDeadline) {
    HttpOptions options;
    options.drain_deadline = 200ms;
    Running server(options);
    server.renderer.hold();
    RawClient running = server.client();
    running.send(post("/v1/render", kScene));
    ASSERT_TRUE(eventually([&] { return server.renderer.begun() == 1; }));
    const auto start = Clock::now();
    server.stop();
    server.join();
    EXPECT_LT(Clock::now() - start, 3s);
    EXPECT_EQ(server.renderer.cancelled(), 1);
}

}  // namespace
}  // namespace awan::test
