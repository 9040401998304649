// Light that is kept is the light that would be made: no picture tells that there is a cache.
#include <gtest/gtest.h>

#include "core/light/light_cache.h"
#include "core/pipeline.h"
#include "core/scene/spheres.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// All that light depends on, at once: an automatic sun, a physical sky, a ground, detail.
SceneDraft lit() {
    SceneDraft draft = test::table_4_4();
    draft.sun.auto_color = true;
    draft.sun.elevation = 12;
    draft.sky.physical = true;
    draft.sky.intensity = kPhysicalSkyIntensity;
    draft.ground = Ground{-7, glm::dvec3(0.4, 0.5, 0.3)};
    draft.haze = Haze{};
    draft.haze->extinction = 0.01;
    draft.detail = Detail{};
    draft.image.width = 24;
    draft.image.height = 18;
    draft.accuracy.rung = "transport-16";
    return draft;
}

struct Picture {
    std::vector<float> pixels;
    bool kept = false;
};
Picture picture(const SceneDraft& draft, LightCache* lights) {
    static DetailTiles tiles;  // making one takes longer than all else here
    const Scene scene = test::valid(draft);
    auto rendered = render_planned(scene, *plan_scene(scene, 2, {}, {}, &tiles),
                                   {nullptr, 2, lights, {}, {}}, {});
    EXPECT_TRUE(rendered.ok());
    return {rendered->image.pixels, rendered->light_was_kept};
}

// A picture by kept light is the one without a cache; where light was made anew it is so of itself.
void expect_own_light(const SceneDraft& draft, LightCache& lights, const std::string& what) {
    const Picture one = picture(draft, &lights);
    if (!one.kept) return;
    EXPECT_EQ(one.pixels, picture(draft, nullptr).pixels) << what;
}

TEST(KeptLight, IsThatOfTheSwitchesOfThePicture) {
    LightCache lights(64 << 20);
    EXPECT_FALSE(picture(lit(), &lights).kept);
    EXPECT_TRUE(picture(lit(), &lights).kept);
    expect_own_light(lit(), lights, "all");
    for (int i = 0; i < kEffectCount; ++i) {
        SceneDraft draft = lit();
        draft.effects[i] = Switch::kOff;
        expect_own_light(draft, lights, effect_name(static_cast<Effect>(i)));
    }
    SceneDraft plain = lit();
    plain.sun.auto_color = false;
    plain.sky = test::plain_draft().sky;
    expect_own_light(plain, lights, "another sun and sky");
    for (const Effect effect : {Effect::kSunColor, Effect::kSkyLight}) {
        SceneDraft draft = plain;
        test::effect(draft, effect) = Switch::kOff;
        expect_own_light(draft, lights, effect_name(effect));
    }
}

// A finer grid goes on from the light of the coarser ones, and all of it may be kept.
TEST(KeptLight, IsThatOfTheRungOfThePicture) {
    LightCache lights(64 << 20);
    for (const char* rung : {"single", "transport-24", "transport-16", "single", "transport-24"}) {
        SceneDraft draft = lit();
        draft.accuracy.rung = rung;
        EXPECT_EQ(picture(draft, &lights).pixels, picture(draft, nullptr).pixels) << rung;
    }
}

// Whether there is detail, of which seed and of what size is not in the clouds alone.
TEST(KeptLight, IsThatOfTheDetailOfThePicture) {
    LightCache lights(64 << 20);
    SceneDraft draft = lit();
    draft.top_level_cubes = false;
    draft.ground.reset();
    draft.haze.reset();
    draft.clouds[0].seed = 7;
    draft.camera = {false, {0, 0, 40}, {0, 0, 0}, {0, 1, 0}, 40};
    expect_own_light(draft, lights, "first");
    draft.camera.eye = {0, 0, 1e5};  // bumps are far below a pixel
    expect_own_light(draft, lights, "from afar");
    draft.camera.eye = {0, 0, 40};
    draft.seed = 12;
    expect_own_light(draft, lights, "another seed");
    draft.seed = 1;
    // Where bumps stand is settled for a sequence at its first frame; two clouds part afterwards.
    draft.clouds.push_back(draft.clouds[0]);
    draft.clouds[0].velocity = {3, 0, 0};
    expect_own_light(draft, lights, "two clouds");
    draft.sequence = Sequence{-20, 20, 5};
    expect_own_light(draft, lights, "one of a sequence");
}

// Which spheres become particles depends on the eye: there the light is the picture's.
TEST(KeptLight, IsThatOfTheParticlesOfThePicture) {
    LightCache lights(64 << 20);
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.emplace_back();
    draft.clouds[0].model = CloudModel::kSpheres;
    SpheresCloud spheres;
    spheres.levels = 5;
    draft.clouds[0].spheres = std::make_shared<const SpheresCloud>(spheres);
    draft.image.width = 24;
    draft.image.height = 18;
    draft.accuracy.rung = "transport-16";
    for (const double away : {40.0, 41.0, 400.0, 4000.0}) {
        draft.camera = {false, {0, 0, away}, {0, 0, 0}, {0, 1, 0}, 40};
        expect_own_light(draft, lights, std::to_string(away));
    }
}

// A light of about four bytes a float.
std::shared_ptr<const TransportLight> light_of(std::size_t floats) {
    TransportLight light;
    light.sun.depth.resize(floats);
    return std::make_shared<const TransportLight>(std::move(light));
}

TEST(LightCache, KeepsTheLatestWithinItsBytes) {
    const std::size_t each = light_of(1000)->bytes();
    LightCache cache(3 * each);
    cache.keep("a", light_of(1000));
    cache.keep("b", light_of(1000));
    cache.keep("c", light_of(1000));
    EXPECT_TRUE(cache.find("a"));  // now the most recent
    cache.keep("d", light_of(1000));
    EXPECT_FALSE(cache.find("b"));
    EXPECT_TRUE(cache.find("a") && cache.find("c") && cache.find("d"));
    EXPECT_LE(cache.bytes_in_use(), 3 * each);
    cache.keep("huge", light_of(100000));  // more than all of it: left out, nothing is lost
    EXPECT_FALSE(cache.find("huge"));
    EXPECT_TRUE(cache.find("a"));
    cache.keep("a", light_of(1000));
    EXPECT_LE(cache.bytes_in_use(), 3 * each);
}

TEST(LightCache, WhatTakesAnothersPlaceTakesItsBytesToo) {
    const std::size_t each = light_of(1000)->bytes();
    LightCache cache(3 * each);
    cache.keep("other", light_of(1000));
    for (int i = 0; i < 20; ++i) cache.keep("same", light_of(1000));
    EXPECT_EQ(cache.bytes_in_use(), 2 * each);
    EXPECT_TRUE(cache.find("other") && cache.find("same"));
    cache.keep("same", light_of(500));
    EXPECT_LT(cache.bytes_in_use(), 2 * each);
}

TEST(LightCache, KeyHasEverySetting) {
    const Scene scene = test::valid(test::table_4_4());
    const std::vector<std::function<void(TransportSettings&)>> changes{
        [](TransportSettings& s) { s.cells += 1; },
        [](TransportSettings& s) { s.sun_cells += 1; },
        [](TransportSettings& s) { s.tolerance *= 0.5; },
        [](TransportSettings& s) { s.max_sweeps += 1; },
        [](TransportSettings& s) { s.sky = !s.sky; },
        [](TransportSettings& s) { s.ground = !s.ground; },
        [](TransportSettings& s) { s.ground_shadow = !s.ground_shadow; },
        [](TransportSettings& s) {
            s.islands.push_back({16, 48});
        },
        [](TransportSettings& s) {
            s.islands.push_back({16, 0});
        },
        [](TransportSettings& s) {
            s.islands.assign(2, {16, 48});
        }};
    std::vector<std::string> keys{light_key(scene, {}), light_key(scene, {}, 1)};
    for (const auto& change : changes) {
        TransportSettings settings;
        change(settings);
        keys.push_back(light_key(scene, settings));
    }
    for (std::size_t i = 0; i < keys.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(keys[i], keys[j]) << i << ' ' << j;
}

}  // namespace
}  // namespace awan
