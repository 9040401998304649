// The look of Ostroushko et al.: rays through spheres against closed forms, and what must hold of every picture.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/looks/looks.h"
#include "core/looks/ostroushko_tile.h"
#include "core/scene/spheres.h"
#include "tests/random_models_spheres.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using spheres::SphereNode;

SceneDraft look_of(const SpheresCloud& spheres, int width = 80, int height = 60) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.look = Look::kOstroushko;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kSpheres;
    cloud.spheres = std::make_shared<SpheresCloud>(spheres);
    draft.image.width = width;
    draft.image.height = height;
    draft.image.background = Background::kTransparent;
    return draft;
}

Image picture_of(const SceneDraft& draft, int threads = 1) {
    const Scene scene = test::valid(draft);
    const View view = resolve_view(scene->camera, scene->image,
                                   {glm::dvec3(-250, -20, -200), glm::dvec3(250, 200, 200)});
    auto image = ostroushko_look(scene, view, threads, {});
    EXPECT_TRUE(image.ok());
    return *std::move(image);
}

// With spheres of fewer pixels in diameter as leaves.
Image picture_with(const Scene& scene, const View& view, double finest) {
    Image image{scene->image.width, scene->image.height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    looks::LookScene look = looks::look_scene(scene, view);
    look.finest_pixels = finest;
    for (int y = 0; y < image.height; y += looks::kTileSide)
        for (int x = 0; x < image.width; x += looks::kTileSide)
            looks::draw_tile(look, x, y, image.pixels.data());
    return image;
}

void expect_sane(const Image& image, const std::string& what) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_TRUE(std::isfinite(image.pixels[i])) << what;
        ASSERT_GE(image.pixels[i], 0) << what;
        if (i % 4 == 3) {
            ASSERT_LE(image.pixels[i], 1) << what;
        }
    }
}

TEST(SpheresLook, OneSphereLetsThroughWhatTheSourceSays) {
    SpheresCloud spheres;
    spheres.levels = 0;
    spheres.size = glm::dvec3(20);
    SceneDraft draft = look_of(spheres, 61, 61);
    draft.clouds[0].density = 0.07;
    draft.clouds[0].translate = {100, 200, 300};
    draft.clouds[0].scale = 2;  // a radius of 20
    draft.camera.automatic = false;
    draft.camera.eye = {100, 200, 400};
    draft.camera.target = {100, 200, 300};
    draft.camera.fov = 40;
    const Image image = picture_of(draft);
    const double t = std::tan(20 * std::numbers::pi / 180);
    int met = 0;
    for (int y = 0; y < 61; ++y)
        for (int x = 0; x < 61; ++x) {
            const double u = ((x + 0.5) / 61 * 2 - 1) * t, v = ((y + 0.5) / 61 * 2 - 1) * t;
            const double sine2 = (u * u + v * v) / (1 + u * u + v * v);
            const double d = 100 * std::sqrt(sine2), r = 20;
            double kept = 1;
            if (d < r) {
                const double length = 2 * std::sqrt(r * r - d * d), f = 1 - d / r;
                kept = std::exp(-0.07 * length) * f + 1 - f;
                ++met;
            }
            // Float32 alpha.
            EXPECT_NEAR(image.pixels[4 * static_cast<std::size_t>(y * 61 + x) + 3], 1 - kept, 1e-6);
        }
    EXPECT_GT(met, 200);
}

// However dense, 1 - f comes through: rule (3) is no medium.
TEST(SpheresLook, ADenseSphereLeaksAsTheSourcesDoes) {
    looks::SphereHit hit;
    ASSERT_TRUE(looks::meets({0, 0.25, 5}, 1, {0, 0, 1}, hit));
    EXPECT_NEAR(looks::through(hit, 1, 1e9), 0.25, 1e-12);
    EXPECT_EQ(looks::through(hit, 1, 0), 1);
}

TEST(SpheresLook, RaysMeetSpheresWhereTheyShould) {
    looks::SphereHit hit;
    EXPECT_FALSE(looks::meets({0, 2, 5}, 1, {0, 0, 1}, hit));   // beside
    EXPECT_FALSE(looks::meets({0, 0, -5}, 1, {0, 0, 1}, hit));  // behind
    ASSERT_TRUE(looks::meets({0, 0, 5}, 1, {0, 0, 1}, hit));
    EXPECT_EQ(hit.enter, 4);
    EXPECT_EQ(hit.leave, 6);
    EXPECT_EQ(hit.middle, 0);
    ASSERT_TRUE(looks::meets({0, 0, 0.5}, 1, {0, 0, 1}, hit));  // from within
    EXPECT_EQ(hit.enter, 0);
    EXPECT_EQ(hit.leave, 1.5);
}

// Tiles, their quarters and the tree are only ways to find what a ray meets: against all leaves, one after the other.
TEST(SpheresLook, FindsAllThatARayMeets) {
    for (const SpheresKind kind : {SpheresKind::kCumulus, SpheresKind::kCirrus}) {
        SpheresCloud spheres;
        spheres.levels = 4;
        spheres.kind = kind;
        SceneDraft draft = look_of(spheres, 40, 30);
        draft.clouds[0].density = 0.002;  // thin, so that no ray ends early
        draft.clouds[0].rotate_y = 30;
        draft.camera.automatic = false;
        draft.camera.eye = {90, 40, 330};
        draft.camera.target = {0, 50, 0};
        draft.camera.fov = 70;
        const Scene scene = test::valid(draft);
        const Image image = picture_with(scene, resolve_view(scene->camera, scene->image, {}), 0);
        const looks::LookScene rays =
            looks::look_scene(scene, resolve_view(scene->camera, scene->image, {}));
        const looks::LookCloud cloud = looks::look_clouds(scene, rays.view.eye)[0];
        std::vector<SphereNode> nodes = {cloud.tree.root()};
        for (int level = 0; level < 4; ++level) {
            std::vector<SphereNode> next;
            for (const SphereNode& node : nodes)
                for (const SphereNode& child : cloud.tree.children(node, level))
                    next.push_back(child);
            nodes = std::move(next);
        }
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                double left = 1;
                const glm::dvec3 ray = looks::turned_back(cloud, looks::ray_of(rays, x, y));
                looks::SphereHit hit;
                for (const SphereNode& node : nodes)
                    if (looks::meets(node.sphere.center - cloud.eye, node.sphere.radius, ray, hit))
                        left *= looks::through(hit, node.sphere.radius, 0.002);
                // Float32 alpha, and products of some dozen factors in another order.
                ASSERT_NEAR(image.pixels[4 * static_cast<std::size_t>(y * 40 + x) + 3], 1 - left,
                            1e-6)
                    << x << ' ' << y;
            }
    }
}

// A sphere smaller than a pixel is a leaf: against the same picture with no such leaves.
TEST(SpheresLook, LevelOfDetailChangesLittle) {
    SpheresCloud spheres;
    spheres.levels = 7;
    SceneDraft draft = look_of(spheres, 160, 120);
    const Scene scene = test::valid(draft);
    const View view = resolve_view(scene->camera, scene->image,
                                   {glm::dvec3(-250, -20, -200), glm::dvec3(250, 200, 200)});
    const Image fine = picture_with(scene, view, 0), usual = picture_with(scene, view, 1);
    double square = 0, sum = 0, count = 0;
    for (std::size_t i = 3; i < fine.pixels.size(); i += 4) {
        const double off =
            static_cast<double>(fine.pixels[i]) - static_cast<double>(usual.pixels[i]);
        square += off * off;
        sum += off;
        ++count;
    }
    // A point sample of a pixel with spheres below its size is noise either way; opacities of the whole picture agree.
    EXPECT_LT(std::abs(sum) / count, 0.005);
    EXPECT_LT(std::sqrt(square / count), 0.08);
}

TEST(SpheresLook, ThreadsDoNotShow) {
    SpheresCloud spheres;
    spheres.levels = 6;
    spheres.morph.emplace();
    SceneDraft draft = look_of(spheres, 101, 77);
    draft.time = 3;
    draft.image.background = Background::kSky;
    const Image one = picture_of(draft, 1);
    for (const int threads : {2, 7}) {
        EXPECT_EQ(one.pixels, picture_of(draft, threads).pixels) << threads;
    }
}

TEST(SpheresLook, IsSaneFromWithin) {
    SpheresCloud spheres;
    spheres.levels = 6;
    SceneDraft draft = look_of(spheres);
    draft.camera.automatic = false;
    draft.camera.target = {10, 30, 5};
    for (const glm::dvec3& eye :
         {glm::dvec3(1e-9, 0, 0), glm::dvec3(100, 1, 20), glm::dvec3(0, 5, -200)})
        for (const double fov : {0.01, 40.0, 170.0}) {
            draft.camera.eye = eye;
            draft.camera.fov = fov;
            expect_sane(picture_of(draft), std::to_string(fov));
        }
}

TEST(SpheresLook, AGroundHidesWhatIsBelowIt) {
    SpheresCloud spheres;
    spheres.levels = 3;
    SceneDraft draft = look_of(spheres);
    draft.clouds[0].translate = {0, -5000, 0};
    draft.camera.automatic = false;
    draft.camera.eye = {0, 100, 0};
    draft.camera.target = {0, -5000, 1};
    draft.ground.emplace();
    for (const float value : picture_of(draft).pixels) EXPECT_EQ(value, 0);
    draft.ground.reset();
    float most = 0;
    for (const float value : picture_of(draft).pixels) most = std::max(most, value);
    EXPECT_GT(most, 0.1F);
}

TEST(SpheresLook, ShinesOnTheSidesThatLightComesFrom) {
    looks::LookLight light;
    light.to_sun = {0, 0, 1};
    light.sun = glm::dvec3(2);
    light.above = glm::dvec3(0.5);
    light.below = glm::dvec3(0.25);
    light.albedo = 0.5;
    const auto shade = [&](const glm::dvec3& normal, double sun, double sky) {
        return looks::shade(light, {sun, sky}, normal).x;
    };
    // Level, half of what is around is above: 0.5 (0.25 + 0.125) beside the sun's.
    const double around = 0.5 * (0.5 * 0.5 + 0.5 * 0.25);
    EXPECT_NEAR(shade({0, 0, 1}, 1, 1), 0.5 * 2 + around, 1e-12);
    EXPECT_NEAR(shade({1, 0, 0}, 1, 1), 0.5 * 1 + around, 1e-12);  // half at the limb
    EXPECT_NEAR(shade({0, 0, -1}, 1, 1), around, 1e-12);           // none at the back
    EXPECT_NEAR(shade({0, 0, 1}, 0.25, 1), 0.5 * 0.5 + around, 1e-12);
    light.sun = glm::dvec3(0);
    EXPECT_NEAR(shade({0, 1, 0}, 1, 0.5), 0.5 * 0.5 * 0.5, 1e-12);
    EXPECT_NEAR(shade({0, -1, 0}, 1, 0.5), 0.5 * 0.25, 1e-12);
}

// Depth that light goes on through as if it had not been scattered counts for nothing (similarity).
TEST(SpheresLook, ForwardScatteringSoftensShadows) {
    SceneDraft draft = test::table_4_4();
    const auto softened = [&](double albedo, double g) {
        draft.medium = {albedo, g, PhaseFunction::kHenyeyGreenstein};
        return looks::look_light(test::valid(draft)).softened;
    };
    EXPECT_DOUBLE_EQ(softened(0, 0.9), 1);
    EXPECT_DOUBLE_EQ(softened(1, 0), 1);
    EXPECT_DOUBLE_EQ(softened(1, -0.5), 1);
    EXPECT_NEAR(softened(0.5, 0.8), 0.6, 1e-12);
    EXPECT_LT(softened(0.9, 0.9), softened(0.9, 0.3));
}

TEST(SpheresLook, BumpedNormalsAreUnitAndFaceOutward) {
    test::Dice dice(1);
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 n = dice.on_sphere();
        const glm::dvec3 bumped = looks::bumped(n, mix_bits(static_cast<std::uint64_t>(i)));
        ASSERT_NEAR(glm::length(bumped), 1, 1e-12);
        ASSERT_GT(glm::dot(n, bumped), 0);
    }
}

// Extreme clouds end: large ratios put thousands of spheres on a ray, dense and thin ones, far ones, flat ones.
TEST(SpheresLook, RandomCloudsAreSane) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        test::Dice dice(seed);
        test::Whereabouts where;
        where.size = dice.log_between(1e-3, 1e5);
        if (dice.chance(0.2)) where.middle = dice.any_vector(0.9 * limits::kMaxCoordinate);
        SceneDraft draft = look_of({}, 24, 18);
        draft.clouds[0] = test::random_spheres(dice, where);
        draft.sun.elevation = dice.between(-90, 90);
        draft.camera.automatic = false;
        draft.camera.target = where.middle;
        draft.camera.eye =
            where.middle + where.size * dice.log_between(0.01, 10) * dice.on_sphere();
        if (draft.camera.eye == draft.camera.target) continue;
        draft.camera.up = {0.3, 1, 0.2};
        if (!validate(draft).ok()) continue;
        draft.time = dice.between(0, 30);
        expect_sane(picture_of(draft, 2), std::to_string(seed));
    }
}

TEST(SpheresLook, TheDeepestTreesOfTheLargestSpheresEnd) {
    SpheresCloud spheres;
    spheres.levels = 10;
    for (const double ratio : {0.05, 0.9, 1.0})
        for (const double density : {1e-6, 1e6}) {
            spheres.ratio_min = spheres.ratio_max = ratio;
            SceneDraft draft = look_of(spheres, 32, 24);
            draft.clouds[0].density = density;
            expect_sane(picture_of(draft, 2), std::to_string(ratio));
        }
}

}  // namespace
}  // namespace awan
