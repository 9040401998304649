// Requests as people's programs send them: queries, forms, packed bodies, paths with a slash too many.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "server/document/problem_page.h"
#include "server/document/text_bytes.h"
#include "server/service/forms.h"
#include "server/service/negotiation.h"
#include "service_fixture.h"
#include "tests/gzip.h"

namespace awan::test {
namespace {

using Query = std::vector<std::pair<std::string, std::string>>;
using SceneRequestTest = ServiceTest;

constexpr const char* kTable = "X;Y;Z;Width;Mass\n0;0;0;1;7\n1;0;0;1;7\n";

Response ask(Service& service, const std::string& path, Query query,
             const std::string& body = kScene,
             Headers headers = {{"Content-Type", "application/json"}}) {
    Request request = make_request("POST", path, body, std::move(headers));
    request.query = std::move(query);
    return service.answer(request);
}

// --- queries

TEST_F(SceneRequestTest, AQueryTakesThePlaceOfTheDocument) {
    const Response plain = post("/v1/render");
    const Response wide = ask(service, "/v1/render", {{"width", "32"}, {"height", "20"}});
    ASSERT_EQ(wide.status, 200) << wide.body;
    // The size of a PNG stands at byte 16.
    EXPECT_EQ(wide.body.substr(16, 8), std::string("\0\0\0\x20\0\0\0\x14", 8));
    EXPECT_NE(wide.header("ETag"), plain.header("ETag"));
    EXPECT_EQ(ask(service, "/v1/render", {{"format", "exr"}}).header("Content-Type"),
              "image/x-exr");
    EXPECT_EQ(ask(service, "/v1/particles", {{"format", "csv"}}).header("Content-Type"),
              "text/csv");
    const Response other = ask(service, "/v1/particles", {{"seed", "8"}});
    EXPECT_NE(other.body.find("\"seed\":8"), std::string::npos);
    EXPECT_EQ(ask(service, "/v1/plan", {{"rung", "transport-16"}}).status, 200);
}

TEST_F(SceneRequestTest, AQueryIsNeverIgnored) {
    for (const char* const path : {"/v1/render", "/v1/particles", "/v1/plan", "/v1/accuracy"}) {
        const Response unknown = ask(service, path, {{"hight", "20"}});
        expect_problem(unknown, 400);
        EXPECT_NE(unknown.body.find("hight"), std::string::npos);
        EXPECT_NE(unknown.body.find("height"), std::string::npos);
        expect_problem(ask(service, path, {{"width", "0"}}), 400);
        expect_problem(ask(service, path, {{"seed", "1"}, {"seed", "2"}}), 400);
        expect_problem(ask(service, path, {{"format", "tiff"}}), 400);
        expect_problem(ask(service, path, {{"radius", "1"}}), 422);
    }
    expect_problem(ask(service, "/v1/plan", {{"format", "png"}}), 400);
}

TEST_F(SceneRequestTest, TablesAreReadAndWhatWasTakenForWhatIsSaid) {
    const Response response =
        ask(service, "/v1/particles", {{"format", "csv"}}, kTable, {{"Content-Type", "text/csv"}});
    ASSERT_EQ(response.status, 200) << response.body;
    EXPECT_EQ(response.body.substr(response.body.find('\n') + 1, 9), "0,0,0,0.5");
    EXPECT_NE(response.header("Awan-Notes").find("widths"), std::string::npos);
    EXPECT_NE(response.header("Awan-Notes").find("not used: \"Mass\""), std::string::npos);
    EXPECT_EQ(post("/v1/particles").header("Awan-Notes"), "");
    const Response bare = ask(service, "/v1/particles", {{"radius", ".25"}, {"format", "csv"}},
                              "x,y,z\n1,2,3\n", {{"Content-Type", "text/csv"}});
    ASSERT_EQ(bare.status, 200) << bare.body;
    EXPECT_NE(bare.body.find("1,2,3,0.25"), std::string::npos);
}

TEST_F(SceneRequestTest, ParticlesMayHaveTheirLight) {
    const Headers json{{"Content-Type", "application/json"}};
    const char* const scene =
        R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
    const Response bare = ask(service, "/v1/particles", {{"format", "ply"}}, scene, json);
    const Response lit = ask(service, "/v1/particles", {{"light", "1"}}, scene, json);
    ASSERT_EQ(lit.status, 200) << lit.body;
    EXPECT_EQ(lit.header("Awan-Particles"), "20");
    EXPECT_NE(lit.header("Awan-Exposure"), "");
    EXPECT_EQ(bare.header("Awan-Exposure"), "");
    EXPECT_NE(lit.header("ETag"), bare.header("ETag"));
    const std::size_t head = lit.body.find("end_header\n") + 11;
    EXPECT_NE(lit.body.find("property float light_blue\nend_header\n"), std::string::npos);
    ASSERT_EQ(lit.body.size(), head + 20 * 56);
    for (std::size_t i = 0; i < 20; ++i) {
        float red = 0;
        std::memcpy(&red, lit.body.data() + head + 56 * i + 44, sizeof red);
        EXPECT_GT(red, 0) << i;
        EXPECT_TRUE(std::isfinite(red)) << i;
    }
    // It comes back in as particles do; the light is not read.
    const Response again = post("/v1/particles", lit.body, {}, "application/x-ply");
    EXPECT_NE(again.header("Awan-Notes").find("light_red"), std::string::npos);
    EXPECT_EQ(ask(service, "/v1/particles", {{"format", "ply"}, {"light", "0"}}, scene, json).body,
              bare.body);

    for (const Query& query :
         {Query{{"format", "ply"}, {"light", "yes"}}, Query{{"format", "json"}, {"light", "1"}},
          Query{{"format", "ply"}, {"light", "1"}, {"light", "1"}}})
        expect_problem(ask(service, "/v1/particles", query, scene, json), 400);
    expect_problem(ask(service, "/v1/plan", {{"light", "1"}}, scene, json), 400);
    expect_problem(ask(service, "/v1/particles", {{"light", "1"}}, scene,
                       {{"Content-Type", "application/json"}, {"Accept", "text/csv"}}),
                   406);
    const char* const look =
        R"({"clouds":[{"model":"ellipsoids","ellipsoids":{}}],"look":"gardner"})";
    expect_problem(ask(service, "/v1/particles", {{"light", "1"}}, look, json), 422, "/look");
}

TEST_F(SceneRequestTest, PreviewsStateNoError) {
    const Headers json{{"Content-Type", "application/json"}};
    const auto scene = [](const char* accuracy) {
        return std::string(
                   R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],)"
                   R"("image":{"width":24,"height":16})") +
               accuracy + "}";
    };
    // Without a wish, by name, by error and by time.
    for (const char* const accuracy :
         {"", R"(,"accuracy":{"rung":"transport-16"})", R"(,"accuracy":{"error":0.02})",
          R"(,"accuracy":{"time_ms":5000})", R"(,"accuracy":{"rung":"single"})"}) {
        const Response whole = ask(service, "/v1/render", {}, scene(accuracy), json);
        const Response preview =
            ask(service, "/v1/render", {{"preview", "1"}}, scene(accuracy), json);
        ASSERT_EQ(whole.status, 200) << whole.body;
        ASSERT_EQ(preview.status, 200) << preview.body;
        EXPECT_NE(whole.header("Awan-Error"), "") << accuracy;
        EXPECT_EQ(preview.header("Awan-Error"), "") << accuracy;
        EXPECT_EQ(preview.header("Awan-Error-Forecast"), "") << accuracy;
        EXPECT_NE(preview.header("Awan-Rung"), "") << accuracy;
        EXPECT_NE(preview.header("ETag"), whole.header("ETag")) << accuracy;
        EXPECT_EQ(ask(service, "/v1/render", {{"preview", "0"}}, scene(accuracy), json).body,
                  whole.body)
            << accuracy;
    }
    for (const Query& query : {Query{{"preview", "yes"}}, Query{{"preview", ""}},
                               Query{{"preview", "1"}, {"preview", "1"}}})
        expect_problem(ask(service, "/v1/render", query, scene(""), json), 400);
    expect_problem(ask(service, "/v1/plan", {{"preview", "1"}}, scene(""), json), 400);
}

TEST_F(SceneRequestTest, AnAnswerComesBackIn) {
    const std::string answer = whole_body(post("/v1/particles"));
    const Response again = post("/v1/particles", answer);
    ASSERT_EQ(again.status, 200) << again.body;
    EXPECT_EQ(whole_body(again), answer);
    EXPECT_EQ(post("/v1/render", answer).status, 200);
}

TEST_F(SceneRequestTest, TypesHaveOtherNames) {
    EXPECT_EQ(post("/v1/plan", kScene, {}, "application/vnd.awan+json").status, 200);
    EXPECT_EQ(post("/v1/plan", kScene, {}, "text/json; charset=utf-8").status, 200);
    const std::string ply =
        whole_body(post("/v1/particles", kScene, {{"Accept", "application/ply"}}));
    EXPECT_EQ(ply.substr(0, 4), "ply\n");
    for (const char* const type : {"application/ply", "model/ply", "application/x-ply"})
        EXPECT_EQ(post("/v1/particles", ply, {}, type).status, 200) << type;
    EXPECT_EQ(post("/v1/render", kScene, {{"Accept", "image/openexr"}}).header("Content-Type"),
              "image/x-exr");
    expect_problem(post("/v1/plan", kScene, {}, "application/xml"), 415);
}

TEST_F(SceneRequestTest, LayersComeAsExrAndAreRefusedAsPng) {
    const std::string layered =
        R"({"cubes":[],"image":{"width":4,"height":4,"layers":"all"},"accuracy":{"rung":"single"}})";
    const Headers json = {{"Content-Type", "application/json"}};
    EXPECT_EQ(ask(service, "/v1/render", {}, layered).header("Content-Type"), "image/x-exr");
    EXPECT_EQ(ask(service, "/v1/render", {{"layers", "depth"}, {"rung", "single"}})
                  .header("Content-Type"),
              "image/x-exr");
    const Headers png = {{"Content-Type", "application/json"}, {"Accept", "image/png"}};
    expect_problem(ask(service, "/v1/render", {}, layered, png), 406, "/image/layers");
    expect_problem(ask(service, "/v1/render", {{"format", "png"}}, layered), 400, "/image/layers");
    EXPECT_EQ(ask(service, "/v1/render", {{"layers", "none"}}, layered, png).status, 200);
    expect_problem(ask(service, "/v1/render", {{"layers", "sum"}}, layered, json), 400);
    // The document's rung is harris.
    expect_problem(ask(service, "/v1/render", {{"layers", "sun"}}), 422, "/image/layers");
    EXPECT_EQ(ask(service, "/v1/plan", {}, layered).status, 200);
}

TEST_F(SceneRequestTest, TheSkyComesAsAMap) {
    const Response map = ask(service, "/v1/sky", {{"width", "16"}});
    ASSERT_EQ(map.status, 200) << map.body;
    EXPECT_EQ(map.header("Content-Type"), "image/x-exr");
    EXPECT_NE(map.body.find("awan:sun_direction"), std::string::npos);
    const Response png = ask(service, "/v1/sky", {{"width", "16"}, {"format", "png"}});
    EXPECT_EQ(png.header("Content-Type"), "image/png");
    // Its size, at byte 16.
    EXPECT_EQ(png.body.substr(16, 8), std::string("\0\0\0\x10\0\0\0\x08", 8));
    EXPECT_NE(map.header("ETag"), ask(service, "/v1/sky", {{"width", "18"}}).header("ETag"));
    for (const char* const width : {"15", "0", "8194"})
        expect_problem(ask(service, "/v1/sky", {{"width", width}}), 400);
    // What would mean nothing is not ignored.
    expect_problem(ask(service, "/v1/sky", {{"rung", "harris"}}), 400);
    expect_problem(ask(service, "/v1/sky", {{"format", "csv"}}), 400);
}

TEST_F(SceneRequestTest, WhatAMapHasNotIsRefusedInAFormToo) {
    const std::string form = "--X\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n" +
                             std::string(kScene) +
                             "\r\n--X\r\nContent-Disposition: form-data; name=\"";
    const Headers type = {{"Content-Type", "multipart/form-data; boundary=X"}};
    EXPECT_EQ(ask(service, "/v1/sky", {}, form + "width\"\r\n\r\n16\r\n--X--\r\n", type).status,
              200);
    const Response seed = ask(service, "/v1/sky", {}, form + "seed\"\r\n\r\n16\r\n--X--\r\n", type);
    expect_problem(seed, 400);
    EXPECT_NE(seed.body.find("seed"), std::string::npos);
}

TEST_F(SceneRequestTest, PresetsAreFoundByTheirGenusToo) {
    EXPECT_EQ(get("/v1/presets/cumulus-congestus").body, get("/v1/presets/congestus").body);
    expect_problem(get("/v1/presets/cumulus-nimbus"), 404);
}

TEST_F(SceneRequestTest, ASlashTooManyIsAnotherPath) {
    Request request = make_request("POST", "/v1/render/", kScene);
    request.query = {{"width", "8"}, {"rung", "a b"}};
    const Response moved = service.answer(request);
    EXPECT_EQ(moved.status, 308);
    EXPECT_EQ(moved.header("Location"), "/v1/render?width=8&rung=a%20b");
    EXPECT_EQ(get("/v1/presets/").header("Location"), "/v1/presets");
    expect_problem(get("/nowhere/"), 404);
    expect_problem(get("/v1/render//"), 404);
}

// --- packed

TEST_F(SceneRequestTest, PackedBodiesAreTakenAndBounded) {
    const Headers packed = {{"Content-Encoding", "gzip"}};
    EXPECT_EQ(whole_body(post("/v1/particles", test::gzip(kScene), packed)),
              whole_body(post("/v1/particles")));
    expect_problem(post("/v1/particles", kScene, packed), 400);
    // A hundred million blanks in a hundred thousand bytes.
    expect_problem(post("/v1/particles", test::gzip(std::string(110u << 20, ' ')), packed), 413);
}

TEST_F(SceneRequestTest, AnswersArePackedForThoseWhoTakeThem) {
    const Headers takes = {{"Accept-Encoding", "gzip, deflate, br"}};
    const Response plain = post("/v1/particles"), packed = post("/v1/particles", kScene, takes);
    EXPECT_EQ(plain.header("Content-Encoding"), "");
    EXPECT_EQ(packed.header("Content-Encoding"), "gzip");
    EXPECT_NE(packed.header("Vary").find("Accept-Encoding"), std::string::npos);
    EXPECT_NE(packed.header("ETag"), plain.header("ETag"));
    EXPECT_EQ(*gunzip(packed.body, 1 << 20), plain.body);
    for (const Response* const known : {&plain, &packed})
        EXPECT_EQ(post("/v1/particles", kScene,
                       {{"If-None-Match", std::string(known->header("ETag"))},
                        {"Accept-Encoding", "gzip"}})
                      .status,
                  304);
    // Pictures are packed already.
    EXPECT_EQ(post("/v1/render", kScene, takes).header("Content-Encoding"), "");
    EXPECT_EQ(get("/openapi.json", takes).header("Content-Encoding"), "gzip");
    // Long answers come in pieces.
    const std::string many =
        R"({"cubes":[{"particles":20000,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]})";
    const Response stream = post("/v1/particles", many, takes);
    ASSERT_TRUE(stream.stream);
    EXPECT_EQ(*gunzip(whole_body(stream), 1 << 24), whole_body(post("/v1/particles", many)));
}

TEST(TakesGzip, ByQuality) {
    for (const char* const yes :
         {"gzip", "GZIP", "br, gzip;q=0.5", "*", "x-gzip", "deflate, *;q=0.1"})
        EXPECT_TRUE(takes_gzip(yes)) << yes;
    for (const char* const no :
         {"", "br", "gzip;q=0", "*, gzip;q=0", "identity", "gzippy", "*;q=0"})
        EXPECT_FALSE(takes_gzip(no)) << no;
}

// --- forms

TEST_F(SceneRequestTest, FormsCarryASceneAndTheQuerysNames) {
    const std::string multipart =
        "preamble\r\n--xx\r\nContent-Disposition: form-data; name=\"scene\"; "
        "filename=\"a;b.csv\"\r\n"
        "Content-Type: application/octet-stream\r\n\r\nx,y,z\r\n0,0,0\r\n\r\n--xx\r\n"
        "Content-Disposition: form-data; name=radius\r\n\r\n.5\r\n--xx\r\n"
        "content-disposition: form-data; name=\"width\"\r\n\r\n\r\n--xx--\r\n";
    const Response files = ask(service, "/v1/particles", {{"format", "csv"}}, multipart,
                               {{"Content-Type", "multipart/form-data; boundary=xx"}});
    ASSERT_EQ(files.status, 200) << files.body;
    EXPECT_NE(files.body.find("0,0,0,0.5"), std::string::npos);

    std::string encoded = "seed=8&scene=";
    for (const char c : std::string(kScene))
        encoded += c == '"' ? "%22" : c == ' ' ? "+" : std::string(1, c);
    const Headers urlencoded = {{"Content-Type", "application/x-www-form-urlencoded"}};
    const Response field = ask(service, "/v1/particles", {}, encoded, urlencoded);
    ASSERT_EQ(field.status, 200) << field.body;
    EXPECT_EQ(whole_body(field), whole_body(ask(service, "/v1/particles", {{"seed", "8"}})));
    const Response layout =
        ask(service, "/v1/particles", {}, "layout=20%0A1%0A20+2+1+2+0+0+0+.5", urlencoded);
    EXPECT_EQ(layout.status, 200) << layout.body;
}

// As a page without scripts sends it: a text area and a file of which one is left empty, places in the document, of
// which those left empty say nothing.
TEST_F(SceneRequestTest, FieldsOfAFormStandForPlacesInTheDocument) {
    const Headers urlencoded = {{"Content-Type", "application/x-www-form-urlencoded"}};
    const std::string layout = "scene=20%0A1%0A20+2+1+2+0+0+0+.5&layout=";
    const Response form = ask(service, "/v1/render", {},
                              layout +
                                  "&width=16&height=8&rung=harris&%2Fsun%2Felevation=12&"
                                  "%2Fsun%2Fazimuth=&%2Fcamera%2Feye=12%2C+3%2C+20&"
                                  "%2Fcamera%2Ftarget=0%2C0%2C0&%2Fsky=none",
                              urlencoded);
    ASSERT_EQ(form.status, 200) << form.body;
    const Response document =
        ask(service, "/v1/render", {},
            R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],)"
            R"("sun":{"elevation":12},"camera":{"eye":[12,3,20],"target":[0,0,0]},"sky":"none",)"
            R"("image":{"width":16,"height":8},"accuracy":{"rung":"harris"}})");
    EXPECT_EQ(form.header("ETag"), document.header("ETag"));
    const auto wrong = [&](const std::string& field, const std::string& word) {
        const Response response = ask(service, "/v1/render", {}, layout + field, urlencoded);
        expect_problem(response, 422);
        EXPECT_NE(response.body.find(word), std::string::npos) << response.body;
    };
    wrong("&%2Fsun%2Felevation=200", "/sun/elevation");
    wrong("&%2Fsun%2Felevation=high", "/sun/elevation");
    wrong("&%2Fsun%2Fheight=2", "/sun/height");
    wrong("&%2Fcamera%2Feye=1%2C2%2C3", "target");
    wrong("&%2Fcamera%2Feye=1%2C2", "/camera/eye");
    // A file takes the place of the text.
    const Response file =
        ask(service, "/v1/particles", {},
            "--x\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n5\n1\n5 1 1 1 0 0 0 1"
            "\r\n--x\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"s.json\""
            "\r\n\r\n" +
                std::string(kScene) + "\r\n--x--\r\n",
            {{"Content-Type", "multipart/form-data; boundary=x"}});
    EXPECT_EQ(whole_body(file), whole_body(post("/v1/particles")));
}

TEST_F(SceneRequestTest, BrowsersAreShownProblemsAsPages) {
    const std::string browsers = "text/html,application/xhtml+xml,image/webp,*/*;q=0.8";
    const Headers form = {{"Content-Type", "application/x-www-form-urlencoded"},
                          {"Accept", browsers}};
    const Response picture = ask(service, "/v1/render", {}, "scene=1%0A1%0A1+1+1+1+0+0+0+1", form);
    EXPECT_EQ(picture.header("Content-Type"), "image/png");
    const Response wrong = ask(
        service, "/v1/render", {},
        "scene=1%0A1%0A1+1+1+1+0+0+0+1&%2Fsun%2Fcolor=%3Cscript%3Ealert%281%29%3C/script%3E", form);
    EXPECT_EQ(wrong.status, 422);
    EXPECT_EQ(wrong.header("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(wrong.header("Vary"), "Accept");
    EXPECT_EQ(wrong.header("Cache-Control"), "no-store");
    EXPECT_NE(wrong.header("Content-Security-Policy").find("default-src 'none'"),
              std::string_view::npos);
    EXPECT_NE(wrong.body.find("/sun/color"), std::string::npos) << wrong.body;
    EXPECT_EQ(wrong.body.find("<script"), std::string::npos) << wrong.body;
    const Response lost = get("/<b>nowhere", {{"Accept", browsers}});
    EXPECT_EQ(lost.status, 404);
    EXPECT_NE(lost.body.find("<h1>Not Found</h1>"), std::string::npos);
    EXPECT_EQ(lost.body.find("<b>"), std::string::npos);
    // Programs get what they always got.
    for (const std::string accept :
         {"", "*/*", "application/json", "image/png", "application/problem+json, text/html"})
        expect_problem(get("/nowhere", {{"Accept", accept}}), 404);
    const std::string text = problem_page(R"({"detail":"<a href='x'>\"&","status":"<i>"})");
    EXPECT_NE(text.find("&lt;a href=&#39;x&#39;&gt;&quot;&amp;"), std::string::npos) << text;
    EXPECT_NE(text.find("&quot;&lt;i&gt;&quot;"), std::string::npos) << text;
}

TEST_F(SceneRequestTest, FormsThatCannotBeAreRefused) {
    const Headers urlencoded = {{"Content-Type", "application/x-www-form-urlencoded"}};
    const auto refused = [&](const std::string& body, const std::string& word,
                             const Headers& headers) {
        const Response response = ask(service, "/v1/particles", {}, body, headers);
        expect_problem(response, 400);
        EXPECT_NE(response.body.find(word), std::string::npos) << response.body;
    };
    const Response json = ask(service, "/v1/particles", {}, kScene, urlencoded);
    expect_problem(json, 415);
    EXPECT_NE(json.body.find("application/json"), std::string::npos);
    refused("seed=8", "`scene`", urlencoded);
    refused("scene={}&colour=red", "colour", urlencoded);
    refused("scene={}&layout={}", "more than one", urlencoded);
    refused(std::string(1000, '&') + "a=1", "there is no field", urlencoded);
    std::string many;
    for (int i = 0; i < 100; ++i) many += "width=&";
    refused(many, "64", urlencoded);
    const auto multipart = [&](const std::string& body, const std::string& word,
                               const std::string& boundary = "xx") {
        refused(body, word, {{"Content-Type", "multipart/form-data; boundary=" + boundary}});
    };
    multipart("--xx", "behind a boundary");
    multipart("", "boundary");
    multipart("--xx--\r\n", "`scene`");
    multipart("--xx\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n{}", "no end");
    multipart("--xx\r\nContent-Disposition: form-data; name=\"scene\"\r\n--xx--",
              "no end of its head");
    multipart("--xx\r\n\r\n{}\r\n--xx--", "no name");
    multipart("{}", "boundary", "");
}

}  // namespace
}  // namespace awan::test
