// Laws and rejections of the .awn layout (core/formats/awn.h).
#include "core/formats/awn.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "tests/patience.h"

namespace awan {
namespace {

std::string file_text(const std::string& name) {
    std::ifstream file(std::string(AWAN_TEST_DATA) + "/" + name, std::ios::binary);
    EXPECT_TRUE(file) << name;
    return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* kTables[] = {"table-4.2.awn", "table-4.3.awn", "table-4.4.awn"};

// The layout is malformed at that line, and the message holds every one of the words.
void expect_malformed(std::string_view text, const std::string& line,
                      std::initializer_list<const char*> words) {
    const Result<SceneDraft> draft = read_awn(text);
    ASSERT_FALSE(draft.ok()) << text;
    EXPECT_EQ(draft.error().code, ErrorCode::kMalformed);
    EXPECT_EQ(draft.error().pointer, line);
    for (const char* const word : words)
        EXPECT_NE(draft.error().message.find(word), std::string::npos)
            << '"' << draft.error().message << "\" lacks " << word;
    EXPECT_EQ(draft.error().message.find('\n'), std::string::npos);
    EXPECT_LT(draft.error().message.size(), 200u);
}

bool equal(const Cube& a, const Cube& b) {
    return a.particles == b.particles && a.size == b.size && a.center == b.center &&
           a.radius == b.radius && a.density == b.density && a.texture == b.texture;
}

TEST(Awn, ReadsTheThreeTablesAsTheyArePrinted) {
    const std::size_t cubes[] = {3, 17, 23};
    const std::uint64_t particles[] = {2000, 554, 615};
    for (std::size_t i = 0; i < 3; ++i) {
        const Result<SceneDraft> draft = read_awn(file_text(kTables[i]));
        ASSERT_TRUE(draft.ok()) << kTables[i] << ": " << draft.error().message;
        EXPECT_TRUE(draft->top_level_cubes);
        ASSERT_EQ(draft->clouds.size(), 1u);
        EXPECT_EQ(draft->clouds[0].cubes.size(), cubes[i]);
        EXPECT_EQ(particle_count(*draft), particles[i]);
        EXPECT_TRUE(validate(*draft).ok());
    }
}

TEST(Awn, ReadsColumnsInTheOrderXYZ) {
    const Result<SceneDraft> draft = read_awn("5\n1\n5, 1, 2, 3, 4, 5, 6, 7\n");
    ASSERT_TRUE(draft.ok());
    const Cube& cube = draft->clouds[0].cubes[0];
    EXPECT_EQ(cube.particles, 5u);
    EXPECT_EQ(cube.size, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cube.center, glm::dvec3(4, 5, 6));
    EXPECT_EQ(cube.radius, 7);
}

TEST(Awn, ReadsTheMissingCommaAndTheEmptyCubeAndTheLongExponentOfTable43) {
    const Result<SceneDraft> draft = read_awn(file_text("table-4.3.awn"));
    ASSERT_TRUE(draft.ok());
    const std::vector<Cube>& cubes = draft->clouds[0].cubes;
    EXPECT_EQ(cubes[11].size, glm::dvec3(2.36429, 1.50285, 2.29693));
    EXPECT_EQ(cubes[11].center, glm::dvec3(4.6, -3, 0));
    EXPECT_EQ(cubes[13].particles, 0u);
    EXPECT_EQ(cubes[10].center.x, 6.12438e-7);
}

TEST(Awn, SeparatorsAreCommasOrBlanksOrBoth) {
    for (const char* const text :
         {"5\n1\n5,1,2,3,4,5,6,7\n", "5\n1\n5 1 2 3 4 5 6 7\n", "5\n1\n5\t1 , 2,3\t4 5,6   ,7",
          "  5 \n\n 1\n\n5 1 2 3 4 5 6 7  \n\n", "5\r\n1\r\n5, 1, 2, 3, 4, 5, 6, 7\r\n",
          "\xEF\xBB\xBF"
          "5\n1\n5, 1, 2, 3, 4, 5, 6, 7\n"}) {
        const Result<SceneDraft> draft = read_awn(text);
        ASSERT_TRUE(draft.ok()) << text << ": " << draft.error().message;
        EXPECT_EQ(draft->clouds[0].cubes[0].radius, 7);
    }
}

TEST(Awn, ALayoutWithoutCubesIsALayout) {
    const Result<SceneDraft> draft = read_awn("0\n0\n");
    ASSERT_TRUE(draft.ok());
    EXPECT_TRUE(draft->clouds[0].cubes.empty());
    EXPECT_TRUE(validate(*draft).ok());
}

TEST(Awn, WritingWhatWasReadAndReadingWhatWasWrittenChangeNothing) {
    for (const char* const table : kTables) {
        const Result<SceneDraft> first = read_awn(file_text(table));
        ASSERT_TRUE(first.ok());
        const Result<std::string> text = write_awn(*first);
        ASSERT_TRUE(text.ok());
        const Result<SceneDraft> second = read_awn(*text);
        ASSERT_TRUE(second.ok()) << second.error().message;
        ASSERT_EQ(second->clouds[0].cubes.size(), first->clouds[0].cubes.size());
        for (std::size_t i = 0; i < first->clouds[0].cubes.size(); ++i)
            EXPECT_TRUE(equal(first->clouds[0].cubes[i], second->clouds[0].cubes[i])) << i;
        EXPECT_EQ(*write_awn(*second), *text);
    }
}

TEST(Awn, WritesTheShortestNumbersThatReadBack) {
    SceneDraft draft;
    draft.clouds.resize(1);
    Cube& cube = draft.clouds[0].cubes.emplace_back();
    cube.particles = 3;
    cube.size = {0.1, 1e-9, 1.0 / 3};
    cube.center = {-0.6, 1e9, 0};
    cube.radius = 2;
    EXPECT_EQ(*write_awn(draft), "3\n1\n3, 0.1, 1e-09, 0.3333333333333333, -0.6, 1e+09, 0, 2\n");
}

// --- what is rejected

TEST(Awn, RejectsATotalThatDoesNotMatchAndNamesBothNumbers) {
    expect_malformed("7\n1\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 1", {"7", "5"});
}

TEST(Awn, RejectsANumberOfCubesThatDoesNotMatchAndNamesBothNumbers) {
    expect_malformed("5\n2\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 2", {"2 cubes", "lines for 1"});
    expect_malformed("10\n1\n5,1,2,3,4,5,6,7\n5,1,2,3,4,5,6,7\n", "line 2", {"1 cubes", "for 2"});
}

TEST(Awn, RejectsALineWithTooFewNumbers) {
    expect_malformed("5\n1\n5, 1, 2, 3, 4, 5, 6\n", "line 3", {"8 numbers", "7"});
}

TEST(Awn, RejectsALineWithTooManyNumbers) {
    expect_malformed("5\n1\n5, 1, 2, 3, 4, 5, 6, 7, 8\n", "line 3", {"8 numbers", "more"});
    expect_malformed("5 5\n1\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 1", {"one number"});
    expect_malformed("5\n1 1\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 2", {"one number"});
}

TEST(Awn, RejectsACommaWithoutANumber) {
    expect_malformed("5\n1\n5, 1, , 3, 4, 5, 6, 7\n", "line 3", {"y-length"});
    expect_malformed("5\n1\n5, 1, 2, 3, 4, 5, 6, 7,\n", "line 3", {"more"});
    expect_malformed("5\n1\n, 5, 1, 2, 3, 4, 5, 6, 7\n", "line 3", {"particles"});
    expect_malformed("5,\n1\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 1", {"one number"});
}

TEST(Awn, RejectsNumbersThatAreNotFinite) {
    for (const char* const bad : {"nan", "inf", "-inf", "1e999", "1e-9999"})
        expect_malformed(std::string("5\n1\n5, 1, 2, 3, 4, 5, 6, ") + bad, "line 3",
                         {"max radius", bad});
}

TEST(Awn, RejectsWordsAndHexadecimalAndDecimalCommas) {
    expect_malformed("5\n1\n5, one, 2, 3, 4, 5, 6, 7\n", "line 3", {"x-length", "one"});
    expect_malformed("5\n1\n5, 0x10, 2, 3, 4, 5, 6, 7\n", "line 3", {"x-length"});
    expect_malformed("5\n1\n5; 1; 2; 3; 4; 5; 6; 7\n", "line 3", {"particles"});
}

TEST(Awn, RejectsAParticleCountThatIsNotAnIntegerFromZero) {
    for (const char* const bad : {"-1", "2.5", "99999999999999999999", "1e3", "+-5", "++5"}) {
        expect_malformed(std::string(bad) + "\n0\n", "line 1", {"integer"});
        expect_malformed(std::string("5\n1\n") + bad + ", 1, 2, 3, 4, 5, 6, 7\n", "line 3",
                         {"particles", "integer"});
    }
}

TEST(Awn, RejectsAnEmptyLayoutAndOneThatEndsEarly) {
    expect_malformed("", "line 1", {"empty"});
    expect_malformed("\n \r\n", "line 1", {"empty"});
    expect_malformed("5\n", "line 2", {"number of cubes"});
}

TEST(Awn, RejectsJsonAndBinaryWithoutEchoingThem) {
    expect_malformed("{\"cubes\": []}", "line 1", {"total"});
    const std::string noise(1 << 20, '\x01');
    expect_malformed(noise, "line 1", {"total"});
}

TEST(Awn, AHeaderThatClaimsBillionsCostsNothing) {
    const auto start = std::chrono::steady_clock::now();
    expect_malformed("18446744073709551615\n4000000000\n5, 1, 2, 3, 4, 5, 6, 7\n", "line 2",
                     {"4000000000", "1"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, test::patience(1));
}

TEST(Awn, TotalsThatOverflowAreNotTakenForSmallOnes) {
    // Two times 2^63 is 0 in 64 bits.
    expect_malformed("0\n2\n9223372036854775808,1,1,1,0,0,0,1\n9223372036854775808,1,1,1,0,0,0,1\n",
                     "line 1", {"0 particles"});
}

TEST(Awn, RejectsMoreCubesThanASceneMayHaveAtTheFirstLineTooMany) {
    std::string text = "0\n20000\n";
    for (int i = 0; i < 20000; ++i) text += "0, 1, 1, 1, 0, 0, 0, 1\n";
    const Result<SceneDraft> draft = read_awn(text);
    ASSERT_FALSE(draft.ok());
    EXPECT_EQ(draft.error().code, ErrorCode::kInvalidScene);
    EXPECT_EQ(draft.error().pointer, "line " + std::to_string(3 + limits::kMaxCubes));
}

// --- what a layout cannot say

void expect_unwritable(const SceneDraft& draft, const std::string& pointer) {
    const Result<std::string> text = write_awn(draft);
    ASSERT_FALSE(text.ok()) << *text;
    EXPECT_EQ(text.error().code, ErrorCode::kInvalidScene);
    EXPECT_EQ(text.error().pointer, pointer);
}

TEST(Awn, RefusesToWriteWhatALayoutCannotSay) {
    SceneDraft good;
    good.clouds.resize(1);
    good.clouds[0].cubes.emplace_back();
    ASSERT_TRUE(write_awn(good).ok());

    SceneDraft draft = good;
    draft.clouds[0].cubes[0].density = 2;
    expect_unwritable(draft, "/cubes/0/density");
    draft = good;
    draft.clouds[0].cubes[0].texture = "puff";
    expect_unwritable(draft, "/cubes/0/texture");
    good.top_level_cubes = false;
    draft = good;
    draft.clouds.push_back(draft.clouds[0]);
    expect_unwritable(draft, "/clouds");
    draft = good;
    draft.clouds[0].translate.y = 1;
    expect_unwritable(draft, "/clouds/0/translate");
    draft = good;
    draft.clouds[0].scale = 2;
    expect_unwritable(draft, "/clouds/0/scale");
    draft = good;
    draft.clouds[0].rotate_y = 90;
    expect_unwritable(draft, "/clouds/0/rotate_y");
    draft = good;
    draft.clouds[0].model = CloudModel::kParticles;
    expect_unwritable(draft, "/clouds/0/model");
}

}  // namespace
}  // namespace awan
