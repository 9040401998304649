// Scenes as texts that people hand over: encodings, packed files, keys of their own, answers that come back, and what
// is said of a text that is not JSON.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/generate/generate.h"
#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "server/document/overrides.h"
#include "server/document/scene_text.h"
#include "server/document/text_bytes.h"
#include "tests/gzip.h"

namespace awan {
namespace {

constexpr const char* kCube = R"({"particles":50,"size":[4,2,3],"center":[0,0,0],"radius":0.8})";

std::string scene_of(const std::string& more) {
    return R"({"cubes":[)" + std::string(kCube) + "]" + more + "}";
}

std::string message_of(const Result<SceneDraft>& draft) {
    return draft.ok() ? "" : draft.error().pointer + " " + draft.error().message;
}

std::string utf16(const std::string& ascii, bool big, bool mark) {
    std::string out = !mark ? "" : big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : ascii) out += big ? std::string{'\0', c} : std::string{c, '\0'};
    return out;
}

// --- encodings

TEST(SceneText, Utf16OfEitherOrderIsRead) {
    for (const bool big : {false, true})
        for (const bool mark : {false, true}) {
            std::vector<std::string> notes;
            const std::string bytes = utf16(scene_of(""), big, mark);
            EXPECT_EQ(sniff_scene_format(bytes), SceneFormat::kJson);
            const auto draft = read_scene(SceneFormat::kJson, bytes, {{}, &notes});
            ASSERT_TRUE(draft.ok()) << message_of(draft);
            EXPECT_EQ(draft->clouds[0].cubes[0].particles, 50u);
            EXPECT_EQ(notes, (std::vector<std::string>{"the text is in UTF-16"}));
        }
    const auto letters = from_utf16(std::string_view("\xFF\xFE\xE9\0\x3D\xD8\x00\xDE\xF1\x96", 10));
    ASSERT_TRUE(letters.ok());
    EXPECT_EQ(**letters, "é😀雱");
    const auto plain = from_utf16("{\"cubes\":[]}");
    ASSERT_TRUE(plain.ok());
    EXPECT_FALSE(plain->has_value());
}

TEST(SceneText, BrokenEncodingsAreNamed) {
    using namespace std::string_literals;
    EXPECT_NE(message_of(read_scene(SceneFormat::kJson, "\xFF\xFE\0\0{\0\0\0"s)).find("UTF-32"),
              std::string::npos);
    EXPECT_NE(message_of(read_scene(SceneFormat::kCsv, "\xFF\xFEx"s)).find("breaks off"),
              std::string::npos);
    EXPECT_NE(message_of(read_scene(SceneFormat::kJson, "\xFF\xFE\x3D\xD8"s)).find("half a letter"),
              std::string::npos);
}

TEST(SceneText, AByteOrderMarkBeforeAnyTextIsNothing) {
    EXPECT_TRUE(read_scene(SceneFormat::kJson, "\xEF\xBB\xBF" + scene_of("")).ok());
    EXPECT_EQ(sniff_scene_format("\xEF\xBB\xBF" + scene_of("")), SceneFormat::kJson);
    EXPECT_EQ(sniff_scene_format("\xEF\xBB\xBFply\rformat"), SceneFormat::kPly);
    EXPECT_EQ(sniff_scene_format("//X,Y,Z\n1,2,3\n"), SceneFormat::kCsv);
    EXPECT_EQ(scene_format_of_name("a.CSV.gz"), SceneFormat::kCsv);
}

TEST(SceneText, GzipIsBounded) {
    const std::string text(200'000, 'a');
    const std::string packed = test::gzip(text);
    EXPECT_TRUE(is_gzip(packed));
    EXPECT_EQ(*gunzip(packed, 200'000), text);
    EXPECT_EQ(*gunzip(packed + packed, 400'000), text + text);
    EXPECT_EQ(gunzip(packed, 199'999).error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(gunzip(packed.substr(0, packed.size() / 2), 1 << 20).error().code,
              ErrorCode::kMalformed);
    EXPECT_EQ(gunzip(packed.substr(0, packed.size() - 1), 1 << 20).error().code,
              ErrorCode::kMalformed);
    EXPECT_EQ(gunzip(packed + "x", 1 << 20).error().code, ErrorCode::kMalformed);
    std::string damaged = packed;
    damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 1);
    EXPECT_EQ(gunzip(damaged, 1 << 20).error().code, ErrorCode::kMalformed);
    EXPECT_EQ(gunzip("", 10).error().code, ErrorCode::kMalformed);
    EXPECT_EQ(*gunzip(test::gzip(""), 0), "");
}

// --- keys of one's own

TEST(SceneText, KeysOfOnesOwnAreLeftAlone) {
    const auto draft = parse_scene(
        R"({"$schema":"./scene.schema.json","name":"mine","_made":{"by":["a",{"b":null}],"when":1e3,"ok":true},)"
        R"("description":"a cloud","cubes":[{"name":"left puff","_":[[],{}],"particles":50,"size":[4,2,3],)"
        R"("center":[0,0,0],"radius":0.8,"name":"twice"}],"sun":{"_note":"low","elevation":12},)"
        R"("image":{"description":false,"width":40}})");
    ASSERT_TRUE(draft.ok()) << message_of(draft);
    EXPECT_EQ(draft->sun.elevation, 12);
    EXPECT_EQ(draft->clouds[0].cubes[0].particles, 50u);
    const auto bare = parse_scene(scene_of(R"(,"sun":{"elevation":12},"image":{"width":40})"));
    EXPECT_EQ(scene_to_json(*draft), scene_to_json(*bare));
}

TEST(SceneText, OtherKeysAreNot) {
    EXPECT_EQ(message_of(parse_scene(scene_of(R"(,"names":1)"))).substr(0, 7), "/names ");
    EXPECT_EQ(message_of(parse_scene(scene_of(R"(,"count":1)"))).substr(0, 7), "/count ");
    EXPECT_EQ(message_of(parse_scene(scene_of(R"(,"sun":{"count":1})"))).substr(0, 11),
              "/sun/count ");
    // What nobody reads may not be deep either.
    const std::string deep(100'000, '[');
    EXPECT_NE(message_of(parse_scene(scene_of(R"(,"_":)" + deep))).find("nested deeper"),
              std::string::npos);
    EXPECT_NE(message_of(parse_scene(R"({"_":{"a":[})")).find("not JSON at line 1, column 12"),
              std::string::npos);
}

// --- answers that come back

TEST(SceneText, AnAnswerOfParticlesIsAScene) {
    const auto scene = validate(*parse_scene(scene_of(R"(,"seed":5)")));
    const auto particles = generate(*scene, 1, Deadline{});
    ASSERT_TRUE(particles.ok());
    std::string text = particles_json_head(*particles, 5);
    append_particles_json(*particles, 0, particles->size(), text);
    text += particles_json_tail();
    // As it is, and spread over lines, which is not read ahead.
    std::string spread;
    for (const char c : text)
        spread += c == '{' || c == ',' ? std::string(1, c) + "\n " : std::string(1, c);
    for (const std::string& answer : {text, spread}) {
        const auto draft = parse_scene(answer);
        ASSERT_TRUE(draft.ok()) << message_of(draft);
        EXPECT_EQ(draft->seed, 5u);
        EXPECT_FALSE(draft->top_level_cubes);
        const auto again = generate(*validate(*draft), 1, Deadline{});
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again->center, particles->center);
        EXPECT_EQ(again->radius, particles->radius);
        EXPECT_EQ(again->density, particles->density);
    }
    // And goes on from there.
    text.pop_back();
    while (text.back() != '}') text.pop_back();
    text.pop_back();
    const auto lit = parse_scene(text + R"(,"sun":{"elevation":12},"image":{"width":64}})");
    ASSERT_TRUE(lit.ok()) << message_of(lit);
    EXPECT_EQ(lit->sun.elevation, 12);
    EXPECT_TRUE(parse_scene(scene_to_json(*lit)).ok());
}

TEST(SceneText, AnAnswersMistakesHaveTheirPlace) {
    const auto with = [](const std::string& particle) {
        return message_of(parse_scene(
            R"({"particles":[{"center":[0,0,0],"radius":1,"density":1,"color":[1,1,1]},)" +
            particle + "]}"));
    };
    EXPECT_EQ(with(R"({"center":[0,0,0],"radius":2,"density":1})"), "");
    EXPECT_EQ(with(R"({"center":[0,0,0],"radius":0,"density":1})").substr(0, 20),
              "/particles/1/radius ");
    EXPECT_EQ(with(R"({"center":[0,0],"radius":1,"density":1})").substr(0, 20),
              "/particles/1/center ");
    EXPECT_EQ(with(R"({"center":[0,0,0],"radius":1})").substr(0, 13), "/particles/1 ");
    EXPECT_EQ(with(R"({"center":[0,0,0],"radius":1,"density":1,"mass":2})").substr(0, 18),
              "/particles/1/mass ");
    EXPECT_EQ(with(R"({"center":[0,0,0],"radius":1,"density":1,"color":[2,0,0]})").substr(0, 20),
              "/particles/1/color/0");
    EXPECT_EQ(with("7").substr(0, 13), "/particles/1 ");
    EXPECT_EQ(message_of(parse_scene(R"({"particles":[],"cubes":[]})")).substr(0, 11),
              "/particles ");
}

// --- what is not JSON

TEST(SceneText, WhatIsNotJsonHasALineAndAColumn) {
    const auto said = [](const std::string& text) { return message_of(parse_scene(text)); };
    EXPECT_NE(said("// my cloud\n{}").find("line 1, column 1: "), std::string::npos)
        << said("// my cloud\n{}");
    EXPECT_NE(said("// my cloud\n{}").find("no comments"), std::string::npos);
    const std::string trailing = "{\n  \"cubes\": [\n    {\"particles\": 1, }\n]}";
    EXPECT_NE(said(trailing).find("line 3, column 22: "), std::string::npos) << said(trailing);
    EXPECT_NE(said(trailing).find("no comma may stand before }"), std::string::npos);
    EXPECT_NE(said("{'cubes':[]}").find("double quotes"), std::string::npos);
    EXPECT_NE(said("{\"fill\":NaN}").find("no NaN"), std::string::npos) << said("{\"fill\":NaN}");
    EXPECT_NE(said("{cubes:[]}").find("double quotes"), std::string::npos);
    EXPECT_NE(said("{\"seed\":+1}").find("as 1, -1"), std::string::npos);
    EXPECT_NE(said("{\n\"cubes\":[").find("line 2, column 10: "), std::string::npos)
        << said("{\n\"cubes\":[");
    // Columns count letters.
    EXPECT_NE(said("{\"_\":\"雲雲\" x}").find("column 11: "), std::string::npos)
        << said("{\"_\":\"雲雲\" x}");
}

TEST(SceneText, QuotedTextSurvives) {
    EXPECT_NE(message_of(parse_scene(scene_of(R"(,"fill":"größer")"))).find("\"größer\""),
              std::string::npos);
    EXPECT_NE(message_of(parse_scene(scene_of(R"(,"雲":1)"))).find("\"雲\""), std::string::npos);
    EXPECT_NE(message_of(parse_scene(scene_of(R"(,"a\u001bb":1)"))).find("\"a\\x1Bb\""),
              std::string::npos);
}

// --- values in place of the document's

TEST(SetInScene, PutsAValueAtAPlace) {
    SceneDraft draft = *parse_scene(scene_of(""));
    EXPECT_FALSE(set_in_scene("/sun/elevation", "12", draft));
    EXPECT_FALSE(set_in_scene("/cubes/0/radius", "0.5", draft));
    EXPECT_FALSE(set_in_scene("/cubes/-", kCube, draft));
    EXPECT_FALSE(set_in_scene("/fill", "gardner", draft));
    EXPECT_FALSE(set_in_scene("/sky", "none", draft));
    EXPECT_FALSE(set_in_scene("/camera", R"({"eye":[0,1,20],"target":[0,0,0]})", draft));
    EXPECT_EQ(draft.sun.elevation, 12);
    ASSERT_EQ(draft.clouds[0].cubes.size(), 2u);
    EXPECT_EQ(draft.clouds[0].cubes[0].radius, 0.5);
    EXPECT_EQ(draft.fill, Fill::kGardner);
    EXPECT_FALSE(set_in_scene("/camera/eye/2", "30", draft));
    EXPECT_EQ(draft.camera.eye, glm::dvec3(0, 1, 30));
    EXPECT_TRUE(validate(draft).ok());
}

TEST(SetInScene, SaysWhatCannotBe) {
    SceneDraft draft = *parse_scene(scene_of(R"(,"sun":{"direction":[0,1,0]})"));
    const auto said = [&](const char* pointer, const char* value) {
        const Status wrong = set_in_scene(pointer, value, draft);
        return wrong ? wrong->pointer + " " + wrong->message : std::string();
    };
    EXPECT_EQ(said("/sun/hight", "1").substr(0, 11), "/sun/hight ");
    EXPECT_EQ(said("/sun/elevation", "12").substr(0, 15), "/sun/direction ");
    EXPECT_EQ(said("/cubes/7/radius", "1").substr(0, 16), "/cubes/7/radius ");
    EXPECT_EQ(said("/seed", "many").substr(0, 6), "/seed ");
    EXPECT_EQ(said("/seed/x", "1").substr(0, 6), "/seed ");
    EXPECT_NE(said("seed", "1").find("/sun/elevation"), std::string::npos);
    EXPECT_EQ(draft.sun.direction, glm::dvec3(0, 1, 0));
}

TEST(SetInScene, ManyParticlesStayAsTheyAre) {
    SceneDraft draft =
        *parse_scene(R"({"clouds":[{"model":"particles","positions":[[1,2,3]],"radii":[2]}]})");
    ReadyParticles& ready = draft.clouds[0].ready;
    ready.positions.assign(200'000, {1, 2, 3});
    ready.radii.assign(200'000, 2.5f);
    EXPECT_FALSE(set_in_scene("/clouds/0/density", "3", draft));
    EXPECT_EQ(draft.clouds[0].density, 3);
    EXPECT_EQ(draft.clouds[0].ready.radii, std::vector<float>(200'000, 2.5f));
}

TEST(Overrides, AreReadAndRefusedByName) {
    using Query = std::vector<std::pair<std::string, std::string>>;
    const auto read = [](const Query& query) { return read_overrides(query); };
    const auto all = read({{"width", "64"},
                           {"height", "48"},
                           {"format", "exr"},
                           {"background", "transparent"},
                           {"seed", "9"},
                           {"rung", "harris"},
                           {"radius", ".5"}});
    ASSERT_TRUE(all.ok()) << all.error().message;
    SceneDraft draft = *parse_scene(scene_of(R"(,"accuracy":{"error":0.1})"));
    override_scene(*all, draft);
    EXPECT_EQ(draft.image.width, 64);
    EXPECT_EQ(draft.image.height, 48);
    EXPECT_EQ(draft.image.format, ImageFormat::kExr);
    EXPECT_EQ(draft.image.background, Background::kTransparent);
    EXPECT_EQ(draft.seed, 9u);
    EXPECT_EQ(draft.accuracy.rung, "harris");
    EXPECT_FALSE(draft.accuracy.error);
    for (const Query& wrong : {Query{{"width", "0"}},
                               {{"width", "9000"}},
                               {{"width", "wide"}},
                               {{"height", ""}},
                               {{"background", "blue"}},
                               {{"seed", "-1"}},
                               {{"error", "0"}},
                               {{"time_ms", "nan"}},
                               {{"rung", "best"}},
                               {{"radius", "-1"}},
                               {{"width", "1"}, {"width", "1"}},
                               {{"error", ".1"}, {"rung", "harris"}}}) {
        const auto result = read(wrong);
        ASSERT_FALSE(result.ok()) << wrong[0].first;
        EXPECT_NE(result.error().message.find(wrong[0].first), std::string::npos)
            << result.error().message;
    }
}

TEST(Overrides, ARadiusIsForReadyParticles) {
    const auto draft = read_scene(
        SceneFormat::kJson,
        R"({"clouds":[{"model":"particles","positions":[[1,2,3]],"radii":[2]}]})", {0.25, nullptr});
    ASSERT_TRUE(draft.ok());
    EXPECT_EQ(draft->clouds[0].ready.radii, (std::vector<float>{0.25f}));
    EXPECT_NE(
        message_of(read_scene(SceneFormat::kJson, scene_of(""), {0.25, nullptr})).find("radius"),
        std::string::npos);
}

}  // namespace
}  // namespace awan
