// Formulas of the user's own: what is read, what is refused and where, what every step gives, what it costs at most,
// and the printed procedure of Ebert 2002 written as one.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "core/base/instruction_sets.h"
#include "core/generate/implicit/formula_field.h"
#include "core/scene/formula.h"
#include "core/scene/limits.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

using test::ball;
using test::bare;
using test::density;

// What a formula gives at a place: from -500 on, though a density is at least 0.
double value_of(const std::string& text, glm::dvec3 p = {0.25, -0.5, 2}, double time = 3) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1), ball({0, 0, 4}, 1)});
    // Names come first.
    const std::size_t names = text.rfind(';') + 1;
    cloud.formula = text.substr(0, names) + "(" + text.substr(names) + ") + 500";
    return density(cloud, p, time) - 500;
}

std::string wrong_of(const std::string& text) {
    const auto read = parse_formula(text, "/at");
    if (read) return "";
    EXPECT_EQ(read.error().pointer, "/at");
    EXPECT_EQ(read.error().code, ErrorCode::kInvalidScene);
    return read.error().message;
}

TEST(Formula, GivesWhatArithmeticGives) {
    const double tolerance = 1e-4;  // 500 and a float's digits
    EXPECT_NEAR(value_of("1 + 2 * 3 - 4 / 8"), 6.5, tolerance);
    EXPECT_NEAR(value_of("-2 ^ 2 + 2 ^ 3 ^ 0.5"), -4 + std::pow(2, std::sqrt(3)), tolerance);
    EXPECT_NEAR(value_of("2 ^ -1 * (1 - -1)"), 1, tolerance);
    EXPECT_NEAR(value_of("8 / 4 / 2 - 1 - 1"), -1, tolerance);
    EXPECT_NEAR(value_of("1.5e1 + .25 + 3."), 18.25, tolerance);
    EXPECT_NEAR(value_of("x + 10 * y + 100 * z"), 0.25 - 5 + 200, tolerance);
    EXPECT_NEAR(value_of("time * pi"), 3 * 3.14159265, tolerance);
    // The cloud is from y = -1 to 1.
    EXPECT_NEAR(value_of("height"), 0.25, tolerance);
    EXPECT_NEAR(value_of("abs(-3) + floor(-1.5) + fract(-1.25) + sign(-7) + sqrt(16)"),
                3 - 2 + 0.75 - 1 + 4, tolerance);
    EXPECT_NEAR(value_of("exp(1) + log(10) + sin(2) + cos(2)"),
                std::exp(1) + std::log(10) + std::sin(2) + std::cos(2), tolerance);
    EXPECT_NEAR(value_of("min(3, 1, 2) + 10 * max(3, 9, 2, 4)"), 91, tolerance);
    EXPECT_NEAR(value_of("mod(-1, 3) + step(2, 1) + step(1, 2)"), 3, tolerance);
    EXPECT_NEAR(value_of("clamp(5, 0, 2) + mix(10, 20, .25) + length(2, 3, 6)"), 21.5, tolerance);
    EXPECT_NEAR(value_of("smoothstep(0, 2, 0.5)"), 3 / 16. - 2 / 64., tolerance);
    EXPECT_NEAR(value_of("select(0, 1, 2) + select(-3, 10, 20)"), 12, tolerance);
    EXPECT_NEAR(value_of("a = 2; b = a * a; a + b"), 6, tolerance);
}

TEST(Formula, ComparesAndChooses) {
    for (const double x : {-1.0, 0.0, 2.0}) {
        const auto at = [&](const std::string& text) { return value_of(text, {x, 0, 2}); };
        EXPECT_EQ(at("x < 0"), x < 0) << x;
        EXPECT_EQ(at("x <= 0"), x <= 0) << x;
        EXPECT_EQ(at("x > 0"), x > 0) << x;
        EXPECT_EQ(at("x >= 0"), x >= 0) << x;
        EXPECT_EQ(at("x == 0"), x == 0) << x;
        EXPECT_EQ(at("x != 0"), x != 0) << x;
        EXPECT_EQ(at("!x"), x == 0) << x;
        EXPECT_EQ(at("x > 0 && x < 3 || x == -1"), x != 0) << x;
        EXPECT_EQ(at("x < 0 ? 1 : x > 0 ? 2 : 3"), x < 0 ? 1 : x > 0 ? 2 : 3) << x;
    }
}

// What has no number is 0, what is too much is the most; every step by itself.
TEST(Formula, EveryStepGivesANumber) {
    for (const char* const none : {"0 / 0", "sqrt(-1)", "log(-1)", "(-8) ^ 0.5", "mod(1, 0) * 0",
                                   "1e30 * 1e30 - 1e30 * 1e30"})
        EXPECT_EQ(value_of(none), 0) << none;
    EXPECT_EQ(value_of("(1 / 0) / 1e30"), 1);
    EXPECT_EQ(value_of("exp(1e30) / 1e30"), 1);
    EXPECT_EQ(value_of("log(0) / 1e30"), -1);
    EXPECT_LE(std::abs(value_of("sin(1e30)")), 1);
    EXPECT_EQ(value_of("smoothstep(1, 1, 0.5) + 2 * smoothstep(1, 1, 1.5)"), 2);
    // Densities are from 0 to the most.
    EXPECT_EQ(value_of("-1e9"), -500);
    EXPECT_EQ(value_of("1e9"), limits::kMaxImplicitDensity - 500);
}

// Ebert 2002, procedure cumulus(): density = (parms[1] (parms[3] mdens + (1 - parms[3]) turb mdens))^parms[2].
TEST(Formula, SaysWhatTheDocumentPrints) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1), ball({1, 0.3, 0}, 0.8)});
    cloud.amount = 0.3, cloud.exponent = 0.5, cloud.blend = 0.4, cloud.displacement = 0.7;
    cloud.octaves = 6;
    ImplicitCloud by_formula = cloud;
    by_formula.formula = "(0.3 * (0.4 * mdens + (1 - 0.4) * turb * mdens)) ^ 0.5";
    ImplicitCloud same = cloud;
    same.formula = "density";
    int inside = 0;
    test::all_over({0.5, 0, 0}, 1.6, 2000, [&](glm::dvec3 p) {
        const double expected = density(cloud, p);
        EXPECT_NEAR(density(by_formula, p), expected, 1e-6);
        EXPECT_EQ(density(same, p), expected);
        inside += expected > 0 ? 1 : 0;
    });
    EXPECT_GT(inside, 300);
}

TEST(Formula, AsksForThePrimitivesElsewhere) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1), ball({3, 0, 0}, 1)});
    cloud.formula = "primitives(x - 3, y, z)";
    ImplicitCloud plain = bare({ball({0, 0, 0}, 1), ball({3, 0, 0}, 1)});
    test::all_over({1.5, 0, 0}, 2, 500, [&](glm::dvec3 p) {
        EXPECT_NEAR(density(cloud, p), density(plain, p - glm::dvec3(3, 0, 0)), 1e-5);
    });
}

TEST(Formula, ItsNoiseIsNoise) {
    // Continuous, around 0, within its bounds, with octaves that halve.
    double sum = 0, squares = 0, most = 0, fewer = 0, more = 0;
    const int count = 1500;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 p(0.37 * i - 200, 0, 2);
        const double n = value_of("noise(x, y, z)", p);
        sum += n, squares += n * n, most = std::max(most, std::abs(n));
        fewer = std::max(fewer, value_of("turbulence(x, y, z, 1)", p) - std::abs(n));
        const double two = value_of("fbm(x, y, z, 2)", p);
        more = std::max(more, std::abs(two - n));
    }
    EXPECT_LT(std::abs(sum / count), 0.05);
    EXPECT_NEAR(std::sqrt(squares / count), 0.2694, 0.04);  // kRmsNoise
    EXPECT_LT(most, 1.05);
    EXPECT_LT(fewer, 1e-4);  // one octave of turbulence is |noise|
    EXPECT_LT(more, 0.53);   // the second is half as strong
    EXPECT_GT(more, 0.2);
    const double here = value_of("noise(x, y, z)", {0.4, 0.1, 2});
    EXPECT_NEAR(value_of("noise(x, y, z)", {0.4001, 0.1, 2}), here, 1e-3);
}

TEST(Formula, SaysWhatIsWrongAndWhere) {
    const struct {
        const char* text;
        const char* says;
    } cases[] = {
        {"", "line 1, column 1: expected a number"},
        {"density *", "column 10"},
        {"density\n  + rain", "line 2, column 5: there is no `rain`; there are x, y"},
        {"wet(x)", "line 1, column 1: there is no function `wet`; there are abs"},
        {"noise(x, y)", "`noise` takes 3 values"},
        {"sqrt(1, 2)", "`sqrt` takes 1 value"},
        {"max(1)", "`max` takes 2 or more values"},
        {"fbm(x, y, z, x)", "expected the octaves"},
        {"fbm(x, y, z, 11)", "octaves must be a whole number from 1 to 10"},
        {"fbm(x, y, z, 2.5)", "octaves must be a whole number from 1 to 10"},
        {"fbm(x, y)", "`fbm` takes 4 values"},
        {"x = 2; x", "`x` is a name already"},
        {"a = 2; a = 3; a", "line 1, column 8: `a` is a name already"},
        {"a = 2 a", "expected `;`"},
        {"a = 2;", "expected a number"},
        {"(x", "expected `)`"},
        {"x)", "expected an operator or the end, not `)`"},
        {"1 < 2 < 3", "expected an operator or the end, not `<`"},
        {"x ? 1", "expected `:`"},
        {"1e40", "a number must be at most 1e30"},
        {"2x", "expected an operator"},
        {"system(\"ls\")", "there is no function `system`"},
        {"x \xc3\xa4", "a character that no formula has"},
    };
    for (const auto& one : cases)
        EXPECT_NE(wrong_of(one.text).find(one.says), std::string::npos)
            << one.text << ": " << wrong_of(one.text);
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST(Formula, IsBounded) {
    EXPECT_EQ(wrong_of(repeated("(", 30) + "1" + repeated(")", 30)), "");
    EXPECT_NE(wrong_of(repeated("(", 40) + "1" + repeated(")", 40)).find("deeper"),
              std::string::npos);
    EXPECT_NE(wrong_of(repeated("-", 4000) + "1").find("deeper"), std::string::npos);
    // These hold more and more values until they end.
    EXPECT_NE(wrong_of(repeated("1?1:", 900) + "1").find("more than 32 values"), std::string::npos);
    EXPECT_NE(wrong_of(repeated("2^", 900) + "1").find("more than 32 values"), std::string::npos);
    EXPECT_NE(wrong_of(repeated("0?0:-", 30) + "1").find("more than 32 values"), std::string::npos);
    EXPECT_EQ(wrong_of(repeated("x+", 250) + "1"), "");
    EXPECT_NE(wrong_of(repeated("x+", 300) + "1").find("more than 512 steps"), std::string::npos);
    EXPECT_NE(wrong_of(repeated("x+", 2100)).find("4096 bytes"), std::string::npos);
    EXPECT_NE(wrong_of(repeated("fbm(x,y,z,10)+", 5) + "1").find("48 octaves"), std::string::npos);
    EXPECT_NE(wrong_of(repeated("primitives(x,y,z)+", 9) + "1").find("8 times"), std::string::npos);
    std::string names;
    for (int i = 0; i < 25; ++i) names += "n" + std::to_string(i) + " = 1; ";
    EXPECT_NE(wrong_of(names + "1").find("24 names"), std::string::npos);
    std::string held = "1", ends;
    for (int i = 0; i < 31; ++i) held = "max(1, 1 + " + held + ")";
    EXPECT_NE(wrong_of(held), "");
}

// Random strings of what formulas are made of, and of anything: they are read or refused, at once, and what is read
// gives a density.
TEST(Formula, RandomTextsNeitherCrashNorStall) {
    const std::vector<std::string> parts = {"x",
                                            "y",
                                            "z",
                                            "height",
                                            "time",
                                            "seed",
                                            "density",
                                            "mdens",
                                            "turb",
                                            "pi",
                                            "+",
                                            "-",
                                            "*",
                                            "/",
                                            "^",
                                            "(",
                                            ")",
                                            ",",
                                            ";",
                                            "=",
                                            "==",
                                            "<",
                                            ">=",
                                            "!",
                                            "&&",
                                            "||",
                                            "?",
                                            ":",
                                            "1",
                                            "0",
                                            "2.5",
                                            "1e30",
                                            "a",
                                            "b",
                                            " ",
                                            "noise(",
                                            "fbm(x,y,z,3)",
                                            "max(",
                                            "sqrt(",
                                            "exp(",
                                            "log(",
                                            "mod(x,0)",
                                            "sin(1e30)",
                                            "select(",
                                            "primitives(x,y,z)",
                                            "\n",
                                            "."};
    std::minstd_rand dice(7);
    int read = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 40'000; ++i) {
        std::string text;
        const auto length = dice() % 24;
        for (unsigned k = 0; k < length; ++k)
            text += i % 4 == 0 ? std::string(1, static_cast<char>(dice() % 256))
                               : parts[dice() % parts.size()];
        const auto formula = parse_formula(text, "/at");
        if (!formula) {
            EXPECT_TRUE(formula.error().message.starts_with("line ")) << formula.error().message;
            continue;
        }
        ++read;
        EXPECT_LE(formula->values, limits::kMaxFormulaValues);
        EXPECT_LE(formula->steps.size(), static_cast<std::size_t>(limits::kMaxFormulaSteps));
        ImplicitCloud cloud = bare({ball({0, 0, 0}, 1)});
        cloud.formula = text;
        const double d = density(cloud, {0.1, 0.2, 0.3});
        EXPECT_TRUE(d >= 0 && d <= limits::kMaxImplicitDensity) << text << ": " << d;
    }
    EXPECT_GT(read, 500);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 60);
}

TEST(Formula, KnowsWhatItAsksFor) {
    EXPECT_TRUE(parse_formula("density * time", "")->asks_for(FormulaInput::kTime));
    EXPECT_FALSE(parse_formula("density * height", "")->asks_for(FormulaInput::kTime));
}

// Without primitives near a place there may be density all the same, within their box.
TEST(Formula, ReachesAllOfThePrimitivesBox) {
    ImplicitCloud cloud = bare({ball({-2, 0, 0}, 0.5), ball({2, 0, 0}, 0.5)});
    cloud.formula = "0.25 + seed * 0";
    EXPECT_EQ(density(cloud, {0, 0, 0}), 0.25);
    const implicit::ImplicitField field = implicit::prepare_field(cloud, test::kKey, 0);
    float row[40];
    implicit::row_densities(field, {}, {{-2.4, 0, 0}, 0.1, 40}, row);
    for (const float one : row) EXPECT_EQ(one, 0.25F);
}

}  // namespace
}  // namespace awan
