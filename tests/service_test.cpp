// Requests for scenes and their answers, without sockets.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "server/service/result_cache.h"
#include "server/service/work_budget.h"
#include "service_fixture.h"
#include "tests/patience.h"

namespace awan::test {
namespace {

// --- routes

TEST_F(ServiceTest, UnknownPathsAre404) {
    for (const char* path : {"/nowhere", "/v1", "/v1/", "/v1/render//", "/v1/jobs/1/nothing",
                             "/v1/presets/none", "/presets/cumulus.json", "", "*"}) {
        expect_problem(get(path), 404);
        expect_problem(post(path), 404);
    }
}

TEST_F(ServiceTest, WrongMethodsAre405WithAllow) {
    for (const char* path : {"/v1/particles", "/v1/render", "/v1/plan"})
        for (const char* method : {"GET", "HEAD", "PUT", "DELETE", "PATCH", "TRACE"}) {
            const Response response = service.answer(make_request(method, path, kScene));
            expect_problem(response, 405);
            EXPECT_EQ(response.header("Allow"), "POST, OPTIONS");
        }
    for (const char* path : {"/", "/healthz", "/v1/presets", "/v1/presets/cumulus"})
        for (const char* method : {"POST", "PUT", "DELETE"}) {
            const Response response = service.answer(make_request(method, path, kScene));
            expect_problem(response, 405);
            EXPECT_EQ(response.header("Allow"), "GET, HEAD, OPTIONS");
        }
}

TEST_F(ServiceTest, OptionsTellsWhatIsAllowed) {
    EXPECT_EQ(service.answer(make_request("OPTIONS", "/v1/render")).header("Allow"),
              "POST, OPTIONS");
    const Response page = service.answer(make_request("OPTIONS", "/"));
    EXPECT_EQ(page.status, 204);
    EXPECT_EQ(page.header("Allow"), "GET, HEAD, OPTIONS");
    EXPECT_EQ(service.answer(make_request("OPTIONS", "*")).status, 204);
    expect_problem(service.answer(make_request("OPTIONS", "/nowhere")), 404);
}

TEST_F(ServiceTest, EveryAnswerHasItsIdAndIsNotSniffed) {
    for (const Response& response :
         {get("/"), get("/nowhere"), get("/healthz"), post("/v1/plan"), post("/v1/plan", "{"),
          post("/v1/render"), service.answer(make_request("OPTIONS", "*"))}) {
        EXPECT_EQ(response.header("X-Request-Id"), "test-1");
        EXPECT_EQ(response.header("X-Content-Type-Options"), "nosniff");
    }
}

// --- what comes in

TEST_F(ServiceTest, ContentTypesOtherThanScenesAre415) {
    for (const char* type :
         {"", "text/plain", "application/x-www-form-urlencoded", "application/jsonx",
          "application/json; charset=utf-16", "image/png"}) {
        const Response response = post("/v1/plan", kScene, {}, type);
        expect_problem(response, 415);
        EXPECT_FALSE(response.header("Accept").empty());
    }
    expect_problem(service.answer(make_request("POST", "/v1/plan", kScene, {})), 415);
}

TEST_F(ServiceTest, SceneTypesAreTaken) {
    EXPECT_EQ(post("/v1/plan", kScene, {}, "Application/JSON; charset=\"UTF-8\"").status, 200);
    EXPECT_EQ(post("/v1/plan", "20\n1\n20, 2, 1, 2, 0, 0, 0, 0.5\n", {}, "text/x-awn").status, 200);
    const std::string csv = "x,y,z,radius\n0,0,0,1\n1,0,0,1\n";
    EXPECT_EQ(post("/v1/plan", csv, {}, "text/csv; charset=utf-8").status, 200);
    const Response ply = post("/v1/particles", csv, {{"Accept", "application/x-ply"}}, "text/csv");
    ASSERT_EQ(ply.status, 200);
    EXPECT_EQ(post("/v1/plan", whole_body(ply), {}, "application/x-ply").status, 200);
}

TEST_F(ServiceTest, BrokenDocumentsAre400) {
    for (const char* body : {"", " ", "{", "nonsense", "{\"cubes\":[}", "\xff\xfe"})
        expect_problem(post("/v1/plan", body), 400);
    // What follows a NUL must not be passed over.
    for (const std::string& after : {std::string(1, '\0'), std::string("\0 nonsense", 10)})
        expect_problem(post("/v1/plan", kScene + after), 400);
    expect_problem(post("/v1/plan", "2\n1\n", {}, "text/x-awn"), 400);
    expect_problem(post("/v1/plan", "a,b\n1,2\n", {}, "text/csv"), 400);
    expect_problem(post("/v1/plan", "ply\n", {}, "application/x-ply"), 400);
}

TEST_F(ServiceTest, ImpossibleScenesAre422AndNameThePlace) {
    const char* cube = R"({"cubes":[{"particles":1,"size":[1,-1,1],"center":[0,0,0],"radius":1}]})";
    for (const char* path : {"/v1/plan", "/v1/particles", "/v1/render"})
        expect_problem(post(path, cube), 422, "/cubes/0/size/1");
    expect_problem(post("/v1/plan", R"({"cubes":[],"clod":1})"), 422, "/clod");
    expect_problem(post("/v1/plan", R"({"cubes":[],"ground":{"albedo":2}})"), 422,
                   "/ground/albedo/0");
    const Response none = post("/v1/plan", "[]");
    expect_problem(none, 422);
    EXPECT_NE(none.body.find("\"pointer\":\"\""), std::string::npos) << "the whole document";
}

// --- what goes out

TEST_F(ServiceTest, ParticlesComeAsTheClientLikes) {
    const Response json = post("/v1/particles");
    EXPECT_EQ(json.header("Content-Type"), "application/json");
    EXPECT_EQ(json.header("Awan-Particles"), "20");
    EXPECT_EQ(json.header("Vary"), "Accept");
    EXPECT_TRUE(json.body.starts_with("{\"count\":20,\"seed\":7,\"bounds\":{\"min\":["));
    EXPECT_EQ(post("/v1/particles", kScene, {{"Accept", "*/*"}}).body, json.body);
    EXPECT_EQ(
        post("/v1/particles", kScene, {{"Accept", "text/csv, */*;q=0.1"}}).header("Content-Type"),
        "text/csv");
    EXPECT_EQ(post("/v1/particles", kScene, {{"Accept", "text/*"}}).header("Content-Type"),
              "text/csv");
    EXPECT_TRUE(post("/v1/particles", kScene, {{"Accept", "application/x-ply"}})
                    .body.starts_with("ply\nformat binary_little_endian 1.0\n"));
    const Response layout = post("/v1/particles", kScene, {{"Accept", "text/x-awn"}});
    EXPECT_EQ(layout.status, 200);
    EXPECT_EQ(layout.header("Content-Type"), "text/x-awn");
    EXPECT_EQ(post("/v1/particles", layout.body, {{"Accept", "text/x-awn"}}, "text/x-awn").body,
              layout.body);
    for (const char* accept : {"image/*", "application/json;q=0", "nonsense"})
        expect_problem(post("/v1/particles", kScene, {{"Accept", accept}}), 406);
    const Response page = post("/v1/particles", kScene, {{"Accept", "text/html"}});
    EXPECT_EQ(page.status, 406);
    EXPECT_EQ(page.header("Content-Type"), "text/html; charset=utf-8") << "a browser's own";
}

TEST_F(ServiceTest, LongAnswersAreStreamedAndWhole) {
    const std::string scene =
        R"({"cubes":[{"particles":10000,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    const Response csv = post("/v1/particles", scene, {{"Accept", "text/csv"}});
    EXPECT_TRUE(csv.stream != nullptr);
    EXPECT_EQ(lines(whole_body(csv)), 10'001);
    const std::string json = whole_body(post("/v1/particles", scene));
    EXPECT_EQ(lines(json), 10'002);
    EXPECT_TRUE(json.ends_with("}\n]}\n"));
    std::size_t centers = 0;
    for (std::size_t at = 0; (at = json.find("\"center\"", at)) != std::string::npos; ++at)
        ++centers;
    EXPECT_EQ(centers, 10'000u);
}

TEST_F(ServiceTest, PlanNeedsNoRenderer) {
    const Response plan = post("/v1/plan");
    EXPECT_EQ(plan.status, 200);
    EXPECT_TRUE(plan.body.starts_with("{\"survey\":{"));
    EXPECT_NE(plan.body.find("\"rung\":\"harris\""), std::string::npos);
    EXPECT_EQ(renderer.begun(), 0);
    expect_problem(post("/v1/plan", kScene, {{"Accept", "text/csv"}}), 406);
}

TEST_F(ServiceTest, RendersAreDescribedByTheirHeaders) {
    const Response png = post("/v1/render");
    ASSERT_EQ(png.status, 200);
    EXPECT_EQ(png.header("Content-Type"), "image/png");
    EXPECT_TRUE(png.body.starts_with("\x89PNG"));
    EXPECT_EQ(png.header("Awan-Rung"), "harris");
    EXPECT_EQ(png.header("Awan-Particles"), "20");
    EXPECT_NE(png.header("Awan-Effects").find("self_shadow"), std::string_view::npos);
    const double error = std::stod(std::string(png.header("Awan-Error")));
    EXPECT_GT(error, 0) << "of harris, as stated";
    EXPECT_NEAR(std::stod(std::string(png.header("Awan-Error-Forecast"))), 2 * error, 0.02 * error)
        << "the fake renderer states half of it";
    EXPECT_GT(std::stod(std::string(png.header("Awan-Time"))), 0);
    EXPECT_EQ(png.header("Vary"), "Accept");
    const std::string timing(png.header("Server-Timing"));
    std::size_t at = 0;
    for (const char* stage : {"queue", "generate", "survey", "light", "draw", "encode"}) {
        at = timing.find(std::string(stage) + ";dur=", at);
        EXPECT_NE(at, std::string::npos) << stage << " in " << timing;
    }
}

// The fake renderer's lights and pictures take none; detail is made before.
TEST_F(ServiceTest, TimesOfEffectsComeAfterTheStages) {
    const std::string detailed =
        R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"detail":{"amount":0.5},)"
        R"("effects":{"detail":true},"image":{"width":16,"height":8},"accuracy":{"rung":"transport-16"}})";
    const Response with = post("/v1/render", detailed);
    ASSERT_EQ(with.status, 200) << with.body;
    const std::string timing(with.header("Server-Timing"));
    EXPECT_NE(timing.find(", detail;dur=", timing.find("encode;dur=")), std::string::npos)
        << timing;
    for (const Response& response : {with, post("/v1/render")})
        EXPECT_EQ(response.header("Server-Timing").find("_"), std::string_view::npos)
            << "no effect took time that did not run";
    EXPECT_EQ(post("/v1/render").header("Server-Timing").find("detail"), std::string_view::npos);
}

TEST_F(ServiceTest, AcceptChoosesTheImageAndElseTheDocument) {
    const std::string exr_scene = R"({"cubes":[],"image":{"width":4,"height":4,"format":"exr"}})";
    const auto type = [&](const std::string& scene, const Headers& headers) {
        return std::string(post("/v1/render", scene, headers).header("Content-Type"));
    };
    EXPECT_EQ(type(exr_scene, {}), "image/x-exr");
    EXPECT_EQ(type(exr_scene, {{"Accept", "*/*"}}), "image/x-exr");
    EXPECT_EQ(type(exr_scene, {{"Accept", "image/*"}}), "image/x-exr");
    EXPECT_EQ(type(exr_scene, {{"Accept", "image/png"}}), "image/png");
    EXPECT_EQ(type(kScene, {{"Accept", "image/x-exr, image/png;q=0.9"}}), "image/x-exr");
    EXPECT_EQ(type(kScene, {{"Accept", "image/avif,image/webp,image/png,*/*;q=0.8"}}), "image/png");
    expect_problem(post("/v1/render", kScene, {{"Accept", "image/jpeg"}}), 406);
}

TEST_F(ServiceTest, TagsNameTheAnswerAndNotItsSpelling) {
    const std::string respelled =
        R"({ "seed": 7.0, "accuracy": { "rung" : "harris" }, "image": {"height": 8, "width": 16}, "fill": "cumulus",)"
        R"("cubes":[{"radius":5e-1,"size":[2,1,2],"particles":20,"center":[0,0,0]}]})";
    std::set<std::string> tags;
    for (const char* path : {"/v1/particles", "/v1/render", "/v1/plan"}) {
        const std::string tag(post(path).header("ETag"));
        EXPECT_EQ(post(path, respelled).header("ETag"), tag);
        const Response again = post(path, kScene, {{"If-None-Match", tag}});
        EXPECT_EQ(again.status, 304);
        EXPECT_EQ(again.body, "");
        tags.insert(tag);
    }
    tags.insert(
        std::string(post("/v1/render", kScene, {{"Accept", "image/x-exr"}}).header("ETag")));
    tags.insert(
        std::string(post("/v1/particles", kScene, {{"Accept", "text/csv"}}).header("ETag")));
    EXPECT_EQ(tags.size(), 5u) << "every answer has a tag of its own";
}

TEST_F(ServiceTest, WhatCannotBeDoneInTimeIsRefusedAtOnce) {
    Request request =
        make_request("POST", "/v1/render",
                     R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],)"
                     R"("image":{"width":4096,"height":4096},"accuracy":{"rung":"truth"}})");
    request.deadline.until = Deadline::Clock::now() + test::patience(10);
    const Response refused = service.answer(request);
    expect_problem(refused, 504);
    for (const char* const said : {"rung truth would take about", "are left", "smaller picture"})
        EXPECT_NE(refused.body.find(said), std::string::npos) << refused.body;
    EXPECT_EQ(renderer.begun(), 0);
    request.deadline.until = Deadline::Clock::time_point::max();
    EXPECT_EQ(service.answer(request).status, 200) << "who waits for ever may ask for anything";
}

// --- load

// A scene of a rung that needs no device.
const std::string kMarched =
    R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"seed":7,)"
    R"("image":{"width":16,"height":8},"accuracy":{"rung":"transport-16"}})";

TEST_F(ServiceTest, FullLineRefusesBeforeAnythingIsComputed) {
    ServiceOptions options = with_fake({});
    options.lanes.line = 1;
    Service small(thread, metrics, options);
    renderer.hold();
    std::vector<std::thread> clients;
    for (std::size_t i = 0; i < 3; ++i) {
        clients.emplace_back([&] {
            EXPECT_EQ(small.answer(make_request("POST", "/v1/render", kMarched)).status, 200);
        });
        EXPECT_TRUE(eventually([&] { return small.in_progress() == i + 1; }));
    }
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 2; })) << "one a lane";
    EXPECT_TRUE(eventually([&] { return small.in_line() == 1; }));
    const std::string generated = metrics.text({});
    const Response ready = small.answer(make_request("GET", "/readyz"));
    expect_problem(ready, 503);
    EXPECT_NE(ready.body.find("saturated"), std::string::npos) << ready.body;
    EXPECT_EQ(small.answer(make_request("GET", "/healthz")).status, 200);
    const Response refused = small.answer(make_request("POST", "/v1/plan", kMarched));
    expect_problem(refused, 429);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    renderer.release();
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(small.answer(make_request("GET", "/readyz")).status, 200);
}

// --- lanes: long work stands in nobody's way

TEST_F(ServiceTest, PreviewsDoNotWaitForLongWork) {
    const std::string path_traced =
        R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],)"
        R"("image":{"width":1024,"height":1024},"accuracy":{"rung":"truth"}})";
    renderer.hold();
    std::vector<std::thread> clients;
    for (int i = 0; i < 3; ++i)
        clients.emplace_back([&] { EXPECT_EQ(post("/v1/render", path_traced).status, 200); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 1 && service.in_progress() == 3; }));
    EXPECT_EQ(post("/v1/plan", kMarched).status, 200);
    EXPECT_EQ(post("/v1/particles", kMarched).status, 200);
    EXPECT_EQ(renderer.begun(), 1) << "long ones wait for the lane of long ones";
    renderer.release();
    for (std::thread& client : clients) client.join();
}

TEST_F(ServiceTest, WhatNeedsNoDeviceDoesNotWaitForIt) {
    renderer.hold();
    std::thread drawing([&] { EXPECT_EQ(post("/v1/render").status, 200); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    std::thread marching([&] { EXPECT_EQ(post("/v1/render", kMarched).status, 200); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 2; }));
    renderer.release();
    drawing.join();
    marching.join();
}

// --- answers that are kept

// What an EXR's layers take to encode counts before anything is rendered.
TEST_F(ServiceTest, LayersAreForecastToo) {
    const auto ask = [&](const char* layers) {
        Request request = make_request(
            "POST", "/v1/render",
            R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],)"
            R"("radius":0.5}],"detail":"none","accuracy":{"rung":"single"},"image":{"width":2048,"height":1024,)"
            R"("format":"exr","precision":"float","layers":")" +
                std::string(layers) + "\"}}");
        request.deadline.until = Deadline::Clock::now() + std::chrono::milliseconds(1500);
        return service.answer(request);
    };
    EXPECT_NE(ask("none").reason, "hopeless");
    EXPECT_EQ(ask("all").reason, "hopeless");
}

TEST_F(ServiceTest, AMapThatCannotBeDoneInTimeIsRefusedAtOnce) {
    Request request = make_request("POST", "/v1/sky", kScene);
    request.query = {{"width", "8192"}};
    // Ten seconds of work.
    request.deadline.until = Deadline::Clock::now() + std::chrono::seconds(2);
    const auto start = Deadline::Clock::now();
    const Response response = service.answer(request);
    EXPECT_EQ(response.status, 504);
    EXPECT_EQ(response.reason, "hopeless");
    EXPECT_LT(ms_since(start), 1000);
    // The one that is offered can be had.
    const std::string offer = "ask for one of ";
    const std::size_t at = response.body.find(offer);
    ASSERT_NE(at, std::string::npos) << response.body;
    const int width = std::stoi(response.body.substr(at + offer.size()));
    EXPECT_GT(width, 500);
    EXPECT_LT(width, 8192);
    request.query = {{"width", std::to_string(width)}};
    request.deadline.until = Deadline::Clock::now() + test::patience(2);
    EXPECT_EQ(service.answer(request).status, 200);
}

TEST_F(ServiceTest, KeptAnswersCostNothing) {
    ServiceOptions options = with_fake({});
    options.cache_bytes = 1 << 20;
    Service keeping(thread, metrics, options);
    const auto ask = [&](const std::string& scene) {
        return keeping.answer(make_request("POST", "/v1/render", scene));
    };
    const Response first = ask(kMarched);
    EXPECT_EQ(first.header("Awan-Cache"), "miss");
    const Response again = ask(" " + kMarched);
    EXPECT_EQ(again.header("Awan-Cache"), "hit");
    EXPECT_FALSE(first.bytes().empty());
    EXPECT_EQ(again.shared, first.shared) << "it stands in memory once";
    for (const char* name : {"ETag", "Awan-Rung", "Awan-Error", "Content-Type"})
        EXPECT_EQ(again.header(name), first.header(name));
    EXPECT_EQ(renderer.begun(), 1);
    EXPECT_EQ(ask(kScene).header("Awan-Cache"), "miss") << "another scene";
    const std::string text = keeping.answer(make_request("GET", "/metrics")).body;
    EXPECT_NE(text.find("awan_cache_hits_total 1\n"), std::string::npos);
    EXPECT_NE(text.find("awan_cache_misses_total 2\n"), std::string::npos);
    EXPECT_NE(text.find("awan_cache_entries 2\n"), std::string::npos);
    EXPECT_EQ(post("/v1/render").header("Awan-Cache"), "") << "a service that keeps none";
}

TEST(KeptResult, CountsAllThatItHolds) {
    const auto of = [](std::string name, std::string value, std::size_t body) {
        return KeptResult{{{std::move(name), std::move(value)}},
                          std::make_shared<const std::string>(body, 'x')}
            .bytes();
    };
    const std::size_t least = of("", "", 0);
    EXPECT_GE(least, sizeof(KeptResult));
    EXPECT_EQ(of("Name", "", 0), least + 4);
    EXPECT_EQ(of("", "value", 0), least + 5);
    EXPECT_EQ(of("", "", 6), least + 6);
}

// --- deadlines

TEST_F(ServiceTest, PassedDeadlineIs504) {
    Request request = make_request("POST", "/v1/particles", kScene);
    request.deadline.until = Deadline::Clock::now() - std::chrono::seconds(1);
    expect_problem(service.answer(request), 504);
    request.path = "/v1/render";
    expect_problem(service.answer(request), 504);
    EXPECT_EQ(renderer.begun(), 0);
}

TEST_F(ServiceTest, RenderWhoseDeadlinePassesInTheQueueNeverBegins) {
    renderer.hold();
    std::thread running(
        [&] { EXPECT_EQ(service.answer(make_request("POST", "/v1/render", kScene)).status, 200); });
    EXPECT_TRUE(eventually([&] { return renderer.begun() == 1; }));
    Request late = make_request("POST", "/v1/render", kScene);
    late.deadline.until = Deadline::Clock::now() + std::chrono::milliseconds(100);
    expect_problem(service.answer(late), 504);
    renderer.release();
    running.join();
    EXPECT_EQ(renderer.begun(), 1);
}

TEST_F(ServiceTest, NobodyIsAnsweredWhoHasGone) {
    Request request = make_request("POST", "/v1/render", kScene);
    request.deadline.cancelled = std::make_shared<std::atomic<bool>>(true);
    const Response nothing = service.answer(request);
    EXPECT_TRUE(nothing.abandoned);
    EXPECT_EQ(nothing.status, 499) << "in metrics and log it is no failure of the server's";
    EXPECT_EQ(service.in_progress(), 0u);
}

TEST_F(ServiceTest, DrainingRefusesNewWorkOnly) {
    EXPECT_EQ(get("/readyz").status, 200);
    service.drain();
    const Response refused = post("/v1/plan");
    expect_problem(refused, 503);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    expect_problem(get("/readyz"), 503);
    EXPECT_EQ(get("/healthz").status, 200);
    EXPECT_EQ(get("/").status, 200);
    Request begun = make_request("POST", "/v1/plan", kScene);
    begun.admitted = true;
    EXPECT_EQ(service.answer(begun).status, 200);
}

class SmallMemory : public ServiceTest {
  protected:
    static ServiceOptions small() {
        ServiceOptions options;
        options.work_bytes = 10'000;
        return options;
    }
    SmallMemory() : ServiceTest(small()) {}
};

TEST_F(SmallMemory, IsSharedByRefusing) {
    const std::string large =
        R"({"cubes":[{"particles":5000,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
    const Response held = post("/v1/particles", large);
    ASSERT_EQ(held.status, 200) << "what is more than the whole budget runs alone";
    expect_problem(post("/v1/particles"), 429);
    expect_problem(post("/v1/render"), 429);
    EXPECT_FALSE(whole_body(held).empty());
}

TEST(WorkBudget, LeasesAreGivenBack) {
    WorkBudget budget(100);
    {
        const auto half = budget.take(50);
        EXPECT_TRUE(half);
        EXPECT_FALSE(budget.take(51));
        EXPECT_TRUE(budget.take(50));
        auto some = budget.take(20);
        EXPECT_TRUE(some.grow(30));
        EXPECT_FALSE(some.grow(1));
        EXPECT_EQ(budget.taken(), 100u);
    }
    EXPECT_EQ(budget.taken(), 0u);
    {
        auto alone = budget.take(20);
        EXPECT_TRUE(alone.grow(1'000'000)) << "what is more than all of it runs alone";
        EXPECT_FALSE(budget.take(1));
    }
    EXPECT_TRUE(budget.take(1'000'000));
    EXPECT_TRUE(budget.take(100));
}

// --- without a renderer

TEST(NoRenderer, EverythingButSplatsWorks) {
    Metrics metrics;
    RenderThread thread([]() -> Result<Renderer> {
        return Error{ErrorCode::kNoRenderer, "", "no EGL here"};
    });
    thread.wait_until_started();
    Service service(thread, metrics, {});
    const Response splats = service.answer(make_request("POST", "/v1/render", kScene));
    expect_problem(splats, 503);
    EXPECT_NE(splats.body.find("no EGL here"), std::string::npos);
    const Response marched = service.answer(make_request("POST", "/v1/render", kMarched));
    EXPECT_EQ(marched.status, 200) << marched.body;
    EXPECT_EQ(marched.header("Awan-Rung"), "transport-16");
    EXPECT_EQ(service.answer(make_request("POST", "/v1/plan", kScene)).status, 200);
    EXPECT_EQ(service.answer(make_request("POST", "/v1/particles", kScene)).status, 200);
    EXPECT_EQ(service.answer(make_request("GET", "/readyz")).status, 200);
    const Response version = service.answer(make_request("GET", "/version"));
    EXPECT_NE(version.body.find("no EGL here"), std::string::npos);
    // A scene that cannot be is told so even here.
    expect_problem(service.answer(make_request("POST", "/v1/render", "{}")), 422);
}

TEST(NoRenderer, ThrowingOpenerIsNoRenderer) {
    RenderThread thread([]() -> Result<Renderer> { throw std::runtime_error("driver"); });
    thread.wait_until_started();
    EXPECT_EQ(thread.info().reason, "driver");
}

TEST(RenderThread, ThrowingRenderIsAnInternalErrorWithoutDetails) {
    Metrics metrics;
    RenderThread thread([]() -> Result<Renderer> {
        Renderer renderer;
        renderer.render = [](const Scene&, Planned, const Deadline&) -> Result<Rendered> {
            throw std::runtime_error("secret");
        };
        return renderer;
    });
    Service service(thread, metrics, {});
    const Response response = service.answer(make_request("POST", "/v1/render", kScene));
    expect_problem(response, 500);
    EXPECT_EQ(response.body.find("secret"), std::string::npos);
    EXPECT_EQ(service.in_progress(), 0u);
}

// What failed once by the renderer's fault, say a lost context, must not fail for ever, nor give half a picture.
TEST(RenderThread, OpensTheRendererAgainAfterAFailure) {
    FakeRenderer fake;
    std::atomic<int> opened{0};
    std::atomic<int> failures{2};
    RenderThread thread([&]() -> Result<Renderer> {
        ++opened;
        Renderer renderer = *fake.opener()();
        const auto draw = renderer.render;
        renderer.render = [&, draw](const Scene& scene, Planned planned,
                                    const Deadline& deadline) -> Result<Rendered> {
            if (failures == 2) {
                --failures;
                return Error{ErrorCode::kInternal, "", "OpenGL error 0x0507 in draw"};
            }
            if (failures == 1) {
                --failures;
                throw std::bad_alloc();
            }
            return draw(scene, std::move(planned), deadline);
        };
        return renderer;
    });
    Metrics metrics;
    Service service(thread, metrics, {});
    const Request request = make_request("POST", "/v1/render", kScene);
    expect_problem(service.answer(request), 500);
    const Response no_memory = service.answer(request);
    expect_problem(no_memory, 503);
    EXPECT_FALSE(no_memory.header("Retry-After").empty());
    EXPECT_EQ(service.answer(request).status, 200);
    EXPECT_EQ(service.answer(request).status, 200);
    EXPECT_EQ(opened, 3);
    EXPECT_EQ(thread.reopened(), 2u);
}

TEST(Memory, ThatRunsOutIs503AndNotTheEnd) {
    FakeRenderer fake;
    RenderThread thread(fake.opener());
    Metrics metrics;
    ServiceOptions options;
    options.on_processor = [](const Scene&, Planned, int, const Progress&,
                              const Deadline&) -> Result<Rendered> { throw std::bad_alloc(); };
    Service service(thread, metrics, options);
    const Response response = service.answer(make_request("POST", "/v1/render", kMarched));
    expect_problem(response, 503);
    EXPECT_FALSE(response.header("Retry-After").empty());
    EXPECT_EQ(service.answer(make_request("POST", "/v1/plan", kMarched)).status, 200);
}

// With the device itself: a picture, and the renderer's name behind its tag.
TEST(RealRenderer, Renders) {
    Metrics metrics;
    RenderThread thread(device_renderer(DeviceChoice::kSoftware, 1));
    thread.wait_until_started();
    ASSERT_EQ(thread.info().state, RenderThread::Info::State::kReady) << thread.info().reason;
    Service service(thread, metrics, {});
    const Response response = service.answer(make_request("POST", "/v1/render", kScene));
    ASSERT_EQ(response.status, 200) << response.body;
    EXPECT_TRUE(response.body.starts_with("\x89PNG"));
    const Response again = service.answer(make_request("POST", "/v1/render", kScene));
    EXPECT_EQ(again.body, response.body);

    FakeRenderer fake;
    RenderThread fake_thread(fake.opener());
    Service other(fake_thread, metrics, {});
    EXPECT_NE(other.answer(make_request("POST", "/v1/render", kScene)).header("ETag"),
              response.header("ETag"));
}

}  // namespace
}  // namespace awan::test
