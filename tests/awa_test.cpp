// Laws and rejections of the .awa layout (core/formats/awa.h).
#include "core/formats/awa.h"

#include <gtest/gtest.h>

#include "core/formats/awn.h"
#include "core/scene/validate.h"
#include "server/document/scene_text.h"

namespace awan {
namespace {

constexpr const char* kLayout =
    "awa 1\n"
    "50\n"
    "3\n"
    "20, 7.39642, 1.07048, 2.89284, -3.4, -3.3, -0.600002, 2.1, puff\n"
    "30, 4.99599, 1.30149, 2.33467, 1.1, -0.899999, 0, 3, wisp\n"
    "0, 1, 1, 1, 0, 2, 6.12438e-07, 0.5, none\n";

void expect_malformed(std::string_view text, const std::string& line,
                      std::initializer_list<const char*> words) {
    const Result<SceneDraft> draft = read_awa(text);
    ASSERT_FALSE(draft.ok()) << text;
    EXPECT_EQ(draft.error().code, ErrorCode::kMalformed) << text;
    EXPECT_EQ(draft.error().pointer, line) << text;
    for (const char* const word : words)
        EXPECT_NE(draft.error().message.find(word), std::string::npos)
            << '"' << draft.error().message << "\" lacks " << word;
    EXPECT_LT(draft.error().message.size(), 250U);
}

TEST(Awa, ReadsCubesWithTheirTextures) {
    const Result<SceneDraft> draft = read_awa(kLayout);
    ASSERT_TRUE(draft.ok()) << draft.error().message;
    const auto& cubes = draft->clouds[0].cubes;
    ASSERT_EQ(cubes.size(), 3U);
    EXPECT_EQ(cubes[0].texture, "puff");
    EXPECT_EQ(cubes[1].texture, "wisp");
    EXPECT_FALSE(cubes[2].texture);
    EXPECT_EQ(cubes[1].particles, 30U);
    EXPECT_EQ(cubes[1].size, glm::dvec3(4.99599, 1.30149, 2.33467));
    EXPECT_EQ(cubes[2].center.z, 6.12438e-07);
    EXPECT_TRUE(validate(*draft).ok());
    // Commas, blanks and ends of lines as they come.
    std::string loose(kLayout);
    for (char& c : loose)
        if (c == ',') c = '\t';
    const Result<SceneDraft> same = read_awa("\xEF\xBB\xBF\r\n" + loose);
    ASSERT_TRUE(same.ok()) << same.error().pointer << same.error().message;
    EXPECT_EQ(write_awa(*same).value(), kLayout);
}

TEST(Awa, WritingAndReadingAreInverse) {
    EXPECT_EQ(write_awa(*read_awa(kLayout)).value(), kLayout);
    SceneDraft draft = *read_awn("3\n2\n1, 1, 2, 3, 4, 5, 6, 7\n2, 1, 1, 1, 0, 0, 0, 1\n");
    EXPECT_EQ(write_awa(draft).value(),
              "awa 1\n3\n2\n1, 1, 2, 3, 4, 5, 6, 7, none\n2, 1, 1, 1, 0, 0, 0, 1, none\n");
    // What holds for a cube is written, wherever it stands.
    draft.texture = "torn";
    draft.billboards = 9;
    draft.clouds[0].cubes[0].texture = "soft";
    draft.clouds[0].cubes[0].billboards = 5;
    const std::string text = write_awa(draft).value();
    EXPECT_EQ(text, "awa 1\n14\n2\n5, 1, 2, 3, 4, 5, 6, 7, soft\n9, 1, 1, 1, 0, 0, 0, 1, torn\n");
    EXPECT_EQ(write_awa(*read_awa(text)).value(), text);
}

TEST(Awa, WhatIsMalformedIsSaidWithItsLine) {
    expect_malformed("", "line 1", {"empty"});
    expect_malformed("50\n3\n", "line 1", {"awa 1"});
    expect_malformed("awa\n1\n", "line 1", {"awa 1"});
    expect_malformed("awa 2\n0\n0\n", "line 1", {"version", "\"2\""});
    expect_malformed("awa 1\n", "line 2", {"total"});
    expect_malformed("\nawa 1\n\n5\n", "line 5", {"number of cubes"});
    expect_malformed("awa 1\n5\n1\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 4", {"texture", "8 words"});
    expect_malformed("awa 1\n5\n1\n5, 1, 2, 3, 4, 5, 6, 7, puff, 8\n", "line 4", {"10 words"});
    expect_malformed("awa 1\n5\n1\n5, 1, 2, 3, 4, 5, 6, 7, ../puff\n", "line 4", {"texture"});
    expect_malformed("awa 1\n5\n1\n5, 1, 2, 3, 4, 5, 6, x, puff\n", "line 4", {"max radius"});
    expect_malformed("awa 1\n5\n1\n5, 1,, 2, 3, 4, 5, 6, puff\n", "line 4", {"8 words"});
    expect_malformed("awa 1\n6\n1\n5, 1, 2, 3, 4, 5, 6, 7, puff\n", "line 2", {"6", "5"});
    expect_malformed("awa 1\n5\n2\n5, 1, 2, 3, 4, 5, 6, 7, puff\n", "line 3", {"2", "1"});
}

TEST(Awa, IsKnownByItsFirstWord) {
    EXPECT_EQ(sniff_scene_format(kLayout), SceneFormat::kAwa);
    EXPECT_EQ(sniff_scene_format("awake,x,y\n"), SceneFormat::kCsv);
    EXPECT_EQ(scene_format_of_name("a.AWA.gz"), SceneFormat::kAwa);
    EXPECT_EQ(scene_format_of_type("text/x-awa"), SceneFormat::kAwa);
    EXPECT_TRUE(read_scene(SceneFormat::kAwa, kLayout).ok());
}

TEST(Awa, AnAwnHasNoTextures) {
    const SceneDraft draft = *read_awa(kLayout);
    EXPECT_FALSE(write_awn(draft).ok());
    EXPECT_EQ(write_awn(draft).error().pointer, "/cubes/0/texture");
}

}  // namespace
}  // namespace awan
