// Which rung a scene gets, and what it is told to expect.
#include <gtest/gtest.h>

#include <cmath>

#include "core/light/machine_speed.h"
#include "tests/scenes.h"

namespace awan {
namespace {

Plan plan_of(const SceneDraft& draft, int threads = 2, const MachineSpeed& speed = {}) {
    auto planned = plan_scene(test::valid(draft), 1, {});
    EXPECT_TRUE(planned.ok());
    return plan(test::valid(draft), planned->survey, threads, speed);
}

SceneDraft asking(const Accuracy& accuracy, double density = kDefaultDensity) {
    SceneDraft draft = test::table_4_4();
    draft.density = density;
    draft.accuracy = accuracy;
    return draft;
}

const RungForecast& forecast_of(const Plan& plan, const std::string& rung) {
    for (const RungForecast& forecast : plan.forecasts)
        if (rung == forecast.rung->name) return forecast;
    ADD_FAILURE() << rung;
    return plan.forecasts.front();
}

TEST(Plan, ForecastsEveryRungInTheLaddersOrder) {
    const Plan plan = plan_of(asking({}));
    ASSERT_EQ(plan.forecasts.size(), ladder().size());
    for (std::size_t i = 0; i < plan.forecasts.size(); ++i) {
        EXPECT_EQ(plan.forecasts[i].rung->id, ladder()[i].id);
        EXPECT_TRUE(std::isfinite(plan.forecasts[i].error) && plan.forecasts[i].error > 0);
        EXPECT_TRUE(std::isfinite(plan.forecasts[i].time_ms) && plan.forecasts[i].time_ms > 0);
        EXPECT_TRUE(std::isfinite(plan.forecasts[i].bytes) && plan.forecasts[i].bytes > 0);
    }
    // Finer grids: slower and better.
    for (const auto& [coarse, fine] : {std::pair("transport-16", "transport-24"),
                                       {"transport-24", "transport-32"},
                                       {"transport-32", "transport-48"},
                                       {"transport-48", "transport-64"}}) {
        EXPECT_LT(forecast_of(plan, coarse).time_ms, forecast_of(plan, fine).time_ms);
        EXPECT_GT(forecast_of(plan, coarse).error, forecast_of(plan, fine).error);
    }
}

TEST(Plan, TakesTheCheapestRungUnderAnError) {
    for (const double error : {5., 1., .5, .2, .15}) {
        const Plan plan = plan_of(asking({error, {}, {}}));
        EXPECT_LE(plan.predicted.error, error * (1 + 1e-9));
        EXPECT_EQ(plan.rung, plan.predicted.rung->name);
        for (const RungForecast& other : plan.forecasts)
            EXPECT_TRUE(other.error > error || other.time_ms >= plan.predicted.time_ms)
                << other.rung->name;
        EXPECT_NE(plan.rung_reason.find("cheapest"), std::string::npos) << plan.rung_reason;
    }
}

TEST(Plan, GoesToTheTruthForWhatNoGridCanDo) {
    SceneDraft draft = asking({.005, {}, {}});
    draft.image.width = draft.image.height = 2;
    const Plan plan = plan_of(draft);
    EXPECT_EQ(plan.rung, "truth");
    EXPECT_LE(plan.predicted.error, .005 * (1 + 1e-9));
    EXPECT_GT(plan.samples, 10000u);
}

TEST(Plan, SaysWhatTheTruthWouldTakeInsteadOfTakingIt) {
    const Plan plan = plan_of(asking({.005, {}, {}}));
    EXPECT_EQ(plan.predicted.rung->method, Method::kMarch);
    EXPECT_GT(plan.predicted.error, .005);
    EXPECT_NE(plan.rung_reason.find("truth, which would take"), std::string::npos)
        << plan.rung_reason;
    for (const RungForecast& other : plan.forecasts)
        EXPECT_TRUE(other.rung->method == Method::kPaths || other.error >= plan.predicted.error);
}

TEST(Plan, TakesTheBestRungWithinATime) {
    for (const double time_ms : {30., 100., 500., 3000.}) {
        const Plan plan = plan_of(asking({{}, time_ms, {}}));
        // The error is measured only where there is time for it.
        if (plan.predicted.picture_ms() > time_ms) {
            for (const RungForecast& other : plan.forecasts) EXPECT_GT(other.picture_ms(), time_ms);
            continue;
        }
        for (const RungForecast& other : plan.forecasts)
            EXPECT_TRUE(other.picture_ms() > time_ms || other.error >= plan.predicted.error)
                << other.rung->name;
    }
}

TEST(Plan, SaysSoWhenNothingIsFastEnough) {
    const Plan plan = plan_of(asking({{}, 1e-3, {}}));
    for (const RungForecast& other : plan.forecasts)
        EXPECT_GE(other.time_ms, plan.predicted.time_ms);
    EXPECT_NE(plan.rung_reason.find("none"), std::string::npos) << plan.rung_reason;
}

TEST(Plan, AsksForTenPercentWhereTheSceneAsksForNothing) {
    EXPECT_EQ(plan_of(asking({})).rung, plan_of(asking({.1, {}, {}})).rung);
}

TEST(Plan, AThinVeilNeedsLessThanAThickCloud) {
    const Plan thin = plan_of(asking({.1, {}, {}}, 1e-4)), thick = plan_of(asking({.1, {}, {}}));
    EXPECT_LT(thin.predicted.time_ms, thick.predicted.time_ms);
    // Where the rung leaves it to the scene, its own figures decide.
    EXPECT_FALSE(plan_of(asking({{}, {}, "harris"}, 1e-4)).on(Effect::kMultipleScattering));
    EXPECT_TRUE(plan_of(asking({{}, {}, "harris"})).on(Effect::kMultipleScattering));
}

TEST(Plan, AsksForNoPathsUnlessTheSceneDoes) {
    SceneDraft draft = asking({}, 1e3);  // so deep that no grid is predicted to reach 10%
    for (const int side : {2, 64, 600}) {
        draft.image.width = draft.image.height = side;
        draft.accuracy = {};
        const Plan plan = plan_of(draft);
        EXPECT_NE(plan.predicted.rung->method, Method::kPaths) << plan.rung_reason;
        draft.accuracy.error = kDefaultError;  // the same in words, and the same fingerprint
        EXPECT_EQ(plan_of(draft).rung, plan.rung);
    }
}

TEST(Plan, NamedRungsAreTakenAndTheirEffectsSaid) {
    for (const Rung& rung : ladder()) {
        const Plan plan = plan_of(asking({{}, {}, rung.name}));
        EXPECT_EQ(plan.rung, rung.name);
        const bool additive = plan.rung == "additive";
        EXPECT_EQ(plan.on(Effect::kSelfShadow), !additive);
        EXPECT_EQ(plan.on(Effect::kViewExtinction), !additive);
        EXPECT_EQ(plan.on(Effect::kMultipleScattering), !additive && plan.rung != "single");
        for (const EffectDecision& decision : plan.effects)
            EXPECT_FALSE(decision.reason.empty()) << effect_name(decision.effect);
    }
}

TEST(Plan, OnlySplatsLeaveOutWhatIsSwitchedOff) {
    SceneDraft draft = asking({.001, {}, {}});
    test::effect(draft, Effect::kSelfShadow) = Switch::kOff;
    const Plan plan = plan_of(draft);
    EXPECT_EQ(plan.predicted.rung->method, Method::kSplats);
    EXPECT_FALSE(plan.on(Effect::kSelfShadow));
}

TEST(Plan, SlowMachinesAndFewThreadsTakeLonger) {
    const SceneDraft draft = asking({{}, {}, "transport-32"});
    const double here = plan_of(draft).predicted.time_ms;
    EXPECT_NEAR(plan_of(draft, 2, {3}).predicted.time_ms, 3 * here, 1e-9 * here);
    EXPECT_GT(plan_of(draft, 1).predicted.time_ms, here);
    EXPECT_LT(plan_of(draft, 8).predicted.time_ms, here);
}

TEST(Plan, MeasuresTheMachine) {
    const double slowness = measure_speed().slowness;
    EXPECT_GE(slowness, .1);
    EXPECT_LE(slowness, 20);
}

TEST(Plan, EmptyScenesCostLittleAndAreExact) {
    SceneDraft draft = asking({});
    for (Cube& cube : draft.clouds[0].cubes) cube.particles = 0;
    const Plan plan = plan_of(draft);
    EXPECT_EQ(plan.predicted.error, 0);
    EXPECT_LT(plan.predicted.time_ms, plan_of(asking({})).predicted.time_ms);
}

}  // namespace
}  // namespace awan
