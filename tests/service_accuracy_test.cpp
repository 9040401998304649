// POST /v1/accuracy, with the path tracer as it is and a renderer that draws white. The rungs that
// need no renderer are left out: this is about the answer, not about them.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "nlohmann/json.hpp"
#include "server/service/negotiation.h"
#include "service_fixture.h"
#include "tests/patience.h"

namespace awan::test {
namespace {

using json = nlohmann::json;

using Query = std::vector<std::pair<std::string, std::string>>;

Request accuracy_request(Query query = {}, const std::string& accept = "",
                         const std::string& body = kScene) {
    Request request = make_request("POST", "/v1/accuracy", body);
    if (!accept.empty()) request.headers.emplace_back("Accept", accept);
    request.query = {{"rungs", "additive,harris"}, {"samples", "16"}, {"size", "8"}};
    request.query.insert(request.query.end(), query.begin(), query.end());
    request.deadline.until = Deadline::Clock::now() + test::patience(30);
    return request;
}

TEST_F(ServiceTest, AccuracyIsJsonCsvOrAPlot) {
    const Response said = service.answer(accuracy_request());
    ASSERT_EQ(said.status, 200) << said.body;
    EXPECT_EQ(said.header("Content-Type"), "application/json");
    EXPECT_EQ(said.header("ETag"), "") << "times are never the same again";
    EXPECT_EQ(said.header("Cache-Control"), "no-store");
    EXPECT_EQ(said.header("Vary"), "Accept");
    for (const char* stage : {"queue;dur=", "reference;dur=", "rungs;dur=", "encode;dur="})
        EXPECT_NE(said.header("Server-Timing").find(stage), std::string_view::npos);
    const json answer = json::parse(said.body);
    EXPECT_EQ(answer["width"], 16);
    EXPECT_EQ(answer["reference"]["width"], 8);
    EXPECT_EQ(answer["reference"]["height"], 4);
    EXPECT_EQ(answer["reference"]["samples"], 16);
    ASSERT_EQ(answer["rungs"].size(), 2u);
    EXPECT_LE(answer["rungs"][0]["time_ms"], answer["rungs"][1]["time_ms"]);
    EXPECT_TRUE(answer["rungs"][0]["predicted"]["time_ms"].is_number());
    EXPECT_EQ(answer["left_out"], json::array());

    const Response table = service.answer(accuracy_request({}, "text/csv"));
    EXPECT_EQ(table.header("Content-Type"), "text/csv");
    EXPECT_TRUE(table.body.starts_with("rung,time_ms,"));
    const Response light = service.answer(accuracy_request({}, "image/png"));
    EXPECT_EQ(light.header("Content-Type"), "image/png");
    EXPECT_TRUE(light.body.starts_with("\x89PNG"));
    const Response dark = service.answer(accuracy_request({{"theme", "dark"}}, "image/png"));
    EXPECT_TRUE(dark.body.starts_with("\x89PNG"));
    EXPECT_NE(dark.body, light.body);
    expect_problem(service.answer(accuracy_request({}, "image/x-exr")), 406);
}

TEST_F(ServiceTest, AccuracyRefusesAQueryItDoesNotKnow) {
    const std::pair<const char*, const char*> wrong[] = {
        {"theme", "blue"},  {"size", "7"},       {"size", "513"}, {"samples", "1"},
        {"samples", "1e3"}, {"runs", "0"},       {"runs", ""},    {"rungs", "perfect"},
        {"rungs", ""},      {"rungs", "harris,"}};
    for (const auto& [name, value] : wrong) {
        const Response refused = service.answer(accuracy_request({{name, value}}));
        expect_problem(refused, 400);
        EXPECT_NE(refused.body.find(std::string("`") + name + "`"), std::string::npos)
            << refused.body;
    }
    const Response unknown = service.answer(accuracy_request({{"sizes", "8"}}));
    expect_problem(unknown, 400);
    for (const char* known : {"there are ", "theme", "size", "samples", "runs", "rungs"})
        EXPECT_NE(unknown.body.find(known), std::string::npos) << unknown.body;
    EXPECT_TRUE(service.refuse(accuracy_request({{"theme", "blue"}}))) << "before the body";
    EXPECT_EQ(renderer.begun(), 0);
}

TEST_F(ServiceTest, AccuracyOfWhatCannotBeIs422) {
    expect_problem(service.answer(accuracy_request({}, "", R"({"cubes":[],"clod":1})")), 422,
                   "/clod");
    Request late = accuracy_request();
    late.deadline.until = Deadline::Clock::now() - std::chrono::seconds(1);
    expect_problem(service.answer(late), 504);
}

TEST_F(ServiceTest, AccuracyHoldsNobodyUpButAnotherSweep) {
    renderer.hold();
    const auto gone = std::make_shared<std::atomic<bool>>(false);
    Request request = accuracy_request();
    request.deadline.cancelled = gone;
    Response answer;
    std::thread sweeping([&] { answer = service.answer(request); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    EXPECT_EQ(post("/v1/plan").status, 200);
    EXPECT_EQ(post("/v1/particles").status, 200);
    const Response second = service.answer(accuracy_request());
    expect_problem(second, 429);
    EXPECT_FALSE(second.header("Retry-After").empty());

    *gone = true;  // the client goes: the render stops, and so does all that would follow
    sweeping.join();
    EXPECT_TRUE(answer.abandoned);
    EXPECT_EQ(renderer.begun(), 1);
    EXPECT_EQ(service.in_progress(), 0u);
    renderer.release();
    EXPECT_EQ(service.answer(accuracy_request()).status, 200);
}

class NoQueue : public ServiceTest {
  protected:
    static ServiceOptions none() {
        ServiceOptions options;
        options.lanes.line = 0;
        return options;
    }
    NoQueue() : ServiceTest(none()) {}
};

TEST_F(NoQueue, AccuracyWaitsForTheRendererAllTheSame) {
    renderer.hold();
    std::thread drawing([&] { EXPECT_EQ(post("/v1/render").status, 200); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    Response answer;
    std::thread sweeping([&] { answer = service.answer(accuracy_request()); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    expect_problem(post("/v1/render"), 429);
    EXPECT_EQ(renderer.begun(), 1);
    renderer.release();
    drawing.join();
    sweeping.join();
    EXPECT_EQ(answer.status, 200) << answer.body;
}

}  // namespace
}  // namespace awan::test
