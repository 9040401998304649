// What the service has beside scenes: pages, presets, the contract, metrics; and its small rules.
#include <gtest/gtest.h>

#include "core/base/embedded.h"
#include "core/pipeline.h"
#include "server/document/scene_text.h"
#include "server/service/negotiation.h"
#include "server/service/pages.h"
#include "server/service/problem.h"
#include "service_fixture.h"
#include "tests/gzip.h"

namespace awan::test {
namespace {

// --- pages, presets, contract, metrics

TEST_F(ServiceTest, PagesAreStrictAboutScripts) {
    const Response page = get("/");
    ASSERT_EQ(page.status, 200);
    EXPECT_EQ(page.header("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(page.header("Cache-Control"), "no-cache");
    EXPECT_EQ(page.header("Referrer-Policy"), "same-origin");
    EXPECT_EQ(page.header("Content-Security-Policy"), kContentSecurityPolicy);
    EXPECT_EQ(get("/index.html").body, page.body);
    EXPECT_EQ(get("/", {{"If-None-Match", std::string(page.header("ETag"))}}).status, 304);
    for (const EmbeddedFile& file : web_files()) {
        const Response response = get("/" + std::string(file.name));
        EXPECT_EQ(response.status, 200) << file.name;
        // The contract has the scene's part from the tables of core/scene.
        if (file.name != "openapi.json") {
            EXPECT_EQ(response.body, file.text);
        }
        EXPECT_NE(response.header("Content-Type"), "application/octet-stream") << file.name;
    }
}

// Packed once, as small as zlib can, and the same text for whoever does not take it.
TEST_F(ServiceTest, PagesArePackedBefore) {
    std::size_t packed = 0;
    for (const Page& page : make_pages()) {
        if (page.packed.empty()) {
            EXPECT_LT(page.text.size(), 1024U) << page.path;
            continue;
        }
        ++packed;
        const Response response = get(page.path, {{"Accept-Encoding", "br, gzip"}});
        EXPECT_EQ(response.header("Content-Encoding"), "gzip") << page.path;
        EXPECT_EQ(response.body, gzip(page.text)) << page.path;
        const std::string etag(response.header("ETag"));
        EXPECT_TRUE(etag.ends_with("-gzip\"")) << etag;
        EXPECT_EQ(get(page.path, {{"If-None-Match", etag}}).status, 304);
        const Response plain = get(page.path, {{"Accept-Encoding", "gzip;q=0"}});
        EXPECT_EQ(plain.body, page.text);
        EXPECT_EQ(plain.header("Content-Encoding"), "");
    }
    EXPECT_GT(packed, 5U);
}

TEST_F(ServiceTest, EveryPresetIsListedAndCanBe) {
    std::size_t documents = 0;
    for (const EmbeddedFile& file : preset_files())
        documents += file.name != "presets/index.json";
    const std::vector<Preset> presets = make_presets();
    EXPECT_EQ(presets.size(), documents) << "a document is missing in web/presets/index.json";
    const Response list = get("/v1/presets");
    for (const Preset& preset : presets) {
        const std::string path = "/v1/presets/" + std::string(preset.entry.name);
        EXPECT_NE(list.body.find("\"href\":\"" + path + "\""), std::string::npos);
        EXPECT_NE(list.body.find("\"title\":\"" + std::string(preset.entry.title) + "\""),
                  std::string::npos);
        const Response document = get(path);
        EXPECT_EQ(document.header("Content-Type"), "application/json");
        EXPECT_EQ(get(path, {{"If-None-Match", std::string(document.header("ETag"))}}).status, 304);
        EXPECT_EQ(post("/v1/particles", document.body, {{"If-None-Match", "*"}}).status, 304)
            << document.body;
    }
}

TEST_F(ServiceTest, ContractNamesEveryRoute) {
    const Response contract = get("/openapi.json");
    ASSERT_EQ(contract.status, 200);
    EXPECT_EQ(contract.header("Content-Type"), "application/json");
    for (const char* path : {"/v1/particles", "/v1/render", "/v1/plan", "/v1/accuracy", "/v1/jobs",
                             "/v1/jobs/{id}/events", "/v1/presets", "/v1/presets/{name}",
                             "/healthz", "/readyz", "/metrics", "/version", "/openapi.json", "/"})
        EXPECT_NE(contract.body.find("    \"" + std::string(path) + "\": {"), std::string::npos)
            << path;
    std::string rungs;
    for (const Rung& rung : ladder())
        rungs += (rungs.empty() ? "\"" : ",\"") + std::string(rung.name) + '"';
    EXPECT_NE(contract.body.find("\"enum\":[" + rungs + "]"), std::string::npos);
    EXPECT_NE(contract.body.find("\"version\": \"" + std::string(engine_version()) + "\""),
              std::string::npos);
}

TEST_F(ServiceTest, MetricsCountByRouteAndNeverByWhatClientsWrite) {
    get("/healthz");
    get("/made-up-path");
    get("/v1/presets/cumulus");
    post("/v1/render");
    post("/v1/render", "{}");
    const std::string text = get("/metrics").body;
    for (const char* line :
         {"awan_http_requests_total{route=\"/healthz\",status=\"200\"} 1\n",
          "awan_http_requests_total{route=\"other\",status=\"404\"} 1\n",
          "awan_http_requests_total{route=\"/v1/presets/{name}\",status=\"200\"} 1\n",
          "awan_http_requests_total{route=\"/v1/render\",status=\"200\"} 1\n",
          "awan_http_requests_total{route=\"/v1/render\",status=\"422\"} 1\n",
          "awan_http_request_duration_seconds_bucket{route=\"/v1/render\",le=\"+Inf\"} 2\n",
          "awan_stage_duration_seconds_count{stage=\"encode\"} 1\n", "awan_in_progress 0\n",
          "awan_lanes{of=\"processor\"} 2\n", "awan_cache_hits_total 0\n", "awan_ready 1\n",
          "process_resident_memory_bytes "})
        EXPECT_NE(text.find(line), std::string::npos) << line;
    EXPECT_EQ(text.find("made-up"), std::string::npos);
    EXPECT_GT(resident_bytes(), 1u << 20);
}

// --- negotiation

TEST(Accept, BestOfferIsThatOfHighestQualityThenFirst) {
    const std::string_view offers[] = {"a/x", "a/y", "b/z"};
    const auto best = [&](std::string_view accept) {
        return std::string(best_offer(accept, offers).value_or("none"));
    };
    EXPECT_EQ(best(""), "a/x");
    EXPECT_EQ(best("*/*"), "a/x");
    EXPECT_EQ(best("a/y"), "a/y");
    EXPECT_EQ(best("A/Y"), "a/y");
    EXPECT_EQ(best("a/*;q=0.5, b/z"), "b/z");
    EXPECT_EQ(best("a/x;q=0, */*"), "a/y") << "the most specific range decides";
    EXPECT_EQ(best("a/x;q=0.2,a/y;q=0.8;v=1"), "a/y");
    EXPECT_EQ(best("a/x;q=0.001, b/z;q=0.002"), "b/z");
    EXPECT_EQ(best("a/x;v=\"1,2\";q=0.1, a/y;q=0.2"), "a/y");
    EXPECT_EQ(best("a/x;q=0.19, b/z;q=0.91"), "b/z") << "each digit has its own weight";
    EXPECT_EQ(best("a/x;q=0.29, b/z;q=0.3"), "b/z");
    EXPECT_EQ(best("c/c"), "none");
    EXPECT_EQ(best("*/*;q=0"), "none");
    EXPECT_EQ(best(",,;,"), "none");
}

TEST(Tags, PartsDoNotRunIntoOneAnother) {
    EXPECT_EQ(make_etag({"ab", "c"}), make_etag({"ab", "c"}));
    EXPECT_NE(make_etag({"ab", "c"}), make_etag({"a", "bc"}));
    EXPECT_NE(make_etag({"ab", ""}), make_etag({"", "ab"}));
    EXPECT_NE(make_etag({"ab"}), make_etag({"ab", ""}));
}

TEST(SceneText, FormatIsSeenFromTheFirstBytes) {
    EXPECT_EQ(sniff_scene_format(" \n{\"cubes\":[]}"), SceneFormat::kJson);
    EXPECT_EQ(sniff_scene_format("ply\nformat ascii 1.0\n"), SceneFormat::kPly);
    EXPECT_EQ(sniff_scene_format("x,y,z,radius\n"), SceneFormat::kCsv);
    EXPECT_EQ(sniff_scene_format("200\n1\n6.1e-007, 1"), SceneFormat::kAwn);
    EXPECT_EQ(sniff_scene_format("200 1 6\n6.1e-007 1 6\n"), SceneFormat::kCsv);
    EXPECT_EQ(scene_format_of_name("a.AWN"), SceneFormat::kAwn);
    EXPECT_EQ(scene_format_of_name("json"), std::nullopt);
}

TEST(Errors, ExitCodesAreThoseOfTheContract) {
    EXPECT_EQ(exit_code_of(ErrorCode::kMalformed), 3);
    EXPECT_EQ(exit_code_of(ErrorCode::kUnsupported), 3);
    EXPECT_EQ(exit_code_of(ErrorCode::kNoRenderer), 4);
    EXPECT_EQ(exit_code_of(ErrorCode::kOutOfMemory), 4);
    EXPECT_EQ(status_of(ErrorCode::kOutOfMemory), 503);
    EXPECT_EQ(exit_code_of(ErrorCode::kIo), 5);
}

}  // namespace
}  // namespace awan::test
