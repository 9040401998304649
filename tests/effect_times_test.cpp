// What effects took, where it can be told apart.
#include <gtest/gtest.h>

#include <numeric>

#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "scenes.h"

namespace awan::test {
namespace {

constexpr Effect kTold[] = {Effect::kSelfShadow,        Effect::kMultipleScattering,
                            Effect::kSkyLight,          Effect::kGroundLight,
                            Effect::kGroundShadow,      Effect::kDetail,
                            Effect::kAerialPerspective, Effect::kLightShafts};

// All of them on.
SceneDraft everything() {
    SceneDraft draft = table_4_4();
    draft.image.width = 48;
    draft.image.height = 32;
    draft.ground = Ground{};
    draft.ground->height = -6;
    draft.haze = Haze{};
    draft.haze->extinction = 0.02;
    draft.detail = Detail{};
    draft.accuracy.rung = "transport-16";
    for (const Effect effect : kTold) draft.effects[static_cast<int>(effect)] = Switch::kOn;
    return draft;
}

Result<Rendered> rendered(const SceneDraft& draft, LightCache* lights = nullptr) {
    const auto scene = validate(draft);
    if (!scene.ok()) return scene.error();
    Tools tools;
    tools.lights = lights;
    return render_scene(*scene, tools, {});
}

TEST(EffectTimes, WhatRanIsToldAndIsPartOfItsStages) {
    const auto picture = rendered(everything());
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    const StageTimes& times = picture->times;
    for (const Effect effect : kTold) EXPECT_GT(times.effects.of(effect), 0) << effect_name(effect);
    for (const Effect effect : {Effect::kViewExtinction, Effect::kInterior, Effect::kTexture})
        EXPECT_EQ(times.effects.of(effect), 0) << effect_name(effect);
    const double sum = std::accumulate(times.effects.ms.begin(), times.effects.ms.end(), 0.0);
    EXPECT_LE(sum, times.survey_ms + times.light_ms + times.draw_ms);
}

TEST(EffectTimes, WhatIsSwitchedOffTakesNone) {
    for (const Effect effect : kTold) {
        // The transport rungs always follow these.
        if (effect == Effect::kSelfShadow || effect == Effect::kMultipleScattering) continue;
        SceneDraft draft = everything();
        draft.effects[static_cast<int>(effect)] = Switch::kOff;
        const auto picture = rendered(draft);
        ASSERT_TRUE(picture.ok());
        EXPECT_EQ(picture->times.effects.of(effect), 0) << effect_name(effect);
    }
}

TEST(EffectTimes, KeptLightTakesNone) {
    LightCache lights(64 << 20);
    ASSERT_TRUE(rendered(everything(), &lights).ok());
    const auto again = rendered(everything(), &lights);
    ASSERT_TRUE(again.ok());
    ASSERT_TRUE(again->light_was_kept);
    EXPECT_EQ(again->times.effects.of(Effect::kSkyLight), 0);
    EXPECT_GT(again->times.effects.of(Effect::kLightShafts), 0) << "the eye pass runs anew";
}

TEST(EffectTimes, IslandsSideBySideTakeNoLongerThanTheLight) {
    SceneDraft draft = everything();
    draft.top_level_cubes = false;
    Cloud other = draft.clouds[0];
    other.translate = {60, 0, 0};
    draft.clouds.push_back(other);
    const auto picture = rendered(draft);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    ASSERT_EQ(picture->plan.transport.islands.size(), 2U);
    const EffectTimes& effects = picture->times.effects;
    EXPECT_LE(effects.of(Effect::kSelfShadow) + effects.of(Effect::kMultipleScattering) +
                  effects.of(Effect::kSkyLight) + effects.of(Effect::kGroundLight) +
                  effects.of(Effect::kGroundShadow),
              picture->times.light_ms);
}

}  // namespace
}  // namespace awan::test
