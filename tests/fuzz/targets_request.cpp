// Requests from bytes, to their answers.
#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "server/http/codec.h"
#include "server/http/framing.h"
#include "server/service/service.h"
#include "tests/fake_renderer.h"
#include "tests/fuzz/targets.h"

namespace awan::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

// Of a request here: valid scenes may ask for a lot.
constexpr std::chrono::milliseconds kDeadline{100};
// Of an answer here; the page's largest file and a table of particles within the deadline are shorter.
constexpr std::size_t kLongestAnswer = 256u << 20;

struct Kept : ByteSink {
    std::string bytes;
    bool write(std::string_view more) override {
        bytes += more;
        return bytes.size() < kLongestAnswer;
    }
};

// A service of the tests, once a process: what one request leaves behind meets the next.
struct Served {
    test::FakeRenderer renderer;
    Metrics metrics;
    RenderThread thread{renderer.opener()};
    Service service{thread, metrics, options()};
    HttpCodec codec;

    Served() { thread.wait_until_started(); }

  private:
    ServiceOptions options() const {
        ServiceOptions options;
        options.on_processor = renderer.on_processor();
        options.cache_bytes = 1u << 20;
        return options;
    }
};

// "HTTP/1.1 200 OK" -> 200.
int status_of_answer(std::string_view answer) {
    require(answer.starts_with("HTTP/1.") && answer.size() > 12, "an answer has a status");
    return std::stoi(std::string(answer.substr(9, 3)));
}

void check_answer(const RequestHead& head, std::string_view answer) {
    const int status = status_of_answer(answer);
    require(status != 500, "no request is answered 500");
    const std::size_t end = answer.find("\r\n\r\n");
    require(end != std::string_view::npos, "an answer has a whole head");
    for (std::size_t i = 0; i < end; ++i)
        require(answer[i] != '\0' && (answer[i] != '\n' || answer[i - 1] == '\r'),
                "nothing of a client breaks the head of an answer");
    const bool empty = answer.size() == end + 4;
    if (head.method == "HEAD" || status == 204 || status == 304)
        require(empty, "this answer has no body");
}

void exchange(Served& served, const RequestHead& head, std::string body) {
    // A job runs on after its answer, and would still when the fuzzer has gone on.
    if (head.method == "POST" && head.target.find("job") != std::string::npos) return;
    Kept sink;
    Request request;
    request.deadline = {Clock::now() + kDeadline, nullptr};
    bool abandoned = false;
    const auto begin = Clock::now();
    served.codec.exchange(
        head, std::move(body), std::move(request), false,
        [&](const Request& r) {
            Response response = served.service.answer(r);
            abandoned = response.abandoned;
            return response;
        },
        sink);
    require(Clock::now() - begin < test::patience(10), "a deadline holds");
    if (!abandoned) check_answer(head, sink.bytes);
}

}  // namespace

void fuzz_request(std::string_view bytes) {
    static Served served;
    while (!bytes.empty()) {
        std::size_t scanned = 0;
        const HeadEnd end = find_head_end(bytes, scanned);
        if (!end.bytes) return;
        const ParsedHead parsed = parse_head(bytes.substr(0, *end.bytes));
        bytes.remove_prefix(*end.bytes);
        if (parsed.error) return;
        // A body that does not come whole is cut off here: a fuzzer seldom gets its length right.
        const std::size_t length = std::min(parsed.head.content_length, bytes.size());
        exchange(served, parsed.head, std::string(bytes.substr(0, length)));
        bytes.remove_prefix(length);
    }
}

}  // namespace awan::fuzz
