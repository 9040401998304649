// /v1/textures, and scenes that name what was uploaded or comes in a form.
#include <gtest/gtest.h>

#include "core/formats/image_file.h"
#include "core/scene/limits.h"
#include "core/scene/texture.h"
#include "server/limits.h"
#include "server/service/texture_store.h"
#include "service_fixture.h"

namespace awan {
namespace {

using test::expect_problem;
using test::make_request;

// A square of so much alpha all over.
std::string picture(float alpha) {
    Image image{8, 8, false, {}};
    image.pixels.assign(4 * image.pixel_count(), alpha);
    return encode_png(image, {0, Tone::kNeutral}).value();
}

std::string painted(const std::string& texture) {
    return R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5,"texture":")" +
           texture + R"("}],"image":{"width":16,"height":8}})";
}

std::string member(const std::string& json, const std::string& name) {
    const std::string begin = '"' + name + "\":\"";
    const std::size_t at = json.find(begin);
    if (at == std::string::npos) return {};
    return json.substr(at + begin.size(), json.find('"', at + begin.size()) - at - begin.size());
}

class TextureRoutes : public test::ServiceTest {
  protected:
    Response ask(const char* method, const std::string& name, const std::string& body = "") {
        return service.answer(make_request(method, "/v1/textures/" + name, body, {}));
    }
};

TEST_F(TextureRoutes, OwnTexturesAreListedAndShown) {
    const Response list = get("/v1/textures");
    EXPECT_EQ(list.status, 200);
    for (const OwnTexture& own : kOwnTextures) {
        EXPECT_NE(list.body.find(own.hash), std::string::npos);
        const Response shown = get(std::string("/v1/textures/") + own.name);
        EXPECT_EQ(shown.status, 200);
        EXPECT_EQ(shown.header("Content-Type"), "image/png");
        EXPECT_EQ(get(std::string("/v1/textures/") + own.hash).body, shown.body);
        EXPECT_EQ(get(std::string("/v1/textures/") + own.name,
                      {{"If-None-Match", std::string(shown.header("ETag"))}})
                      .status,
                  304);
        expect_problem(ask("DELETE", own.name), 403);
        expect_problem(ask("PUT", own.name, picture(1)), 422);
    }
    expect_problem(get("/v1/textures/mine"), 404);
}

// A square whose luminance rises from left to right, its alpha 1 all over.
std::string rising() {
    Image image{16, 16, false, {}};
    for (int i = 0; i < 16 * 16; ++i) {
        const float one = static_cast<float>(i % 16) / 15;
        image.pixels.insert(image.pixels.end(), {one, one, one, 1.0F});
    }
    return encode_png(image, {0, Tone::kNeutral}).value();
}

TEST_F(TextureRoutes, OneThatIsPutIsAHeightMap) {
    const auto over = [](const std::string& map) {
        return R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,4,0],"radius":0.5}],)"
               R"("ground":{"terrain":{"height":3,"extent":40,"map":")" +
               map +
               R"("}},"camera":{"eye":[0,6,15],"target":[0,1,0]},"image":{"width":24,"height":16},"accuracy":{"rung":"transport-16"}})";
    };
    expect_problem(post("/v1/plan", over("slope")), 422, "/ground/terrain/map");
    const Response put = ask("PUT", "slope", rising());
    ASSERT_EQ(put.status, 201) << put.body;
    const Response plan = post("/v1/plan", over("slope"));
    EXPECT_EQ(plan.status, 200) << plan.body;
    EXPECT_NE(plan.body.find("the ground has hills"), std::string::npos);
    const Response first = post("/v1/render", over("slope"));
    EXPECT_EQ(first.status, 200) << first.body;
    // Though its alpha, which makes a texture, is the same everywhere, its heights are not.
    const Response level = post("/v1/render", over("hard"));
    EXPECT_NE(first.header("ETag"), level.header("ETag"));
    EXPECT_EQ(post("/v1/render", over(member(put.body, "hash"))).header("ETag"),
              first.header("ETag"));
}

TEST_F(TextureRoutes, OneIsPutUsedReplacedAndDeleted) {
    expect_problem(post("/v1/plan", painted("mine")), 422, "/cubes/0/texture");
    const Response put = ask("PUT", "mine", picture(0.5f));
    EXPECT_EQ(put.status, 201) << put.body;
    EXPECT_EQ(put.header("Location"), "/v1/textures/mine");
    const std::string hash = member(put.body, "hash");
    ASSERT_EQ(hash.size(), 32U);
    EXPECT_NE(get("/v1/textures").body.find("\"mine\""), std::string::npos);

    const Response plan = post("/v1/plan", painted("mine"));
    EXPECT_EQ(plan.status, 200) << plan.body;
    EXPECT_NE(plan.body.find("painted with 1 texture"), std::string::npos);
    const Response render = post("/v1/render", painted("mine"));
    EXPECT_EQ(render.status, 200) << render.body;
    // By its hash it is the same picture.
    EXPECT_EQ(post("/v1/render", painted(hash)).header("ETag"), render.header("ETag"));

    // Another picture under the name is another texture; what it shows, given back, is the same again.
    const std::string shown = ask("GET", "mine").body;
    const Response replaced = ask("PUT", "mine", picture(1));
    EXPECT_EQ(replaced.status, 200);
    EXPECT_NE(member(replaced.body, "hash"), hash);
    EXPECT_NE(post("/v1/render", painted("mine")).header("ETag"), render.header("ETag"));
    EXPECT_EQ(member(ask("PUT", "mine", shown).body, "hash"), hash);

    EXPECT_EQ(ask("DELETE", "mine").status, 204);
    expect_problem(ask("DELETE", "mine"), 404);
    expect_problem(post("/v1/plan", painted("mine")), 422, "/cubes/0/texture");
}

TEST_F(TextureRoutes, WhatIsNoTextureIsRefused) {
    expect_problem(ask("PUT", "mine", "no picture"), 422);
    expect_problem(ask("PUT", "mine", ""), 422);
    expect_problem(ask("PUT", ".mine", picture(1)), 422);
    expect_problem(ask("PUT", "none", picture(1)), 422);
    expect_problem(ask("PUT", "a/b", picture(1)), 404);
    expect_problem(ask("POST", "mine", picture(1)), 405);
    EXPECT_EQ(ask("POST", "mine").header("Allow"), "GET, HEAD, PUT, DELETE, OPTIONS");
    EXPECT_EQ(service.answer(make_request("PUT", "/v1/textures", picture(1), {})).status, 405);
    EXPECT_EQ(service.answer(make_request("PUT", "/v1/render", picture(1), {})).status, 405);
}

TEST(TextureStore, SoManyAreKeptAndNoMore) {
    TextureStore store;
    bool was_there = false;
    const auto keep = [&](const std::string& name) {
        return store.keep(std::make_shared<const Texture>(Texture{name, name, {}}), was_there);
    };
    for (std::size_t i = 0; i < limits::kMaxKeptTextures; ++i)
        ASSERT_FALSE(keep("t" + std::to_string(i)));
    EXPECT_FALSE(was_there);
    const Status full = keep("another");
    ASSERT_TRUE(full);
    EXPECT_EQ(full->code, ErrorCode::kTooLarge);
    EXPECT_FALSE(keep("t0"));
    EXPECT_TRUE(was_there);
    EXPECT_TRUE(store.remove("t1"));
    EXPECT_FALSE(keep("another"));
}

TEST_F(TextureRoutes, AFormMayBringThem) {
    const auto part = [](const std::string& name, const std::string& file,
                         const std::string& value) {
        return "--xx\r\nContent-Disposition: form-data; name=\"" + name + "\"" +
               (file.empty() ? "" : "; filename=\"" + file + "\"") + "\r\n\r\n" + value + "\r\n";
    };
    const auto ask_form = [&](const std::string& body) {
        return post("/v1/plan", body + "--xx--\r\n", {}, "multipart/form-data; boundary=xx");
    };
    const Response plan = ask_form(part("scene", "", painted("mine")) +
                                   part("texture", "C:\\pictures\\mine.png", picture(1)));
    EXPECT_EQ(plan.status, 200) << plan.body;
    EXPECT_NE(plan.body.find("painted with 1 texture"), std::string::npos);
    // It is of that request alone.
    expect_problem(post("/v1/plan", painted("mine")), 422, "/cubes/0/texture");
    expect_problem(ask_form(part("scene", "", painted("mine")) + part("texture", "mine.png", "x")),
                   422);
    // A file that was not chosen.
    EXPECT_EQ(ask_form(part("scene", "", test::kScene) + part("texture", "", "")).status, 200);
}

}  // namespace
}  // namespace awan
