// The planner's table: scenes from nothing to much of each effect. Where the plan says that a scene does not call for
// one, forcing it on changes the picture by less than its threshold; where it says so, leaving it out costs about what
// the plan says it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/plan/criteria.h"
#include "tests/patience.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::effect;

struct Row {
    std::string name;
    Effect effect;
    SceneDraft draft;
    // Rungs with and without it where a rung decides; else one rung, and the switch.
    const char* with = "transport-16";
    const char* without = "transport-16";
};

SceneDraft cloud(double density, double g = 0.5) {
    SceneDraft draft = test::table_4_4();
    draft.density = density;
    draft.medium.g = g;
    draft.image.width = 48;
    draft.image.height = 36;
    draft.sky.none = true;
    return draft;
}

// Table 4.4 is about 30 deep at the default density of .2.
constexpr double kDensityPerDepth = 0.2 / 30;

void add_depths(std::vector<Row>& rows) {
    for (const double depth : {0.005, 0.02, 0.1, 0.4, 2.0, 12.0})
        for (const double g : {0.0, 0.85}) {
            const SceneDraft draft = cloud(depth * kDensityPerDepth, g);
            const std::string at = " depth " + std::to_string(depth).substr(0, 5) + " g " +
                                   std::to_string(g).substr(0, 4);
            rows.push_back({"self_shadow" + at, Effect::kSelfShadow, draft, "harris", "additive"});
            rows.push_back(
                {"view_extinction" + at, Effect::kViewExtinction, draft, "harris", "additive"});
            rows.push_back({"multiple_scattering" + at, Effect::kMultipleScattering, draft,
                            "transport-16", "single"});
        }
}

void add_surroundings(std::vector<Row>& rows) {
    for (const double intensity : {0.0, 0.001, 0.02, 0.3, 1.7, 20.0}) {
        SceneDraft draft = cloud(0.1);
        draft.sky = test::plain_draft().sky;
        draft.sky.intensity = intensity;
        rows.push_back({"sky_light " + std::to_string(intensity), Effect::kSkyLight, draft});
    }
    for (const double albedo : {0.0, 0.001, 0.03, 0.2, 0.8}) {
        SceneDraft draft = cloud(0.1);
        draft.sky = test::plain_draft().sky;
        draft.ground = Ground{-8, glm::dvec3(albedo)};
        rows.push_back({"ground_light " + std::to_string(albedo), Effect::kGroundLight, draft});
        draft.image.background = Background::kSky;
        draft.camera = {false, {3, 1, 26}, {0, -5, 0}, {0, 1, 0}, 50};
        rows.push_back({"ground_shadow " + std::to_string(albedo), Effect::kGroundShadow, draft});
    }
    SceneDraft above = cloud(0.1);
    above.ground = Ground{-8, glm::dvec3(0.3)};
    above.camera = {false, {0, -6, 26}, {0, 12, 0}, {0, 1, 0}, 30};  // looks over it
    rows.push_back({"ground_shadow, not in view", Effect::kGroundShadow, above});
    SceneDraft faint = cloud(0.1 * kDensityPerDepth * 0.01);
    faint.ground = Ground{-8, glm::dvec3(0.3)};
    faint.camera = {false, {3, 1, 26}, {0, -5, 0}, {0, 1, 0}, 50};
    rows.push_back({"ground_shadow of next to nothing", Effect::kGroundShadow, faint});
    for (const double elevation : {-3.0, 1.0, 4.0, 12.0, 35.0, 90.0}) {
        SceneDraft draft = cloud(0.1);
        draft.sun.auto_color = true;
        draft.sun.elevation = elevation;
        rows.push_back({"sun_color " + std::to_string(elevation), Effect::kSunColor, draft});
    }
    SceneDraft given = cloud(0.1);
    rows.push_back({"sun_color, given", Effect::kSunColor, given});
    for (const double extinction : {0.0, 1e-5, 1e-3, 0.01, 0.05}) {
        SceneDraft draft = cloud(0.1);
        draft.sky = test::plain_draft().sky;
        draft.haze = Haze{extinction, -8, 4, glm::dvec3(1), 0.6};
        draft.ground = Ground{-8, glm::dvec3(0.2)};
        draft.image.background = Background::kSky;
        draft.sun.azimuth = 170;
        draft.sun.elevation = 25;
        draft.camera = {false, {0, -6, 24}, {0, 0, 0}, {0, 1, 0}, 50};
        rows.push_back({"aerial_perspective " + std::to_string(extinction),
                        Effect::kAerialPerspective, draft});
        rows.push_back({"light_shafts " + std::to_string(extinction), Effect::kLightShafts, draft});
    }
    for (const double distance : {20.0, 80.0, 600.0, 3000.0}) {
        SceneDraft draft = cloud(0.3);
        draft.detail = Detail{0.8, 1};
        draft.camera = {
            false, {0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(8 / distance) * 57.3};
        draft.image.height = distance < 100 ? 64 : 6;
        draft.image.width = distance < 100 ? 64 : 8;
        rows.push_back({"detail at " + std::to_string(distance), Effect::kDetail, draft});
    }
}

std::vector<Row> table() {
    std::vector<Row> rows;
    add_depths(rows);
    add_surroundings(rows);
    return rows;
}

// Those whose pictures are made.
std::vector<Row> rendered_rows() {
    std::vector<Row> rows;
    std::size_t i = 0;
    for (Row& row : table())
        if (i++ % test::or_fewer<std::size_t>(1, 5) == 0) rows.push_back(std::move(row));
    return rows;
}

Rendered render_with(const Row& row, Switch to) {
    SceneDraft draft = row.draft;
    effect(draft, row.effect) = to;
    draft.accuracy.rung = to == Switch::kOff ? row.without : row.with;
    // Where rungs decide, additive stands for a cloud without either of them.
    if (row.effect == Effect::kSelfShadow) {
        draft.accuracy.rung = "harris";
        effect(draft, Effect::kMultipleScattering) = Switch::kOff;  // it travels with the other
    }
    if (row.effect == Effect::kViewExtinction) draft.accuracy.rung = "harris";
    return test::render(draft, 2);
}

// rms difference over the pixels that show cloud (all, where the sky is behind), over the rms of a: a cloud whose rim
// is ten times as bright as the rest counts as what it is.
double difference(const Image& a, const Image& b) {
    double squares = 0, sum = 0, most = 0;
    for (std::size_t p = 3; p < a.pixels.size(); p += 4) most = std::max(most, double{a.pixels[p]});
    for (std::size_t p = 0; p < a.pixels.size(); p += 4) {
        if (double{a.pixels[p + 3]} < 0.05 * most) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = double{a.pixels[p + c]} - double{b.pixels[p + c]};
            squares += d * d;
            sum += double{a.pixels[p + c]} * double{a.pixels[p + c]};
        }
    }
    if (!(sum > 0)) return 0;
    return std::sqrt(squares / sum);
}

// Half as much again as the 1% that thresholds stand for: they are rounded, and the pixels few.
constexpr double kUnseen = 0.015;

TEST(Effects, ForcedOnWhereTheyAreNotNeededAreNotSeen) {
    int unneeded = 0;
    for (Row& row : rendered_rows()) {
        const auto planned = plan_scene(test::valid(row.draft), 2, {});
        ASSERT_TRUE(planned.ok());
        const Criterion own = criterion(row.effect, test::valid(row.draft), planned->survey);
        if (own.wanted) continue;
        ++unneeded;
        const double d =
            difference(render_with(row, Switch::kOn).image, render_with(row, Switch::kOff).image);
        EXPECT_LE(d, kUnseen) << row.name << ": " << own.reason;
    }
    EXPECT_GE(unneeded, test::or_fewer(20, 3));
}

TEST(Effects, LeftOutWhereTheyAreNeededCostWhatThePlanSays) {
    int needed = 0;
    std::vector<std::vector<double>> ratios(kEffectCount);
    for (Row& row : rendered_rows()) {
        const auto planned = plan_scene(test::valid(row.draft), 2, {});
        ASSERT_TRUE(planned.ok());
        const Criterion own = criterion(row.effect, test::valid(row.draft), planned->survey);
        if (!own.wanted) continue;
        ++needed;
        const double d =
            difference(render_with(row, Switch::kOn).image, render_with(row, Switch::kOff).image);
        std::printf("%-40s without it %6.2f%%, said %6.2f%%  (%s)\n", row.name.c_str(), 100 * d,
                    100 * own.left_out, own.reason.c_str());
        // Said too low by a third at most; that it is said too high shows in the medians.
        EXPECT_LE(d, 1.5 * own.left_out + 0.01) << row.name << ": " << own.reason;
        ratios[static_cast<std::size_t>(row.effect)].push_back(own.left_out / std::max(d, 1e-4));
    }
    EXPECT_GE(needed, test::or_fewer(30, 5));
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        if (ratios[i].empty()) continue;
        std::sort(ratios[i].begin(), ratios[i].end());
        EXPECT_LE(ratios[i][ratios[i].size() / 2], 4.0) << effect_name(static_cast<Effect>(i));
    }
}

TEST(Effects, TheTableHasSixtyScenes) {
    EXPECT_GE(table().size(), 60u);
}

// One reason each, whatever is switched how: and an effect that runs was asked for or is needed.
TEST(Effects, EveryDecisionHasAReason) {
    for (const Row& row : table())
        for (const Switch to : {Switch::kAuto, Switch::kOn, Switch::kOff}) {
            SceneDraft draft = row.draft;
            effect(draft, row.effect) = to;
            draft.accuracy = {};
            const auto planned = plan_scene(test::valid(draft), 2, {});
            ASSERT_TRUE(planned.ok());
            for (const EffectDecision& decision : planned->plan.effects) {
                EXPECT_FALSE(decision.reason.empty()) << effect_name(decision.effect);
                EXPECT_TRUE(std::isfinite(decision.left_out) && decision.left_out >= 0);
            }
        }
}

}  // namespace
}  // namespace awan
