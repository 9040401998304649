// Memory that runs out at every place it is asked for: the Nth allocation fails, for every N, alone or with all that
// come after it. What comes then is the right answer or an honest refusal, nothing is left behind, and the next is
// right.
#include <gtest/gtest.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "core/base/thrown.h"
#include "core/formats/animation.h"
#include "core/formats/particle_files.h"
#include "core/generate/generate.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "server/document/scene_text.h"
#include "server/http/codec.h"
#include "server/service/service.h"
#include "tests/failing_memory.h"
#include "tests/fake_renderer.h"
#include "tests/gzip.h"

namespace awan::test {
namespace {

using Which = FailingMemory::Which;

// Every allocation up to `every`; beyond, so many of the rest, evenly.
struct Amount {
    long every = or_fewer(120L, 25L);
    long samples = or_fewer(60L, 10L);
};

// What a try at something gave: its bytes, or that memory ran out.
using Outcome = std::optional<std::string>;

std::string scene_text(const std::string& rung) {
    return R"({"cubes":[{"particles":12,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"seed":7,)"
           R"("image":{"width":12,"height":8},"accuracy":{"rung":")" +
           rung + "\"}}";
}

// Runs `attempt` with every allocation failing in its turn. `attempt` gives what came whole, or nothing where it says
// that memory ran out; it fails the test where it says anything else.
void fail_at_every(const std::function<Outcome()>& attempt, Amount amount = {}) {
    // Twice: what is made once a process is there by then.
    const Outcome right = attempt();
    ASSERT_TRUE(right.has_value());
    ASSERT_EQ(attempt(), right);
    FailingMemory::count();
    attempt();
    const long all = FailingMemory::counted();
    ASSERT_GT(all, 10);
    const long step = std::max(1L, (all - amount.every) / amount.samples);
    for (const Which which : {Which::kOne, Which::kAllFrom}) {
        long refused = 0;
        const long before = FailingMemory::live();
        for (long n = 1; n <= all; n += n < amount.every ? 1 : step) {
            SCOPED_TRACE("allocation " + std::to_string(n) + " of " + std::to_string(all) +
                         (which == Which::kOne ? "" : " and all after it"));
            FailingMemory::arm(n, which);
            Outcome outcome;
            try {
                outcome = attempt();
            } catch (const std::bad_alloc&) {
                // Of what is asked with, not of what is asked.
            }
            FailingMemory::disarm();
            if (outcome) {
                EXPECT_EQ(*outcome, *right);
            } else {
                ++refused;
            }
            if (testing::Test::HasFailure()) return;
        }
        EXPECT_GT(refused, 0);
        EXPECT_EQ(attempt(), right);
        // A few: what libraries keep from one call to the next.
        EXPECT_LT(FailingMemory::live() - before, 40);
    }
}

// As a caller of the stages has it: an Error of kOutOfMemory, or what was thrown.
Outcome of_stages(const std::function<Result<std::string>()>& stages) {
    Outcome outcome;
    std::optional<ErrorCode> code;
    try {
        auto result = stages();
        if (result)
            outcome = *std::move(result);
        else
            code = result.error().code;
    } catch (const std::exception& e) {
        FailingMemory::disarm();
        code = error_of_thrown(e).code;
        EXPECT_EQ(error_of_thrown(e).message.find("std::"), std::string::npos) << e.what();
    }
    FailingMemory::disarm();
    if (code) {
        EXPECT_EQ(*code, ErrorCode::kOutOfMemory);
    }
    return outcome;
}

Result<std::string> rendered(const std::string& text, bool exr) {
    auto draft = read_scene(SceneFormat::kJson, text);
    if (!draft) return draft.error();
    auto scene = validate(*std::move(draft));
    if (!scene) return scene.error();
    auto picture = render_scene(*scene, {}, {});
    if (!picture) return picture.error();
    return exr ? encode_exr(picture->image, Precision::kFloat) : encode_png(picture->image, {});
}

TEST(Allocation, ParsingPlanningRenderingAndPng) {
    fail_at_every(
        [] { return of_stages([] { return rendered(scene_text("transport-16"), false); }); });
}

TEST(Allocation, RenderingAndExr) {
    fail_at_every(
        [] { return of_stages([] { return rendered(scene_text("transport-16"), true); }); });
}

TEST(Allocation, Particles) {
    const Scene scene = *validate(*parse_scene(scene_text("harris")));
    fail_at_every([&] {
        return of_stages([&]() -> Result<std::string> {
            auto particles = generate(scene, 1, {});
            if (!particles) return particles.error();
            std::string text;
            append_csv_header(text);
            append_csv(*particles, 0, particles->size(), text);
            append_ply_header(*particles, text);
            append_ply(*particles, 0, particles->size(), text);
            auto glb = write_glb(*particles);
            if (!glb) return glb.error();
            return text + *glb;
        });
    });
}

TEST(Allocation, TextsOfEveryKind) {
    const std::string csv = "x,y,z,radius\n1,2,3,1\n4,5,6,.5\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nproperty float radius\nend_header\n0 0 0 1\n";
    const std::string awn = "20\n1\n20 2 1 2 0 0 0 .5\n";
    fail_at_every([&] {
        return of_stages([&]() -> Result<std::string> {
            std::string all;
            for (const auto& [format, text] : {std::pair(SceneFormat::kCsv, &csv),
                                               {SceneFormat::kPly, &ply},
                                               {SceneFormat::kAwn, &awn}}) {
                auto draft = read_scene(format, *text);
                if (!draft) return draft.error();
                all += scene_to_json(*draft);
            }
            return all;
        });
    });
}

// --- the service, through the codec to the bytes of its answer

struct Kept : ByteSink {
    std::string bytes;
    bool write(std::string_view more) override {
        bytes += more;
        return true;
    }
};

// A service that renders by itself, without a device.
struct Served {
    FakeRenderer renderer;
    Metrics metrics;
    RenderThread thread{renderer.opener()};
    Service service{thread, metrics, {}};
    HttpCodec codec;
    Served() { thread.wait_until_started(); }

    // The body of a 200, nothing of a 503 or of an answer that broke off; ends the test at others.
    Outcome ask(const RequestHead& head, const std::string& body) {
        Kept sink;
        bool whole = false;
        // What copies a request has is the transport's, which closes the connection when it cannot.
        std::string copy = body;
        try {
            whole = codec.exchange(
                head, std::move(copy), Request{}, false,
                [&](const Request& request) { return service.answer(request); }, sink);
        } catch (const std::bad_alloc&) {
        }
        FailingMemory::disarm();
        if (!whole) return std::nullopt;
        const std::size_t end = sink.bytes.find("\r\n\r\n");
        if (end == std::string::npos) {
            ADD_FAILURE() << "no whole answer: " << sink.bytes.substr(0, 200);
            return std::nullopt;
        }
        const std::string status = sink.bytes.substr(9, 3);
        EXPECT_TRUE(status == "200" || status == "503") << sink.bytes.substr(0, 500);
        if (status == "503") {
            EXPECT_NE(sink.bytes.find("Retry-After: "), std::string::npos) << sink.bytes;
        }
        if (status != "200") return std::nullopt;
        return sink.bytes.substr(end + 4);
    }
};

RequestHead head_of(const std::string& method, const std::string& target, std::size_t length,
                    std::vector<std::pair<std::string, std::string>> more = {}) {
    RequestHead head;
    head.method = method;
    head.target = target;
    head.content_length = length;
    head.headers = {
        {"Host", "localhost"}, {"Content-Type", "application/json"}, {"X-Request-Id", "a"}};
    head.headers.insert(head.headers.end(), more.begin(), more.end());
    return head;
}

// In a lane, and by the thread of the renderer.
TEST(Allocation, ARenderIsAnsweredWholeOr503) {
    Served served;
    for (const char* const rung : {"transport-16", "harris"}) {
        const std::string body = scene_text(rung);
        const RequestHead head = head_of("POST", "/v1/render?width=10", body.size());
        fail_at_every([&] { return served.ask(head, body); });
    }
}

TEST(Allocation, AStreamIsWholeOrBreaksOff) {
    Served served;
    // More than one piece.
    const std::string body =
        R"({"cubes":[{"particles":5000,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
    const std::string packed = gzip(body);
    const RequestHead head =
        head_of("POST", "/v1/particles?format=csv", packed.size(), {{"Content-Encoding", "gzip"}});
    fail_at_every([&] { return served.ask(head, packed); },
                  {or_fewer(80L, 20L), or_fewer(60L, 10L)});
}

TEST(Allocation, WhatIsReadIsAnsweredWholeOr503) {
    Served served;
    for (const char* const target : {"/v1/presets", "/version", "/openapi.json"}) {
        const RequestHead head = head_of("GET", target, 0);
        fail_at_every([&] { return served.ask(head, ""); });
    }
}

}  // namespace
}  // namespace awan::test
