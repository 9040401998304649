// The transport, through real sockets: what it refuses, and what it answers.
#include <gtest/gtest.h>

#include <thread>

#include "running_server.h"

namespace awan::test {
namespace {

using namespace std::chrono_literals;

// --- framing: whatever two parsers might read differently is refused, and the connection closed,
// so that the request hidden behind it is never answered.

struct Attack {
    const char* name;
    std::string bytes;
    int status;
};

class Refuses : public testing::TestWithParam<Attack> {};

TEST_P(Refuses, AndClosesAndAnswersNothingElse) {
    const Running server;
    RawClient client = server.client();
    client.send(GetParam().bytes + get("/version"));
    const Answer answer = client.read();
    EXPECT_EQ(answer.status, GetParam().status) << answer.body;
    EXPECT_EQ(answer.header("Content-Type"), "application/problem+json");
    EXPECT_EQ(answer.header("Connection"), "close");
    EXPECT_FALSE(answer.header("X-Request-Id").empty());
    EXPECT_NE(answer.body.find("\"status\":" + std::to_string(GetParam().status)),
              std::string::npos);
    EXPECT_EQ(client.rest(), "") << "a second request was answered";
}

INSTANTIATE_TEST_SUITE_P(
    Framing, Refuses,
    testing::Values(
        Attack{"LengthAndChunked",
               with("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n", "0\r\n\r\n"), 400},
        Attack{"ChunkedAndLength",
               with("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n", "0\r\n\r\n"), 400},
        Attack{"Chunked", with("Transfer-Encoding: chunked\r\n", "0\r\n\r\n"), 411},
        Attack{"NotQuiteChunked", with("Transfer-Encoding: xchunked\r\n", "0\r\n\r\n"), 400},
        Attack{"ChunkedTwice", with("Transfer-Encoding: chunked, chunked\r\n", "0\r\n\r\n"), 400},
        Attack{"TwoTransferEncodings",
               with("Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n"), 400},
        Attack{"NoLength", with(""), 411},
        Attack{"TwoLengths", with("Content-Length: 2\r\nContent-Length: 3\r\n", "{}"), 400},
        Attack{"TheSameLengthTwice", with("Content-Length: 2\r\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"ListOfLengths", with("Content-Length: 2, 2\r\n", "{}"), 400},
        Attack{"PlusLength", with("Content-Length: +2\r\n", "{}"), 400},
        Attack{"NegativeLength", with("Content-Length: -2\r\n", "{}"), 400},
        Attack{"HexLength", with("Content-Length: 0x2\r\n", "{}"), 400},
        Attack{"LettersInLength", with("Content-Length: 2a\r\n", "{}"), 400},
        Attack{"SpaceInLength", with("Content-Length: 1 2\r\n", "{}"), 400},
        Attack{"EmptyLength", with("Content-Length: \r\n", "{}"), 400},
        Attack{"LengthOverflow", with("Content-Length: 18446744073709551618\r\n", "{}"), 413},
        Attack{"BodyTooLong", with("Content-Length: 99999999999\r\n", "{}"), 413},
        Attack{"SpaceBeforeColon", with("Content-Length : 2\r\n", "{}"), 400},
        Attack{"FoldedHeader", with("X-A: b\r\n c: d\r\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"HeaderWithoutColon", with("nonsense\r\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"HeaderWithoutName", with(": x\r\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"BareLineFeed", with("X-A: b\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"BareCarriageReturn", with("X-A: b\rContent-Length: 2\r\n", "{}"), 400},
        Attack{"NulInHead", with(std::string("X-A: \0\r\n", 8) + "Content-Length: 2\r\n", "{}"),
               400},
        Attack{"ControlInHeader", with("X-A: \x01\r\nContent-Length: 2\r\n", "{}"), 400},
        Attack{"CompressedBody", with("Content-Encoding: br\r\nContent-Length: 2\r\n", "{}"), 415},
        Attack{"UnknownExpectation", with("Expect: miracle\r\nContent-Length: 2\r\n", "{}"), 417},
        Attack{"BodyOnGet",
               "GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\n{}", 400},
        Attack{"BodyOnHead",
               "HEAD /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\n{}", 400},
        Attack{"NoHost", "GET /healthz HTTP/1.1\r\n\r\n", 400},
        Attack{"TwoHosts", "GET /healthz HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n",
               400},
        Attack{"HostWithPath", "GET /healthz HTTP/1.1\r\nHost: localhost/x\r\n\r\n", 400},
        Attack{"AbsoluteTargetOfAnotherHost",
               "GET http://evil.example/healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"Http2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400},
        Attack{"Http09", "GET /healthz\r\n\r\n", 400},
        Attack{"UnknownVersion", "GET /healthz HTTP/1.2\r\nHost: localhost\r\n\r\n", 400},
        Attack{"LowerCaseVersion", "GET /healthz http/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"TwoSpaces", "GET  /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"SpaceInTarget", "GET /a b HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"RelativeTarget", "GET healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"RawByteInTarget", "GET /\xff HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"Tls", std::string("\x16\x03\x01\x02\x00\x01\x00", 7), 400},
        Attack{"EmptyLineFirst", "\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
        Attack{"UnknownMethod", "BREW /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", 501},
        Attack{"Connect", "CONNECT example.org:443 HTTP/1.1\r\nHost: example.org:443\r\n\r\n", 501},
        Attack{"LongTarget",
               "GET /" + std::string(3000, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n", 414},
        Attack{"EndlessTarget", "GET /" + std::string(40'000, 'a'), 414},
        Attack{"LongHead", "GET / HTTP/1.1\r\nHost: localhost\r\nX-A: " + std::string(40'000, 'a'),
               431},
        Attack{"ForeignHost", "GET /healthz HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421},
        Attack{"ForeignHostWithOurPort",
               "GET /healthz HTTP/1.1\r\nHost: localhost.evil.example:8080\r\n\r\n", 421},
        Attack{"ForeignOrigin", with("Origin: http://evil.example\r\nContent-Length: 2\r\n", "{}"),
               403},
        Attack{"NullOrigin", with("Origin: null\r\nContent-Length: 2\r\n", "{}"), 403},
        Attack{"OriginOfAnotherPort",
               with("Origin: http://localhost:1\r\nContent-Length: 2\r\n", "{}"), 403}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Refusing, MoreThanAHundredHeaders) {
    const Running server;
    std::string headers;
    for (int i = 0; i < 101; ++i) headers += "X-" + std::to_string(i) + ": a\r\n";
    EXPECT_EQ(server.ask(get("/healthz", headers)).status, 431);
}

TEST(Refusing, AHundredHeadersAreNotTooMany) {
    const Running server;
    const auto status = [&](int count) {
        // Lines between the request line and the empty one.
        const std::string plain = get("/healthz");
        auto lines = std::count(plain.begin(), plain.end(), '\n') - 2;
        std::string headers;
        for (; lines < count; ++lines) headers += "X-" + std::to_string(lines) + ": a\r\n";
        return server.ask(get("/healthz", headers)).status;
    };
    EXPECT_EQ(status(100), 200);
    EXPECT_EQ(status(101), 431);
}

// --- what is allowed

TEST(Access, OwnHostsAndOriginsPass) {
    HttpOptions options;
    options.allowed_hosts = {"clouds.example"};
    options.allowed_origins = {"https://studio.example"};
    const Running server(options);
    for (const char* host : {"localhost", "LOCALHOST:80", "127.0.0.1:1", "[::1]:8080",
                             "clouds.example", "Clouds.Example:443"})
        EXPECT_EQ(
            server.ask("GET /healthz HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n").status,
            200)
            << host;
    EXPECT_EQ(server.ask(post("/v1/plan", kScene, "Origin: http://localhost\r\n")).status, 200);
    const Answer foreign =
        server.ask(post("/v1/plan", kScene, "Origin: https://studio.example\r\n"));
    EXPECT_EQ(foreign.status, 200);
    EXPECT_EQ(foreign.header("Access-Control-Allow-Origin"), "https://studio.example");
    const Answer preflight = server.ask(
        "OPTIONS /v1/plan HTTP/1.1\r\nHost: localhost\r\nOrigin: https://studio.example\r\n\r\n");
    EXPECT_EQ(preflight.status, 204);
    EXPECT_EQ(preflight.header("Access-Control-Allow-Methods"), "POST, OPTIONS");
    // Reading is safe, whatever page asks: it is not told that it may see the answer.
    const Answer read = server.ask(get("/healthz", "Origin: http://evil.example\r\n"));
    EXPECT_EQ(read.status, 200);
    EXPECT_EQ(read.header("Access-Control-Allow-Origin"), "");
}

TEST(Access, AbsoluteTargetIsUnderstood) {
    const Running server;
    EXPECT_EQ(server.ask("GET http://localhost/healthz HTTP/1.1\r\nHost: localhost\r\n\r\n").status,
              200);
}

TEST(KeepAlive, RequestsFollowOneAnother) {
    const Running server;
    RawClient client = server.client();
    for (int i = 0; i < 5; ++i) {
        client.send(post("/v1/plan", kScene));
        EXPECT_EQ(client.read().status, 200);
        client.send(get("/healthz"));
        EXPECT_EQ(client.read().body, "ok\n");
    }
}

TEST(KeepAlive, PipelinedRequestsAreAnsweredInOrder) {
    const Running server;
    RawClient client = server.client();
    client.send(get("/healthz") + post("/v1/plan", kScene) + get("/nowhere") + get("/readyz"));
    EXPECT_EQ(client.read().body, "ok\n");
    EXPECT_EQ(client.read().status, 200);
    EXPECT_EQ(client.read().status, 404);
    EXPECT_EQ(client.read().body, "ready\n");
}

TEST(KeepAlive, EndsAfterItsNumberOfRequests) {
    HttpOptions options;
    options.requests_per_connection = 3;
    const Running server(options);
    RawClient client = server.client();
    for (int i = 0; i < 3; ++i) {
        client.send(get("/healthz"));
        EXPECT_EQ(client.read().header("Connection"), i < 2 ? "" : "close");
    }
    EXPECT_TRUE(client.closes_within(1s));
}

TEST(KeepAlive, ConnectionCloseAndHttp10Close) {
    const Running server;
    RawClient client = server.client();
    client.send(get("/healthz", "Connection: keep-alive, close\r\n"));
    EXPECT_EQ(client.read().header("Connection"), "close");
    EXPECT_TRUE(client.closes_within(1s));

    RawClient old = server.client();
    old.send("GET /healthz HTTP/1.0\r\n\r\n");
    EXPECT_EQ(old.read().body, "ok\n");
    EXPECT_TRUE(old.closes_within(1s));
}

TEST(Http10, StreamedAnswerEndsWithTheConnection) {
    const Running server;
    const std::string scene = many_particles(10'000);
    const Answer answer = server.ask(
        "POST /v1/particles HTTP/1.0\r\nContent-Type: application/json\r\nContent-Length: " +
        std::to_string(scene.size()) + "\r\n\r\n" + scene);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.header("Transfer-Encoding"), "");
    EXPECT_TRUE(answer.body.starts_with("{\"count\":10000,"));
    EXPECT_TRUE(answer.body.ends_with("]}\n"));
}

TEST(Body, ComesInPieces) {
    const Running server;
    RawClient client = server.client();
    for (const char c : post("/v1/plan", kScene)) client.send({&c, 1});
    EXPECT_EQ(client.read().status, 200);
}

TEST(Body, ExpectContinueIsAnsweredBeforeIt) {
    const Running server;
    RawClient client = server.client();
    const std::string request = post("/v1/plan", kScene, "Expect: 100-continue\r\n");
    client.send(request.substr(0, request.size() - std::string(kScene).size()));
    EXPECT_EQ(client.read().status, 100);
    client.send(kScene);
    EXPECT_EQ(client.read().status, 200);
}

TEST(Body, IsNotAskedForWhenTheAnswerIsKnown) {
    const Running server;
    const auto head = [](const std::string& path, const std::string& headers) {
        return "POST " + path + " HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\n" +
               "Content-Length: 9\r\n" + headers + "\r\n";
    };
    const std::string json = "Content-Type: application/json\r\n";
    EXPECT_EQ(server.ask(head("/nowhere", json)).status, 404);
    EXPECT_EQ(server.ask(head("/healthz", json)).status, 405);
    EXPECT_EQ(server.ask(head("/v1/plan", "")).status, 415);
    EXPECT_EQ(server.ask(head("/v1/plan", json + "Accept: text/html\r\n")).status, 406);
}

TEST(Body, LongOnesTogetherAreRefusedOverTheBudget) {
    HttpOptions options;
    options.max_body_bytes_in_all = 300'000;
    const Running server(options);
    RawClient first = server.client();
    const std::string head =
        "POST /v1/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        "Content-Length: 250000\r\n\r\n";
    first.send(head + std::string(200'000, ' '));
    EXPECT_TRUE(eventually([&] {  // short bodies still get in
        return server.ask(post("/v1/plan", kScene)).status == 200;
    }));
    RawClient second = server.client();
    second.send(head + std::string(200'000, ' '));
    const Answer refused = second.read();
    EXPECT_EQ(refused.status, 429);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    first.send(std::string(50'000, ' '));
    EXPECT_EQ(first.read().status, 400);  // whole: it is no JSON, but it was read
}

TEST(Answers, RequestIdIsEchoedOrMade) {
    const Running server;
    const auto id = [&](const std::string& sent) {
        return server.ask(get("/healthz", "X-Request-Id: " + sent + "\r\n")).header("X-Request-Id");
    };
    EXPECT_EQ(id("a.B-9_z"), "a.B-9_z");
    EXPECT_EQ(id(std::string(128, 'x')), std::string(128, 'x'));
    EXPECT_EQ(id(std::string(129, 'x')).size(), 16u);
    EXPECT_EQ(id("a b").size(), 16u);
    EXPECT_EQ(id("a%0d%0ab").size(), 16u);
    EXPECT_EQ(id("\"><script>").size(), 16u);
}

TEST(Answers, HeadIsGetWithoutItsBody) {
    const Running server;
    RawClient client = server.client();
    for (const char* path : {"/healthz", "/version", "/v1/presets", "/nowhere"}) {
        client.send(get(path));
        const Answer whole = client.read();
        client.send("HEAD " + std::string(path) + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
        const Answer head = client.read(true);
        EXPECT_EQ(head.status, whole.status);
        EXPECT_EQ(head.header("Content-Length"), std::to_string(whole.body.size())) << path;
        EXPECT_EQ(head.header("ETag"), whole.header("ETag"));
    }
    client.send(get("/healthz"));
    EXPECT_EQ(client.read().body, "ok\n") << "HEAD left a body behind";
}

TEST(Answers, RangesAreIgnoredAndNothingIsPackedUnasked) {
    const Running server;
    const Answer answer =
        server.ask(get("/v1/presets", "Range: bytes=0-1,3-4,-1\r\nAccept-Encoding: br\r\n"));
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.header("Content-Encoding"), "");
    const Answer packed = server.ask(get("/v1/presets", "Accept-Encoding: gzip, br\r\n"));
    EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
    EXPECT_EQ(packed.header("Content-Length"), std::to_string(packed.body.size()));
    EXPECT_EQ(packed.body.substr(0, 2), "\x1F\x8B");
    EXPECT_EQ(server.ask(get("/healthz", "Range: nonsense\r\n")).status, 200);
}

TEST(Answers, NothingElseComesOutOfTheProgram) {
    const Running server;
    for (const char* path : {"/../etc/passwd", "/%2e%2e/etc/passwd", "/start.js%00", "//etc/passwd",
                             "/presets/cumulus.json", "/healthz//", "/?a=b/../.."}) {
        const Answer answer = server.ask(get(path));
        EXPECT_TRUE(answer.status == 404 || std::string(path).starts_with("/?")) << path;
    }
    EXPECT_EQ(server.ask(get("/healthz?probe=1")).status, 200);
    EXPECT_EQ(server.ask(get("/%68ealthz")).status, 200);
}

TEST(Answers, UnchangedThingsAre304) {
    const Running server;
    const Answer first = server.ask(post("/v1/render", kScene));
    ASSERT_EQ(first.status, 200);
    const int renders = server.renderer.begun();
    const std::string tag = first.header("ETag");
    EXPECT_TRUE(tag.starts_with('"'));
    for (const std::string& sent : {tag, "\"other\", " + tag, "W/" + tag, std::string("*")}) {
        const Answer again =
            server.ask(post("/v1/render", kScene, "If-None-Match: " + sent + "\r\n"));
        EXPECT_EQ(again.status, 304) << sent;
        EXPECT_EQ(again.header("ETag"), tag);
        EXPECT_EQ(again.header("Content-Length"), "");
    }
    EXPECT_EQ(server.renderer.begun(), renders) << "304 must not cost a render";
    EXPECT_EQ(server.ask(post("/v1/render", kScene, "If-None-Match: \"other\"\r\n")).status, 200);
}

TEST(Renders, ConcurrentOnesAreNotMixedUp) {
    const Running server({}, 16);
    std::vector<std::thread> clients;
    std::atomic<int> right{0};
    for (int i = 1; i <= 8; ++i)
        clients.emplace_back([&, i] {
            const std::string scene =
                R"({"cubes":[],"image":{"height":4,"width":)" + std::to_string(10 * i) + "}}";
            RawClient client = server.client();
            for (int k = 0; k < 3; ++k) {
                client.send(post("/v1/render", scene));
                const Answer answer = client.read();
                // PNG: the width is at byte 16, big-endian.
                if (answer.status == 200 && answer.body.size() > 24 &&
                    static_cast<unsigned char>(answer.body[19]) == 10 * i)
                    ++right;
            }
        });
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(right, 24);
}

}  // namespace
}  // namespace awan::test
