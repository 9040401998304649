// The relief of a user's on spheres: f(u, v, n) of Ostroushko et al. (4), as waves and as a texture.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/keyed_random.h"
#include "core/looks/looks.h"
#include "core/looks/ostroushko_relief.h"
#include "core/looks/ostroushko_tile.h"
#include "tests/random_scenes.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using looks::height_at;
using looks::Relief;
using looks::relief_of;
using looks::turned_normal;

constexpr std::uint64_t kKey = 12345;

Relief waves(double height, std::vector<SpheresWave> all) {
    Relief relief;
    relief.bump.height = height;
    relief.bump.waves = std::move(all);
    return relief;
}

// u and v of a place on the sphere with that key, as the header has them.
double u_of(const glm::dvec3& n) {
    return std::atan2(n.z, n.x) / (2 * std::numbers::pi) +
           unit_open(static_cast<std::uint32_t>(keyed(kKey, 0) >> 32));
}
double v_of(const glm::dvec3& n) {
    return std::acos(n.y) / std::numbers::pi;
}

// Blinn 1978 on the unit sphere: n' is along n - grad h, the slope by differences of the height.
glm::dvec3 by_differences(const Relief& relief, const glm::dvec3& n, double step) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(-n.z, 0, n.x));
    const glm::dvec3 down = glm::cross(along, n);
    const auto height = [&](const glm::dvec3& way, double by) {
        const glm::dvec3 there = glm::normalize(n + by * way);
        return height_at(relief, u_of(there), v_of(there));
    };
    glm::dvec3 gradient(0);
    for (const glm::dvec3& way : {along, down})
        gradient += (height(way, step) - height(way, -step)) / (2 * step) * way;
    return glm::normalize(n - gradient);
}

TEST(SpheresRelief, AWaveTurnsNormalsByItsSlope) {
    const Relief relief = waves(0.1, {{1, 3, 0, 0.2}, {-0.5, 0, 2.5, 0.1}, {0.3, 2, -1, 0}});
    test::Dice dice(1);
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 n = dice.on_sphere();
        // Near the poles u goes no faster; across u's seam differences jump by a whole turn.
        if (std::abs(n.y) > 0.99 || (n.x < 0 && std::abs(n.z) < 0.01)) continue;
        const glm::dvec3 turned = turned_normal(relief, n, kKey);
        EXPECT_LT(glm::length(turned - by_differences(relief, n, 1e-5)), 1e-6);
        EXPECT_NEAR(glm::length(turned), 1, 1e-12);
        ++compared;
    }
    EXPECT_GT(compared, 900);
}

TEST(SpheresRelief, OneWaveHasTheHeightOfItsFormula) {
    const Relief relief = waves(0.2, {{0.5, 4, 1.5, 0.125}});
    for (const double u : {0.0, 0.3, 0.9})
        for (const double v : {0.0, 0.4, 1.0})
            EXPECT_NEAR(height_at(relief, u, v),
                        0.2 * 0.5 * std::sin(2 * std::numbers::pi * (4 * u + 1.5 * v + 0.125)),
                        1e-12);
}

TEST(SpheresRelief, AFlatReliefLeavesNormals) {
    test::Dice dice(2);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 n = dice.on_sphere();
        EXPECT_LT(glm::length(turned_normal(waves(0, {{1, 5, 2, 0}}), n, kKey) - n), 1e-12);
        EXPECT_LT(glm::length(looks::bumped(n, kKey, 0) - n), 1e-12);
    }
}

// A texture that is a ramp along its rows, uploaded by a user: its slope along u is what it says, and none along v.
TEST(SpheresRelief, ATextureIsARelief) {
    auto ramp = std::make_shared<Texture>();
    ramp->name = "ramp";
    ramp->depth.resize(static_cast<std::size_t>(kTextureSide) * kTextureSide);
    for (int y = 0; y < kTextureSide; ++y)
        for (int x = 0; x < kTextureSide; ++x)
            ramp->depth[static_cast<std::size_t>(y * kTextureSide + x)] =
                static_cast<std::uint8_t>(x);
    ramp->hash = texture_hash(ramp->depth);
    SceneDraft draft;
    draft.textures.push_back(ramp);
    SpheresCloud cloud;
    SpheresBump& bump = cloud.bump.emplace();
    bump.texture = "ramp";
    bump.height = 0.4;
    bump.repeat = 1;
    const Relief relief = relief_of(draft, cloud);
    ASSERT_TRUE(relief.given());
    EXPECT_NEAR(height_at(relief, (64 + 0.5) / 128, 0.3), 0.4 * 64 / 255, 1e-12);
    // In the middle of the ramp, on the equator: 128 steps of 1/255 over u = 1, which is 2 pi long.
    const double u = 0.5;
    const double angle =
        2 * std::numbers::pi * (u - unit_open(static_cast<std::uint32_t>(keyed(kKey, 0) >> 32)));
    const glm::dvec3 n(std::cos(angle), 0, std::sin(angle));
    const double slope = 0.4 * 128 / 255 / (2 * std::numbers::pi);
    const glm::dvec3 along(-n.z, 0, n.x);
    EXPECT_LT(glm::length(turned_normal(relief, n, kKey) - glm::normalize(n - slope * along)),
              1e-9);
}

// Relief is a matter of the look: what it draws changes, what it hides does not.
TEST(SpheresRelief, ChangesShadingAndNothingElse) {
    const auto picture = [](std::optional<SpheresBump> bump) {
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.look = Look::kOstroushko;
        Cloud& cloud = draft.clouds.emplace_back();
        cloud.model = CloudModel::kSpheres;
        SpheresCloud spheres;
        spheres.levels = 2;
        spheres.bump = std::move(bump);
        cloud.spheres = std::make_shared<SpheresCloud>(spheres);
        cloud.rotate_y = 20;
        draft.image.width = 64;
        draft.image.height = 48;
        draft.image.background = Background::kTransparent;
        const Scene scene = test::valid(draft);
        const View view = resolve_view(scene->camera, scene->image,
                                       {glm::dvec3(-250, -20, -200), glm::dvec3(250, 200, 200)});
        auto image = ostroushko_look(scene, view, 1, {});
        EXPECT_TRUE(image.ok());
        return *std::move(image);
    };
    const Image usual = picture(std::nullopt);
    // What is said to be as usual is.
    EXPECT_EQ(picture(SpheresBump{}).pixels, usual.pixels);
    SpheresBump bump;
    bump.height = 0.3;
    bump.texture = "puff";
    SpheresBump wavy;
    wavy.waves.push_back({1, 6, 3, 0});
    for (const SpheresBump& one : {bump, wavy}) {
        const Image image = picture(one);
        EXPECT_NE(image.pixels, usual.pixels);
        for (std::size_t i = 3; i < image.pixels.size(); i += 4)
            ASSERT_EQ(image.pixels[i], usual.pixels[i]);
    }
}

}  // namespace
}  // namespace awan
