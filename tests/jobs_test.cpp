// Work that is asked for now and fetched later.
#include "server/service/jobs.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/document/job_text.h"
#include "service_fixture.h"
#include "tests/gzip.h"

namespace awan::test {
namespace {

using json = nlohmann::json;

std::string job_text(const std::string& scene, const std::string& kind = "render") {
    return R"({"kind":")" + kind + R"(","scene":)" + scene + "}";
}

class JobsTest : public ServiceTest {
  protected:
    json submit(const std::string& body, Headers more = {}) {
        const Response response = post("/v1/jobs", body, std::move(more));
        EXPECT_EQ(response.status, 202) << response.body;
        const json job = json::parse(response.body);
        EXPECT_EQ(response.header("Location"), job["self"]);
        return job;
    }
    json state_of(const json& job) { return json::parse(get(job["self"]).body); }
    bool reaches(const json& job, const std::string& state) {
        return eventually([&] { return state_of(job)["state"] == state; });
    }
    Response remove(const json& job) {
        return service.answer(make_request("DELETE", job["self"], "", {}));
    }
};

TEST_F(JobsTest, ResultIsTheSynchronousAnswer) {
    const json job = submit(job_text(kScene));
    ASSERT_TRUE(reaches(job, "done"));
    const json state = state_of(job);
    EXPECT_EQ(state["progress"], 1);
    EXPECT_EQ(state["status"], 200);
    const Response result = get(job["result"]);
    const Response answer = post("/v1/render");
    EXPECT_EQ(result.status, 200);
    EXPECT_EQ(result.bytes(), answer.bytes());
    // However many fetch it, it stands in memory once.
    ASSERT_TRUE(result.shared);
    EXPECT_EQ(get(job["result"]).shared, result.shared);
    EXPECT_EQ(result.header("ETag"), answer.header("ETag"));
    EXPECT_EQ(get(job["result"], {{"If-None-Match", std::string(answer.header("ETag"))}}).status,
              304);
    EXPECT_EQ(remove(job).status, 204);
    expect_problem(get(job["self"]), 404);
    expect_problem(get(job["result"]), 404);
}

TEST_F(JobsTest, BodiesComeAsTheyDoElsewhere) {
    const std::string text =
        R"({"$schema":"job.json","kind":"render","scene":)" + std::string(kScene) + "}";
    submit(gzip(text), {{"Content-Encoding", "gzip"}});
    EXPECT_EQ(service
                  .answer(make_request("POST", "/v1/jobs", text,
                                       {{"Content-Type", "application/vnd.farm+json"}}))
                  .status,
              202);
    Request asked = make_request("POST", "/v1/jobs", text, {{"Content-Type", "application/json"}});
    asked.query = {{"width", "7"}};
    const Response refused = service.answer(asked);
    expect_problem(refused, 400);
    EXPECT_NE(refused.body.find("width"), std::string::npos);
    const Response broken = post("/v1/jobs", "{\"kind\":\"render\",\n \"scene\":}");
    expect_problem(broken, 400);
    EXPECT_NE(broken.body.find("line 2, column 10"), std::string::npos) << broken.body;
}

TEST_F(JobsTest, FormatChoosesTheResult) {
    const std::string text = R"({"kind":"render","format":"exr","_note":{"a":["}",2]},"scene":)" +
                             std::string(kScene) + "}";
    const json job = submit(text);
    ASSERT_TRUE(reaches(job, "done"));
    EXPECT_EQ(get(job["result"]).header("Content-Type"), "image/x-exr");
}

TEST_F(JobsTest, WhatCannotBeIsRefusedAtOnce) {
    expect_problem(post("/v1/jobs", R"({"kind":"paint","scene":{}})"), 422, "/kind");
    expect_problem(post("/v1/jobs", R"({"kind":"render"})"), 422, "/scene");
    expect_problem(post("/v1/jobs", R"({"kind":"render","scene":[]})"), 422, "/scene");
    expect_problem(post("/v1/jobs", R"({"kind":"render","scene":{},"kind":"render"})"), 422,
                   "/kind");
    expect_problem(post("/v1/jobs", R"({"kind":"render","format":"webp","scene":{}})"), 422,
                   "/format");
    expect_problem(post("/v1/jobs", job_text(R"({"cubes":[],"clod":1})")), 422, "/scene/clod");
    expect_problem(post("/v1/jobs", job_text(kScene, "sequence")), 422, "/scene/sequence");
    for (const char* text : {"", "{", "[]", R"({"kind")", R"({"kind":"render","scene":{)",
                             R"({"kind":"render" "scene":{}})", R"({"kind":"render","scene":{}}x)"})
        expect_problem(post("/v1/jobs", text), 400);
    expect_problem(post("/v1/jobs", kScene, {}, "text/csv"), 415);
    EXPECT_EQ(renderer.begun(), 0);
    expect_problem(get("/v1/jobs"), 405);
    expect_problem(get("/v1/jobs/none"), 404);
    expect_problem(get("/v1/jobs/none/events"), 404);
}

TEST_F(JobsTest, RunningOnesAreCancelled) {
    renderer.hold();
    const json job = submit(job_text(kScene));
    ASSERT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    EXPECT_EQ(state_of(job)["state"], "running");
    const Response early = get(job["result"]);
    expect_problem(early, 409);
    EXPECT_FALSE(early.header("Retry-After").empty());
    EXPECT_EQ(remove(job).status, 204);
    EXPECT_TRUE(reaches(job, "cancelled"));
    EXPECT_TRUE(eventually([&] { return renderer.cancelled() == 1; }));
    expect_problem(get(job["result"]), 410);
    renderer.release();
    EXPECT_EQ(post("/v1/render").status, 200);
}

TEST_F(JobsTest, WaitingOnesAreCancelledBeforeTheyBegin) {
    renderer.hold();
    std::vector<json> jobs;
    for (int i = 0; i < 4; ++i) jobs.push_back(submit(job_text(kScene)));
    EXPECT_TRUE(reaches(jobs[1], "running"));
    EXPECT_EQ(state_of(jobs[3])["state"], "queued");
    remove(jobs[3]);
    EXPECT_EQ(state_of(jobs[3])["state"], "cancelled");
    renderer.release();
    EXPECT_TRUE(reaches(jobs[2], "done"));
    EXPECT_EQ(state_of(jobs[3])["state"], "cancelled");
}

TEST_F(JobsTest, AKeyIsOneJob) {
    const Headers key = {{"Idempotency-Key", "a"}};
    const json first = submit(job_text(kScene), key);
    EXPECT_EQ(submit(job_text(kScene), key)["id"], first["id"]);
    EXPECT_NE(submit(job_text(kScene))["id"], first["id"]);
    expect_problem(post("/v1/jobs", job_text(R"({"cubes":[]})"), key), 422);
    ASSERT_TRUE(reaches(first, "done"));
    EXPECT_EQ(submit(job_text(kScene), key)["state"], "done");
    expect_problem(post("/v1/jobs", job_text(kScene), {{"Idempotency-Key", std::string(200, 'a')}}),
                   400);
}

TEST_F(JobsTest, EventsTellEveryChangeUntilTheEnd) {
    renderer.hold();
    const json job = submit(job_text(kScene));
    ASSERT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    Response events = get(job["events"]);
    ASSERT_EQ(events.status, 200);
    EXPECT_EQ(events.header("Content-Type"), "text/event-stream");
    std::string text;
    EXPECT_TRUE(events.stream(text));
    EXPECT_NE(text.find("event: state\nid: "), std::string::npos);
    EXPECT_NE(text.find("\"state\":\"running\""), std::string::npos);
    text.clear();
    EXPECT_TRUE(events.stream(text));
    EXPECT_EQ(text, ":\n\n") << "nothing has changed";
    renderer.release();
    text = {};
    while (events.stream(text)) {
    }
    EXPECT_NE(text.find("\"state\":\"done\",\"progress\":1"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("}\n\n"));
}

TEST_F(JobsTest, SequencesBecomeAnimations) {
    const std::string scene =
        R"({"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],)"
        R"("radius":0.5}]}],"sequence":{"from":0,"to":2,"frames":3},"image":{"width":16,"height":8},)"
        R"("accuracy":{"rung":"harris"}})";
    const json job = submit(job_text(scene, "sequence"));
    ASSERT_TRUE(reaches(job, "done")) << state_of(job);
    const Response result = get(job["result"]);
    EXPECT_EQ(result.header("Content-Type"), "image/webp");
    EXPECT_TRUE(result.bytes().starts_with("RIFF"));
    EXPECT_EQ(renderer.begun(), 3);
}

TEST_F(JobsTest, ImpostorsAreAnAtlasAndItsLayout) {
    const auto impostor = [](const std::string& more) {
        return R"({"kind":"impostor",)" + more + R"("scene":)" + std::string(kScene) + "}";
    };
    const json job = submit(impostor(R"("views":3,"size":8,"mapping":"octahedral",)"));
    ASSERT_TRUE(reaches(job, "done")) << state_of(job);
    EXPECT_EQ(renderer.begun(), 9);
    const Response archive = get(job["result"]);
    EXPECT_EQ(archive.header("Content-Type"), "application/zip");
    EXPECT_NE(archive.bytes().find("impostor.png"), std::string::npos);
    EXPECT_NE(archive.bytes().find(R"("mapping":"octahedral","views":3,"size":8)"),
              std::string::npos);
    const auto refused = [&](const std::string& more, const char* pointer) {
        expect_problem(post("/v1/jobs", impostor(more)), 422, pointer);
    };
    refused(R"("views":1,)", "/views");
    refused(R"("size":4096,)", "/size");
    refused(R"("views":32,"size":512,)", "/size");
    refused(R"("mapping":"cube",)", "/mapping");
    expect_problem(
        post("/v1/jobs", R"({"kind":"render","views":3,"scene":)" + std::string(kScene) + "}"), 422,
        "/views");
}

TEST_F(JobsTest, FlightsAreAnimationsAndReports) {
    const auto fly = [](const std::string& more) {
        return R"({"kind":"fly",)" + more + R"("scene":)" + std::string(kScene) + "}";
    };
    // The fake renderer's picture is of any scene; planned are the flight's frames.
    const json job = submit(fly(R"("path":"through","mode":"thick","frames":3,"rung":"harris",)"));
    ASSERT_TRUE(reaches(job, "done")) << state_of(job);
    EXPECT_EQ(state_of(job)["kind"], "fly");
    const Response film = get(job["result"]);
    EXPECT_EQ(film.header("Content-Type"), "image/webp");
    EXPECT_TRUE(film.bytes().starts_with("RIFF"));
    EXPECT_EQ(renderer.begun(), 3);
    const json told = submit(fly(R"("format":"json","frames":2,"impostors":"on","impostor_pixels":2.5,)"));
    ASSERT_TRUE(reaches(told, "done")) << state_of(told);
    const Response answer = get(told["result"]);
    EXPECT_EQ(answer.header("Content-Type"), "application/json");
    const json report = json::parse(answer.bytes());
    EXPECT_EQ(report["path"], "orbit");
    EXPECT_EQ(report["frames"], 2);
    EXPECT_EQ(report["each"].size(), 2U);
    EXPECT_EQ(report["each"][0]["particles"], 20);
    EXPECT_EQ(report["each"][1]["in_view"], 20);
    EXPECT_GT(report["fps"], 0);
    const json packed = submit(fly(R"("format":"zip","frames":1,"rung":"harris",)"));
    ASSERT_TRUE(reaches(packed, "done")) << state_of(packed);
    const Response archive = get(packed["result"]);
    for (const char* const name : {"frame.0000.png", "report.json", "report.txt"})
        EXPECT_NE(archive.bytes().find(name), std::string::npos) << name;

    expect_problem(post("/v1/jobs", fly(R"("path":"loop",)")), 422, "/path");
    expect_problem(post("/v1/jobs", fly(R"("path":"keys",)")), 422, "/scene/sequence/camera");
    expect_problem(post("/v1/jobs", fly(R"("mode":"solid",)")), 422, "/mode");
    expect_problem(post("/v1/jobs", fly(R"("rung":"best",)")), 422, "/rung");
    expect_problem(post("/v1/jobs", fly(R"("impostors":"often",)")), 422, "/impostors");
    expect_problem(post("/v1/jobs", fly(R"("impostor_pixels":0,)")), 422, "/impostor_pixels");
    expect_problem(post("/v1/jobs", fly(R"("format":"png",)")), 422, "/format");
    for (const char* const frames : {"0", "10001", "-1", "1.5", "\"3\"", "[3]", "true"})
        expect_problem(post("/v1/jobs", fly(R"("frames":)" + std::string(frames) + ",")), 422,
                       "/frames");
    const std::string render =
        R"({"kind":"render","mode":"thin","scene":)" + std::string(kScene) + "}";
    expect_problem(post("/v1/jobs", render), 422, "/mode");
}

TEST_F(JobsTest, FailuresAreResultsToo) {
    ServiceOptions options = with_fake({});
    options.on_processor = [](const Scene&, Planned, int, const Progress&,
                              const Deadline&) -> Result<Rendered> { throw std::bad_alloc(); };
    Service failing(thread, metrics, options);
    const std::string marched =
        R"({"cubes":[],"image":{"width":8,"height":8},"accuracy":{"rung":"transport-16"}})";
    const Response accepted = failing.answer(make_request("POST", "/v1/jobs", job_text(marched)));
    const json job = json::parse(accepted.body);
    const auto state = [&] {
        return json::parse(failing.answer(make_request("GET", job["self"])).body);
    };
    ASSERT_TRUE(eventually([&] { return state()["state"] == "failed"; }));
    EXPECT_EQ(state()["status"], 503);
    expect_problem(failing.answer(make_request("GET", job["result"])), 503);
}

// --- bounds

Jobs::Run answering(std::size_t bytes) {
    return [bytes](const JobWork&, const Request&) {
        Response response;
        response.body.assign(bytes, 'x');
        return response;
    };
}

JobWork named(const std::string& id) {
    JobWork work;
    work.id = id;
    return work;
}

TEST(Jobs, OldResultsAreDropped) {
    JobsOptions options;
    options.runners = 1;
    options.bytes = 10'000;
    options.most = 8;
    Jobs jobs(options, answering(3000));
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(jobs.submit(named(std::to_string(i))));
        EXPECT_TRUE(eventually([&] {
            const auto view = jobs.view(std::to_string(i));
            return view && view->finished();
        }));
        EXPECT_LE(jobs.load().bytes, options.bytes);
    }
    EXPECT_FALSE(jobs.view("0"));
    EXPECT_FALSE(jobs.view("1"));
    EXPECT_TRUE(jobs.view("2"));
    EXPECT_EQ(jobs.load().bytes, 9000u);
    EXPECT_TRUE(jobs.remove("4"));
    EXPECT_EQ(jobs.load().bytes, 6000u);
    EXPECT_FALSE(jobs.remove("4"));
}

TEST(Jobs, SoManyWaitAndNoMore) {
    JobsOptions options;
    options.runners = 1;
    options.most_waiting = 2;
    std::atomic<bool> go{false};
    Jobs jobs(options, [&](const JobWork&, const Request& request) {
        while (!go && !request.deadline.over())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return Response{};
    });
    EXPECT_TRUE(jobs.submit(named("a")));
    EXPECT_TRUE(jobs.submit(named("b")));
    EXPECT_FALSE(jobs.submit(named("c")));
    go = true;
    EXPECT_TRUE(eventually([&] { return jobs.view("b")->finished(); }));
    EXPECT_TRUE(jobs.submit(named("c")));
}

TEST(Jobs, ScenesThatWaitAreBoundedToo) {
    JobsOptions options;
    options.runners = 0;
    options.bytes = 1000;
    Jobs jobs(options, answering(1));
    JobWork large = named("a");
    large.request.body.assign(5000, ' ');
    EXPECT_TRUE(jobs.submit(large)) << "alone, any is welcome";
    large.id = "b";
    EXPECT_FALSE(jobs.submit(large));
}

TEST(Jobs, EndWithTheServer) {
    std::atomic<bool> ended{false};
    {
        Jobs jobs({}, [&](const JobWork&, const Request& request) {
            while (!request.deadline.over())
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ended = true;
            return Response{};
        });
        jobs.submit(named("a"));
        EXPECT_TRUE(eventually([&] { return jobs.load().running == 1; }));
    }
    EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace awan::test
