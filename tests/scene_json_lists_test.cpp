// Long lists in scene documents, which are read ahead of the parser (server/document/number_runs.h), and
// documents made to hurt.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "core/scene/limits.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

using namespace scene_checks;

#ifdef AWAN_SANITIZED
constexpr double kPatience = 30;
#else
constexpr double kPatience = 2;  // seconds; tenths of one on a quiet core
#endif

double seconds_of(auto work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string lists_with(const std::string& radii, const std::string& positions) {
    return cloud_with(R"("model": "particles", "radii": )" + radii + R"(, "positions": )" +
                      positions);
}

TEST(SceneJsonLists, ReadsListsOfNumbersInEveryFormThatJsonAllows) {
    const SceneDraft draft =
        draft_of(lists_with("[ 1 ,2.5,\n-3e0\t, 4E+1,0,0.5e-1 ,1e-999, 7, -0]\r\n",
                            " [ [ 1 , 2 , 3 ] ,[4,5,6],[-0,0.0,1e-999],[7, 8, 9.25e2] ] "));
    const ReadyParticles& ready = draft.clouds[0].ready;
    EXPECT_EQ(ready.radii, (std::vector<float>{1, 2.5f, -3, 40, 0, 0.05f, 0, 7, 0}));
    EXPECT_FALSE(std::signbit(ready.radii.back()));
    EXPECT_EQ(ready.positions,
              (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}, {0, 0, 0}, {7, 8, 925}}));
    EXPECT_FALSE(std::signbit(ready.positions[2].x));
}

// Equal scenes have equal bytes: a zero is a zero, also where it is read ahead (to the first number that needs the
// parser).
TEST(SceneJsonLists, NegativeZeroIsZeroThereToo) {
    const SceneDraft draft = draft_of(lists_with("[1, 1]", "[[-0, -0.0, 1], [-0e5, 2, -0.00]]"));
    for (const glm::dvec3& p : draft.clouds[0].ready.positions)
        for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis]));
}

TEST(SceneJsonLists, RejectsInLongListsWhatItRejectsElsewhere) {
    for (const char* const bad :
         {"[1,]", "[,1]", "[1,,2]", "[1 2]", "[01]", "[1,01]", "[1,.5]", "[1,5.]", "[1,+1]",
          "[1,1e]", "[1,-]", "[1,NaN]", "[1,-inf]", "[1,0x1]", "[1,2}", "[1,1.e3]"})
        expect_malformed(lists_with(bad, "[]"), {"line 1, column "});
    for (const char* const bad :
         {"[[1,2,3],]", "[[1,2,3][4,5,6]]", "[[1,2,3],[1,2,]]", "[[1,2,3],[01,2,3]]", "[[1,2,3",
          "[[1,2,3],", "[[1,2,3]", "[[1,2,3}]"})
        expect_malformed(lists_with("[]", bad), {"line 1, column "});
    expect_invalid(lists_with("[1, 2, null]", "[]"), "/clouds/0/radii/2", {"a number"});
    expect_invalid(lists_with("[1, 2, \"3\", 4]", "[]"), "/clouds/0/radii/2", {"a number"});
    expect_invalid(lists_with("[1, 2, [3]]", "[]"), "/clouds/0/radii/2", {"a number"});
    expect_invalid(lists_with("[1, 1e999]", "[]"), "/clouds/0/radii/1", {"finite"});
    expect_invalid(lists_with("[1]", "[[1,2,3],[1,2]]"), "/clouds/0/positions/1", {"not 2"});
    expect_invalid(lists_with("[1]", "[[1,2,3],[1,2,3,4]]"), "/clouds/0/positions/1", {"more"});
    expect_invalid(lists_with("[1]", "[[1,2,3],[1,true,3]]"), "/clouds/0/positions/1/1",
                   {"a number"});
    expect_invalid(lists_with("[1]", "[[1,2,3],4]"), "/clouds/0/positions/1", {"three numbers"});
    expect_invalid(lists_with("[1]", "[[1,2,3],[1,2,-1e999]]"), "/clouds/0/positions/1/2",
                   {"finite"});
}

TEST(SceneJsonLists, CountsTheBytesThatWereReadAhead) {
    const std::string before = lists_with("[1, 2, 3, 4, 5, 6, 7]", "[[1, 2, 3], [4, 5, 6");
    expect_malformed(before + "x", {("line 1, column " + std::to_string(before.size() - 2)).c_str()});
}

// --- hostile documents

TEST(SceneJsonLists, DeepDocumentsAreRefusedAtOnce) {
    const std::string deep(100'000, '[');
    const double seconds = seconds_of([&] {
        expect_invalid(deep, "");
        expect_invalid(deep + std::string(deep.size(), ']'), "");
        expect_invalid(R"({"cubes": )" + deep, "/cubes/0");
        expect_invalid(R"({"clouds": [{"positions": )" + deep, "/clouds/0/positions/0/0");
        std::string objects;
        for (int i = 0; i < 100'000; ++i) objects += R"({"cubes":)";
        expect_invalid(objects, "/cubes");
    });
    EXPECT_LT(seconds, kPatience);
}

TEST(SceneJsonLists, WideDocumentsAreRefusedAtOnce) {
    std::string arrays = R"({"cubes": [)";
    while (arrays.size() < 14'000'000) arrays += "[],";
    std::string keys = "{";
    for (int i = 0; i < 1'000'000; ++i) keys += "\"k" + std::to_string(i) + "\":0,";
    std::string text = "{\"" + std::string(14'000'000, 'x') + "\": 1}";
    std::string positions = R"({"clouds": [{"model": "particles", "positions": [)";
    for (std::uint64_t i = 0; i <= limits::kMaxParticles; ++i) positions += "[0,0,0],";
    EXPECT_LT(seconds_of([&] { expect_invalid(arrays, "/cubes/0"); }), kPatience);
    EXPECT_LT(seconds_of([&] { expect_invalid(keys, "/k0"); }), kPatience);
    EXPECT_LT(seconds_of([&] { expect_invalid(text, ""); }), kPatience);
    expect_invalid(positions, "/clouds/0/positions/4194304", {"4194304"});
}

}  // namespace
}  // namespace awan
