// Hills on the ground: their heights, rays that meet them, their light against laws, and what they do to a scene.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/draw/hills_backdrop.h"
#include "core/light/relief_light.h"
#include "core/pipeline.h"
#include "core/scene/fingerprint.h"
#include "core/survey/relief_ray.h"
#include "core/truth/relief_walk.h"
#include "tests/terrain_scenes.h"

namespace awan {
namespace {

using std::numbers::pi;

std::shared_ptr<const Relief> relief_in(const SceneDraft& draft, int threads = 2) {
    return relief_of(*test::valid(draft), threads);
}

// A wall along z in the middle of the square, `share` of it wide, on a level floor.
SceneDraft with_wall(double share) {
    return test::with_map(test::over_hills(), test::hills_by(256, [=](double x, double) {
                              return std::abs(x - .5) < .5 * share ? 1. : 0.;
                          }));
}

TEST(Terrain, ReachesItsHeightAndRunsOutIntoTheLevelGround) {
    for (const double level : {0., .4}) {
        SceneDraft draft = test::over_hills();
        draft.ground->terrain->level = level;
        const auto relief = relief_in(draft);
        ASSERT_NE(relief, nullptr);
        EXPECT_NEAR(relief->highest, 7, 1e-4);
        EXPECT_EQ(relief->base, -12);
        EXPECT_NEAR(relief->high().x - relief->low.x, 120, 1e-9);
        double most = 0, least = 1e9, flat = 0;
        for (const float h : relief->height) {
            most = std::max(most, static_cast<double>(h));
            least = std::min(least, static_cast<double>(h));
            flat += h == 0;
        }
        EXPECT_EQ(most, relief->highest);
        EXPECT_EQ(least, 0);
        // What lies below the level is flat.
        if (level > 0) {
            EXPECT_GT(flat, .15 * static_cast<double>(relief->height.size()));
        }
        for (int i = 0; i <= relief->cells.x; ++i) {
            EXPECT_EQ(relief->node(i, 0), 0);
            EXPECT_EQ(relief->node(i, relief->cells.y), 0);
            EXPECT_EQ(relief->node(0, i), 0);
            EXPECT_EQ(relief->node(relief->cells.x, i), 0);
        }
        EXPECT_EQ(height_at(*relief, 61, 0), 0);
    }
}

TEST(Terrain, IsTheSameForEveryNumberOfThreadsAndAnotherForEverySeed) {
    SceneDraft draft = test::over_hills();
    const auto one = relief_in(draft, 1), four = relief_in(draft, 4);
    EXPECT_EQ(one->height, four->height);
    draft.ground->terrain->seed = 2;
    EXPECT_NE(relief_in(draft)->height, one->height);
    // A scene that differs in its camera alone has the very same.
    const Scene scene = test::valid(draft);
    SceneDraft moved = *scene;
    moved.camera.eye.x += 1;
    EXPECT_EQ(relief_of(*test::valid(moved), 2), relief_of(*scene, 2));
    moved.ground->terrain->height += 1;
    EXPECT_NE(relief_of(*test::valid(moved), 2), relief_of(*scene, 2));
}

TEST(Terrain, ALongerPictureKeepsItsProportions) {
    Texture texture = *test::hills_by(1, [](double, double) { return 1; });
    texture.heights.across = 200;
    texture.heights.down = 50;
    texture.heights.heights.assign(200 * 50, 65535);
    texture.heights.hash = height_map_hash(texture.heights);
    const auto relief = relief_in(
        test::with_map(test::over_hills(), std::make_shared<const Texture>(std::move(texture))));
    EXPECT_EQ(relief->cells, glm::ivec2(1024, 256));
    EXPECT_NEAR(relief->high().y - relief->low.y, 30, 1e-9);
    EXPECT_NEAR(height_at(*relief, 0, 0), 7, 1e-3);
}

TEST(Terrain, APictureIsAsHighAsItIsBright) {
    const auto relief = relief_in(test::with_map(
        test::over_hills(),
        test::hills_by(64, [](double x, double z) { return .25 + .5 * x + .2 * z; })));
    // Away from the sides, where it runs out; its upper edge lies towards -z.
    for (const double x : {-20., 0., 25.})
        for (const double z : {-30., 5., 20.})
            EXPECT_NEAR(height_at(*relief, x, z),
                        7 * (.25 + .5 * (x / 120 + .5) + .2 * (z / 120 + .5)), .03);
    const glm::dvec3 normal = normal_at(*relief, 3, 4), slope(-7 * .5 / 120, 1, -7 * .2 / 120);
    EXPECT_LT(glm::length(normal - glm::normalize(slope)), 1e-3);
}

TEST(Terrain, RaysFromAboveMeetTheSurfaceAndNoneIsLost) {
    const auto relief = relief_in(test::over_hills());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    int hills = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 o(160 * (unit(random) - .5), -4.9 + 8 * unit(random),
                           160 * (unit(random) - .5));
        const double turn = 2 * pi * unit(random), up = i % 50 == 0 ? -1 : -unit(random);
        const glm::dvec3 d(std::sqrt(1 - up * up) * std::cos(turn), up,
                           std::sqrt(1 - up * up) * std::sin(turn));
        const double t = ground_ahead(*relief, o, d);
        // All of them come down, and begin above the highest top.
        ASSERT_TRUE(std::isfinite(t));
        const glm::dvec3 p = o + t * d;
        const double height = height_at(*relief, p.x, p.z);
        ASSERT_NEAR(p.y - relief->base, height, 1e-7 * (1 + t)) << i;
        hills += height > .1;
        // Nothing stood before.
        for (int k = 1; k < 40; ++k) {
            const glm::dvec3 q = o + (t * k / 40) * d;
            ASSERT_GT(q.y - relief->base, height_at(*relief, q.x, q.z) - 1e-7) << i;
        }
    }
    EXPECT_GT(hills, 5000);
}

TEST(Terrain, TheTruthMeetsTheSameSurfaceByItsOwnWay) {
    const Scene scene = test::valid(test::over_hills());
    const auto relief = relief_of(*scene, 2);
    const auto walk = truth::relief_walk_of(scene, 2);
    ASSERT_TRUE(walk.has_value());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    int met = 0, unlike = 0;
    for (int i = 0; i < 20000; ++i) {
        // From anywhere, below the surface too, in any direction.
        const glm::dvec3 o(140 * (unit(random) - .5), -14 + 12 * unit(random),
                           140 * (unit(random) - .5));
        const double turn = 2 * pi * unit(random), up = 2 * unit(random) - 1;
        const glm::dvec3 d(std::sqrt(1 - up * up) * std::cos(turn), up,
                           std::sqrt(1 - up * up) * std::sin(turn));
        const double a = ground_ahead(*relief, o, d), b = truth::ground_ahead(*walk, o, d);
        met += std::isfinite(a);
        // A ray may graze an edge by rounding in one of them.
        unlike += std::isfinite(a) != std::isfinite(b) ||
                  (std::isfinite(a) && std::abs(a - b) > 1e-6 * (1 + a));
    }
    EXPECT_GT(met, 5000);
    EXPECT_LE(unlike, 2);
}

TEST(Terrain, HardRaysEnd) {
    SceneDraft steep = with_wall(.2);
    steep.ground->terrain->height = 1e6;
    SceneDraft giant = test::over_hills();
    giant.ground->terrain->extent = 1e9;
    giant.ground->terrain->size = 1e-9;
    SceneDraft tiny = test::over_hills();
    tiny.ground->terrain->extent = 1e-9;
    SceneDraft tall = test::over_hills();
    tall.ground->terrain->height = 1e9;
    for (const SceneDraft& draft : {steep, giant, tiny, tall}) {
        const Scene scene = test::valid(draft);
        const auto relief = relief_of(*scene, 2);
        const auto walk = truth::relief_walk_of(scene, 2);
        for (const float h : relief->height) ASSERT_TRUE(std::isfinite(h) && h >= 0);
        for (const glm::dvec3& o : {glm::dvec3(0, 2e9, 0), glm::dvec3(1e-3, -11, 2), glm::dvec3(0)})
            for (const glm::dvec3& d :
                 {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0),
                  glm::dvec3(0, 0, -1), glm::normalize(glm::dvec3(1, -1e-9, 1)),
                  glm::normalize(glm::dvec3(1e-12, -1, 1e-12))}) {
                const double t = ground_ahead(*relief, o, d);
                EXPECT_GE(t, 0);
                EXPECT_GE(truth::ground_ahead(*walk, o, d), 0);
            }
    }
}

TEST(Terrain, UnderAnEvenSkyASlopeAndAFlatAreLitAsTheyMustBe) {
    // A ramp whose foot is far away and nothing stands before: of an even sky of radiance 1 a slope of angle a sees the
    // part above the horizon, pi (1 + cos a) / 2. The rest is what the ramp and the plain send up: B.
    SceneDraft draft = test::with_map(test::over_hills(), test::hills_by(256, [](double x, double) {
                                          return std::clamp(2 * x - .5, 0., 1.);
                                      }));
    draft.ground->terrain->height = 40;
    draft.ground->albedo = glm::dvec3(.5);
    draft.ground->terrain->rock.reset();
    draft.sun.intensity = 0;
    draft.sky.zenith = draft.sky.horizon = glm::dvec3(1);
    draft.sky.intensity = 1;
    const Scene scene = test::valid(draft);
    const GroundLight ground = bare_ground(*scene);
    ASSERT_NE(ground.relief, nullptr);
    const ReliefLight light = relief_light(scene, ground, 2);
    const auto seen = [&](double x, double z) {
        const glm::dvec3 p(x, ground.height + height_at(*ground.relief, x, z), z);
        const glm::dvec3 normal = normal_at(*ground.relief, x, z);
        return radiance_at(light, ground, p, {}) * pi / albedo_at(*ground.relief, x, z, normal);
    };
    const double angle = std::atan(40 / 60.);
    const double open = pi * (1 + std::cos(angle)) / 2;
    const glm::dvec3 slope = seen(0, 0), plain = seen(500, 0);
    const double bounced = pi * light.bounced.x * (1 - open / pi);
    EXPECT_NEAR(slope.x, open + bounced, .03 * pi);
    EXPECT_NEAR(plain.x, pi, .03 * pi);
}

TEST(Terrain, ASlopeTakesTheSunByItsCosineAndAWallsShadowIsAsLongAsItsHeight) {
    SceneDraft draft = with_wall(.1);
    draft.sun.elevation = 30;
    draft.sun.azimuth = 90;  // from +x
    draft.sun.intensity = 2;
    draft.sun.color = glm::dvec3(1);
    draft.sky.none = true;
    draft.ground->terrain->rock.reset();
    const Scene scene = test::valid(draft);
    const GroundLight ground = bare_ground(*scene);
    const ReliefLight light = relief_light(scene, ground, 2);
    const glm::dvec3 to_sun = sun_direction(draft.sun);
    ASSERT_GT(to_sun.x, .8);
    const auto at = [&](double x) {
        const glm::dvec3 p(x, ground.height + height_at(*ground.relief, x, 0), 0);
        return radiance_at(light, ground, p, {}).x * pi /
               albedo_at(*ground.relief, x, 0, normal_at(*ground.relief, x, 0)).x;
    };
    // The wall is 12 wide (from -6 to 6) and 7 high: its shadow falls towards -x, 7 / tan(30 degrees) long.
    const double length = 7 / std::tan(pi / 6);
    const double none = pi * light.bounced.x;  // at most
    for (const double beyond : {1.5, 6.})
        EXPECT_NEAR(at(-6 - length - beyond), 2 * to_sun.y, none) << beyond;
    for (const double within : {1.5, 6.}) EXPECT_LE(at(-6 - length + within), none) << within;
    EXPECT_NEAR(at(20), 2 * to_sun.y, none);
}

TEST(Terrain, ASunOnOrBelowTheHorizonLightsNoHill) {
    for (const double elevation : {0., -5.}) {
        SceneDraft draft = test::over_hills(elevation);
        draft.sky.none = true;
        const Scene scene = test::valid(draft);
        const GroundLight ground = bare_ground(*scene);
        const ReliefLight light = relief_light(scene, ground, 2);
        EXPECT_EQ(radiance_at(light, ground, {0, ground.height + 1, 0}, {}), glm::dvec3(0));
    }
}

TEST(Terrain, HillsShadeWhatLiesInTheirShadowAndNothingElse) {
    SceneDraft draft = with_wall(.1);
    const Scene scene = test::valid(draft);
    const auto relief = relief_of(*scene, 2);
    // Light from +x, 45 degrees high; a lattice of empty nodes on the far side of the wall.
    SunDepth sun;
    sun.w = glm::normalize(glm::dvec3(-1, -1, 0));
    sun.u = {0, 0, 1};
    sun.v = glm::normalize(glm::dvec3(1, -1, 0));
    sun.cell = glm::dvec3(.5);
    sun.nodes = {3, 33, 65};
    sun.origin = glm::dvec3(-2, 2, 0);
    sun.depth.assign(3 * 33 * 65, 0.F);
    shade_by_hills(*relief, 2, sun);
    int dark = 0, lit = 0;
    for (int k = 0; k < 65; ++k)
        for (int j = 0; j < 33; ++j) {
            const glm::dvec3 p = sun.origin + .5 * j * sun.v + .5 * k * sun.w;
            const bool shaded = sun.depth[static_cast<std::size_t>((k * 33 + j) * 3)] > 0;
            // The wall's edge nearest to here stands at (-6, -5); what is lower along the light is in its shadow.
            const double above = p.y - (-5) - (p.x - (-6));
            if (p.x > -7 || p.y < -11.5) continue;
            if (above > .5) {
                EXPECT_FALSE(shaded);
                ++lit;
            }
            if (above < -.5) {
                EXPECT_TRUE(shaded);
                ++dark;
            }
        }
    EXPECT_GT(dark, 20);
    EXPECT_GT(lit, 20);
}

TEST(Terrain, HidesTheCloudBehindIt) {
    SceneDraft draft = with_wall(.06);
    draft.ground->terrain->height = 60;
    draft.camera.eye = {45, 2, 0};
    draft.camera.target = {0, -2, 0};
    for (Cube& cube : draft.clouds[0].cubes) cube.center.x -= 30;
    draft.image.background = Background::kTransparent;
    for (const int cells : {0, 16}) {
        const auto hidden = test::ground_picture(draft, cells);
        SceneDraft open = draft;
        test::effect(open, Effect::kTerrain) = Switch::kOff;
        const auto seen = test::ground_picture(open, cells);
        float most = 0, least = 0;
        for (std::size_t i = 3; i < hidden.image.pixels.size(); i += 4) {
            least = std::max(least, hidden.image.pixels[i]);
            most = std::max(most, seen.image.pixels[i]);
        }
        EXPECT_GT(most, .9F);
        EXPECT_EQ(least, 0.F);
    }
    const TruthImage truth = test::ground_truth(draft, 2);
    for (std::size_t i = 3; i < truth.half_a.pixels.size(); i += 4)
        ASSERT_EQ(truth.half_a.pixels[i], 0.F);
}

TEST(Terrain, HazeAndItsLightEndAtTheHills) {
    // In front of a wall a ray has the haze up to it, and no more.
    SceneDraft draft = with_wall(.06);
    draft.ground->terrain->height = 60;
    draft.ground->albedo = glm::dvec3(0);
    draft.ground->terrain->rock.reset();
    draft.camera.eye = {45, 2, 0};
    draft.camera.target = {0, 2, 0};
    for (Cube& cube : draft.clouds[0].cubes) cube.center.x -= 30;
    draft.haze = Haze{.02, 100, 4, glm::dvec3(1), 0};
    draft.image.background = Background::kTransparent;
    const auto made = test::ground_picture(draft, 16);
    const test::Ray r = test::ray(made.planned.survey.view, made.image, 30, 20);
    const auto relief = relief_in(draft);
    const double t = hills_ahead(*relief, r.eye, r.direction);
    ASSERT_NEAR(t, 41.4, 1.5);
    const std::size_t at = 4 * (20 * 60 + 30);
    EXPECT_NEAR(made.image.pixels[at + 3], 1 - std::exp(-.02 * t), 2e-3);
    const TruthImage truth = test::ground_truth(draft, 2);
    EXPECT_NEAR(truth.half_a.pixels[at + 3], 1 - std::exp(-.02 * t), 2e-3);
}

TEST(Terrain, WhereItIsSwitchedOffOrHasNoHeightThePictureIsThatOfTheLevelGround) {
    SceneDraft level = test::over_hills();
    level.ground->terrain.reset();
    const Image expected = test::ground_picture(level, 16).image;
    SceneDraft flat = test::over_hills(), off = test::over_hills();
    flat.ground->terrain->height = 0;
    test::effect(off, Effect::kTerrain) = Switch::kOff;
    for (const SceneDraft& draft : {flat, off}) {
        const auto made = test::ground_picture(draft, 16);
        EXPECT_EQ(made.image.pixels, expected.pixels);
        EXPECT_EQ(made.light.ground.relief, nullptr);
        EXPECT_FALSE(made.planned.plan.on(Effect::kTerrain));
    }
    EXPECT_NE(test::ground_picture(test::over_hills(), 16).image.pixels, expected.pixels);
}

TEST(Terrain, IsListedAmongTheEffectsWithItsReason) {
    const auto planned = [](const SceneDraft& draft) {
        return plan_only(test::valid(draft), 2, {})->plan;
    };
    SceneDraft draft = test::over_hills();
    EXPECT_TRUE(planned(draft).on(Effect::kTerrain));
    EXPECT_NE(planned(draft).of(Effect::kTerrain).reason.find("hills, in 0."), std::string::npos);
    draft.ground->terrain.reset();
    EXPECT_EQ(planned(draft).of(Effect::kTerrain).reason, "the scene has no terrain");
    test::effect(draft, Effect::kTerrain) = Switch::kOn;
    EXPECT_FALSE(planned(draft).on(Effect::kTerrain));
}

TEST(Terrain, LeavesNoTraceInTheFingerprintsOfScenesWithoutIt) {
    SceneDraft draft = test::table_4_4();
    const std::string bare = fingerprint(test::valid(draft)),
                      light = light_fingerprint(test::valid(draft));
    test::effect(draft, Effect::kTerrain) = Switch::kOff;
    EXPECT_NE(fingerprint(test::valid(draft)), bare);
    test::effect(draft, Effect::kTerrain) = Switch::kAuto;
    draft.ground = Ground{-9, glm::dvec3(.2)};
    const std::string grounded = fingerprint(test::valid(draft));
    draft.ground->terrain = Terrain{};
    EXPECT_NE(fingerprint(test::valid(draft)), grounded);
    EXPECT_NE(light_fingerprint(test::valid(draft)), light);
    // By whatever name a height map comes, it is the same scene; and another map is another.
    const auto map = test::hills_by(16, [](double x, double) { return x; });
    Texture other = *map;
    other.name = "others";
    const std::string by_name = fingerprint(test::valid(test::with_map(draft, map)));
    EXPECT_EQ(
        fingerprint(test::valid(test::with_map(draft, std::make_shared<const Texture>(other)))),
        by_name);
    other.heights.heights[7] ^= 1U;
    other.heights.hash = height_map_hash(other.heights);
    EXPECT_NE(
        fingerprint(test::valid(test::with_map(draft, std::make_shared<const Texture>(other)))),
        by_name);
}

TEST(Terrain, AMapThatIsNotThereIsAnError) {
    SceneDraft draft = test::over_hills();
    draft.ground->terrain->map = "alps";
    const auto made = validate(draft);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().pointer, "/ground/terrain/map");
    EXPECT_NE(made.error().message.find("soft"), std::string::npos);
}

TEST(Terrain, AnEyeUnderTheHillsSeesOutOfThem) {
    // From below they are not there: as from below the level ground.
    SceneDraft draft = with_wall(.2);
    draft.ground->terrain->height = 60;
    draft.camera.eye = {0, 2, 0};
    draft.camera.target = {-30, 2, 0};
    for (Cube& cube : draft.clouds[0].cubes) cube.center.x -= 40;
    const auto made = test::ground_picture(draft, 16);
    const auto relief = relief_in(draft);
    EXPECT_GT(height_at(*relief, 0, 0), 50);
    for (const float one : made.image.pixels) ASSERT_TRUE(std::isfinite(one));
    const test::Ray r = test::ray(made.planned.survey.view, made.image, 30, 20);
    EXPECT_TRUE(std::isinf(hills_ahead(*relief, r.eye, {-1, 0, 0})));
}

TEST(Terrain, PicturesAreTheSameForEveryNumberOfThreads) {
    SceneDraft draft = test::over_hills(15);
    draft.haze = Haze{.004, -12, 6, glm::dvec3(1), .5};
    const auto one = test::ground_picture(draft, 16, true, true, 1),
               four = test::ground_picture(draft, 16, true, true, 4);
    EXPECT_EQ(one.image.pixels, four.image.pixels);
}

}  // namespace
}  // namespace awan
