// Textures: which there are, what a document says of them, how many billboards it makes, and that they are drawn as
// they should be.
#include "core/scene/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/draw/billboards.h"
#include "core/generate/gaussian.h"
#include "core/generate/generate.h"
#include "core/generate/own_textures.h"
#include "core/scene/fingerprint.h"
#include "tests/scene_checks.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using scene_checks::cube_with;
using scene_checks::expect_invalid;
using scene_checks::scene_with;
using test::Ball;
using test::balls;
using test::pixel;
using test::render;
using test::valid;

// Balls before nothing, painted.
SceneDraft painted(const std::vector<Ball>& list, const char* texture) {
    SceneDraft draft = balls(list);
    draft.image.background = Background::kTransparent;
    draft.texture = texture;
    return draft;
}

std::shared_ptr<const Texture> texture_from(const char* name, std::vector<std::uint8_t> depth) {
    std::string hash = texture_hash(depth);
    return std::make_shared<const Texture>(Texture{name, std::move(hash), std::move(depth)});
}

// Matter in the upper left quarter alone.
std::shared_ptr<const Texture> corner_texture() {
    std::vector<std::uint8_t> depth(kTextureSide * kTextureSide);
    for (int y = 0; y < kTextureSide / 2; ++y)
        std::fill_n(depth.begin() + y * kTextureSide, kTextureSide / 2, std::uint8_t{255});
    return texture_from("corner", std::move(depth));
}

double largest_difference(const Image& a, const Image& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, static_cast<double>(std::abs(a.pixels[i] - b.pixels[i])));
    return most;
}

TEST(OwnTextures, AreWhatTheirHashesSay) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < kOwnTextures.size(); ++i) {
        const std::vector<std::uint8_t> depth = own_texture_depth(i);
        ASSERT_EQ(depth.size(), std::size_t{kTextureSide * kTextureSide});
        EXPECT_EQ(texture_hash(depth), kOwnTextures[i].hash) << kOwnTextures[i].name;
        EXPECT_EQ(*std::max_element(depth.begin(), depth.end()), 255);
        EXPECT_TRUE(names.insert(kOwnTextures[i].name).second);
        // They are round: nothing is cut off at the square's edge.
        for (int k = 0; k < kTextureSide; ++k)
            for (const int at : {k, kTextureSide * (kTextureSide - 1) + k, kTextureSide * k,
                                 kTextureSide * k + kTextureSide - 1})
                EXPECT_LE(depth[static_cast<std::size_t>(at)], 1) << kOwnTextures[i].name;
    }
}

TEST(Textures, NamesAreNoPaths) {
    for (const char* const good : {"a", "puff-2", "My_cloud.png", "0"})
        EXPECT_FALSE(check_texture_name(good)) << good;
    for (const char* const bad : {"", "../puff", "a/b", ".hidden", "-x", "a b", "none", "soft",
                                  "\n", "0123456789abcdef0123456789abcdef"})
        EXPECT_TRUE(check_texture_name(bad)) << bad;
    EXPECT_TRUE(check_texture_name(std::string(65, 'a')));
}

TEST(Textures, ADocumentNamesWhatThereIs) {
    expect_invalid(cube_with(R"("texture": "smoke")"), "/cubes/0/texture", {"soft", "wisp"});
    expect_invalid(scene_with(R"("texture": "../../etc/passwd")"), "/texture");
    expect_invalid(R"({"clouds": [{"model": "spheres", "spheres": {}, "texture": "smoke"}]})",
                   "/clouds/0/texture");
    for (const OwnTexture& own : kOwnTextures)
        for (const char* const name : {own.name, own.hash})
            EXPECT_TRUE(
                scene_checks::read(cube_with(R"("texture": ")" + std::string(name) + '"')).ok());
}

TEST(Textures, ByNameOrByHashTheSceneIsTheSame) {
    SceneDraft draft = painted({{{0, 0, 0}, 1, 1}}, "puff");
    const std::string named = fingerprint(valid(draft));
    draft.texture = kOwnTextures[1].hash;
    EXPECT_EQ(fingerprint(valid(draft)), named);
    draft.texture = "soft";
    EXPECT_NE(fingerprint(valid(draft)), named);
    EXPECT_EQ(light_fingerprint(valid(draft)),
              light_fingerprint(valid(painted({{{0, 0, 0}, 1, 1}}, "puff"))));
    // A name that stands for another picture is another scene.
    draft.textures = {corner_texture()};
    draft.texture = "corner";
    const std::string corner = fingerprint(valid(draft));
    draft.textures = {
        texture_from("corner", std::vector<std::uint8_t>(kTextureSide * kTextureSide, 9))};
    EXPECT_NE(fingerprint(valid(draft)), corner);
}

TEST(Textures, ACubeHasItsOwnOrTheCloudsOrTheScenes) {
    SceneDraft draft = test::table_4_4();
    draft.texture = "soft";
    draft.billboards = 7;
    draft.clouds[0].cubes[1].texture = "wisp";
    draft.clouds[0].cubes[1].billboards = 9;
    draft.clouds[0].cubes[2].texture = std::string(kNoTexture);
    draft.clouds[0].cubes[3].particles = 0;
    const Scene scene = valid(draft);
    const auto set = generate(scene, 1, {});
    ASSERT_TRUE(set.ok());
    // 7 and 9 billboards, 110 particles that are not painted, 7 billboards.
    ASSERT_EQ(set->size(), 7U + 9 + 110 + 7);
    ASSERT_EQ(set->paint.size(), set->size());
    EXPECT_EQ(particle_count(*scene), set->size());
    const auto textures = textures_of(*scene);
    ASSERT_EQ(textures.size(), 2U);
    EXPECT_EQ(textures[0], kOwnTextures[0].hash);
    EXPECT_EQ(textures[1], kOwnTextures[4].hash);
    for (std::size_t i = 0; i < set->size(); ++i)
        EXPECT_EQ(set->paint[i].texture, i < 7 ? 1 : i < 16 ? 2 : i < 126 ? 0 : 1) << i;
    // Those that have an up are turned a little.
    for (std::size_t i = 7; i < 16; ++i) {
        const int turn = static_cast<std::int16_t>(set->paint[i].turn);
        EXPECT_LE(std::abs(turn), 65536 / 16) << i;
    }
    EXPECT_EQ(set->cloud_begin, (std::vector<std::size_t>{0, set->size()}));
}

TEST(Textures, EditingOneCubeLeavesTheOthersAsTheyWerePainted) {
    SceneDraft draft = test::table_4_4();
    draft.texture = "torn";
    const auto before = generate(valid(draft), 1, {});
    draft.clouds[0].cubes[0].particles = 20;
    const auto after = generate(valid(draft), 4, {});
    ASSERT_TRUE(before.ok() && after.ok());
    for (std::size_t i = 20; i < after->size(); ++i) {
        EXPECT_EQ(after->paint[i].turn, before->paint[i + 180].turn);
        EXPECT_EQ(after->paint[i].mirrored, before->paint[i + 180].mirrored);
    }
}

// --- the plan

TEST(TexturePlan, RunsWhereACubeAsksAndSaysWhy) {
    SceneDraft draft = test::table_4_4();
    draft.accuracy = {};
    const auto decided = [&] {
        const auto planned = plan_only(valid(draft), 1, {});
        EXPECT_TRUE(planned.ok());
        return planned->plan;
    };
    EXPECT_FALSE(decided().on(Effect::kTexture));
    EXPECT_EQ(decided().of(Effect::kTexture).reason, "nothing in the scene has a texture");
    test::effect(draft, Effect::kTexture) = Switch::kOn;
    EXPECT_FALSE(decided().on(Effect::kTexture));
    EXPECT_NE(decided().rung, "harris");

    test::effect(draft, Effect::kTexture) = Switch::kAuto;
    draft.clouds[0].cubes[2].texture = "puff";
    const Plan with = decided();
    EXPECT_TRUE(with.on(Effect::kTexture));
    EXPECT_EQ(with.rung, "harris");
    EXPECT_TRUE(std::isnan(with.predicted.error));
    // Whatever is asked of the error: it cannot be measured.
    draft.accuracy.error = 0.01;
    EXPECT_EQ(decided().rung, "harris");
    draft.accuracy = {{}, 1e5, {}};
    EXPECT_EQ(decided().rung, "harris");
    // Others go without, and say so.
    draft.accuracy = {{}, {}, "transport-16"};
    const Plan without = decided();
    EXPECT_EQ(without.rung, "transport-16");
    EXPECT_FALSE(without.on(Effect::kTexture));
    EXPECT_NE(without.of(Effect::kTexture).reason.find("goes without"), std::string::npos);
    EXPECT_GT(without.predicted.error, 0);
    draft.accuracy = {};
    test::effect(draft, Effect::kTexture) = Switch::kOff;
    EXPECT_FALSE(decided().on(Effect::kTexture));
    EXPECT_NE(decided().rung, "harris");
}

TEST(TexturePlan, NoErrorIsStatedOfAPaintedPicture) {
    const Rendered rendered = render(painted({{{0, 0, 0}, 2, 1}}, "puff"));
    EXPECT_TRUE(std::isnan(rendered.stated_error));
    EXPECT_EQ(rendered.rung->id, RungId::kHarris);
    EXPECT_GT(rendered.times.effects.of(Effect::kTexture), 0);
}

// --- the textures of 64 depths

TEST(Billboards, AreOfTheNearestDepth) {
    const DepthLevels levels{8};
    EXPECT_EQ(levels.level_of(8), kDepthLevels - 1);
    EXPECT_NEAR(levels.depth_of(kDepthLevels - 1), 8, 1e-12);
    EXPECT_NEAR(levels.depth_of(0), 8 / kDepthRange, 1e-12);
    EXPECT_EQ(levels.level_of(0), 0);
    for (double depth = 8; depth > 8 / kDepthRange; depth *= 0.97) {
        const double taken = levels.depth_of(levels.level_of(depth));
        EXPECT_NEAR(taken / depth, 1, 0.057) << depth;
    }
}

TEST(Billboards, KeepAParticlesMassAndAreOpaqueByBeersLaw) {
    const Texture soft{"", "", own_texture_depth(0)};
    for (const double depth : {0.01, 1.0, 3.0}) {
        const std::vector<float> opacity = opacity_of(soft, depth);
        double mass = 0;
        for (const float one : opacity) mass += -std::log1p(-static_cast<double>(one));
        mass *= std::pow(2 * kBillboardReach / kTextureSide, 2);
        // Of opacities next to 1 a float keeps no more.
        EXPECT_NEAR(mass, 2 * std::numbers::pi * depth, 2e-3 * 2 * std::numbers::pi * depth);
    }
}

TEST(Billboards, FaceTheEyeWithTheirUpUp) {
    const glm::dvec3 vertical(0, 1, 0);
    for (const glm::dvec3 q : {glm::dvec3(0, 0, 5), {3, -2, 4}, {0, 9, 0}, {-1, 0, -2}}) {
        const BillboardAxes axes = billboard_axes(q, 2, {1, false, 0}, vertical);
        EXPECT_NEAR(glm::dot(axes.across, q), 0, 1e-12);
        EXPECT_NEAR(glm::dot(axes.up, q), 0, 1e-12);
        EXPECT_NEAR(glm::dot(axes.up, axes.across), 0, 1e-12);
        EXPECT_NEAR(glm::length(axes.up), 2, 1e-12);
        EXPECT_TRUE(axes.up.y > 0 || (q.x == 0 && q.z == 0));
    }
    const BillboardAxes ahead = billboard_axes({0, 0, 5}, 1, {1, false, 0}, vertical);
    EXPECT_NEAR(ahead.across.x, 1, 1e-12);
    const BillboardAxes turned = billboard_axes({0, 0, 5}, 1, {1, true, 16384}, vertical);
    EXPECT_NEAR(turned.across.y, -1, 1e-12);
    EXPECT_NEAR(turned.up.x, -1, 1e-12);
}

// --- pictures

// The sum of -log(1 - alpha) over a picture, in scene units at the distance of the origin.
double mass_in(const Rendered& rendered) {
    const double side = 2 * rendered.survey.view.tan_half_fov * 20 / rendered.image.height;
    double sum = 0;
    for (std::size_t i = 3; i < rendered.image.pixels.size(); i += 4)
        sum += -std::log1p(-static_cast<double>(rendered.image.pixels[i]));
    return sum * side * side;
}

TEST(TexturePicture, EveryTextureShowsTheParticlesMass) {
    for (const OwnTexture& own : kOwnTextures) {
        const Rendered rendered = render(painted({{{0, 0, 0}, 3, 0.02}}, own.name));
        const double mass =
            gaussian_mass(*generate(valid(balls({{{0, 0, 0}, 3, 0.02}})), 1, {}), 0);
        EXPECT_NEAR(mass_in(rendered) / mass, 1, 0.02) << own.name;
    }
}

TEST(TexturePicture, SoftIsTheGaussianItIsMadeAfter) {
    const std::vector<Ball> list = {
        {{0, 0, 0}, 3, 0.5}, {{1, 1, -2}, 2, 0.5}, {{-2, 0, 3}, 1.5, 0.7}};
    const Rendered soft = render(painted(list, "soft"));
    SceneDraft plain = painted(list, "soft");
    test::effect(plain, Effect::kTexture) = Switch::kOff;
    const Rendered gaussian = render(plain);
    EXPECT_GT(*std::max_element(gaussian.image.pixels.begin(), gaussian.image.pixels.end()), 0.5f);
    EXPECT_LT(largest_difference(soft.image, gaussian.image), 0.04);
    EXPECT_GT(largest_difference(render(painted(list, "hard")).image, gaussian.image), 0.2);
}

TEST(TexturePicture, ATextureStandsAsItsPictureDoes) {
    SceneDraft draft = painted({{{0, 0, 0}, 3, 50}}, "corner");
    draft.textures = {corner_texture()};
    const Scene scene = valid(draft);
    const auto set = generate(scene, 1, {});
    ASSERT_TRUE(set.ok());
    const Paint paint = set->paint[0];
    const Rendered rendered = render(draft);
    // Where its quarter lies in the picture: up and left, turned.
    const double angle = paint.turn * 2 * std::numbers::pi / 65536;
    const double left = paint.mirrored ? 1 : -1;
    const glm::dvec2 at(left * std::cos(angle) - std::sin(angle),
                        left * std::sin(angle) + std::cos(angle));
    const double per_unit = rendered.image.height / (2 * rendered.survey.view.tan_half_fov * 20);
    const auto alpha = [&](glm::dvec2 place) {
        return pixel(rendered.image, static_cast<int>(32 + place.x * per_unit),
                     static_cast<int>(24 - place.y * per_unit))
            .a;
    };
    // Half the side is 4.5.
    EXPECT_GT(alpha(2.2 * at), 0.99);
    EXPECT_LT(alpha(-2.2 * at), 0.01);
    EXPECT_LT(alpha(2.2 * glm::dvec2(at.y, -at.x)), 0.01);
}

// What a billboard scatters is multiplied by its texture's colour, as linear light, and what is behind it is hidden as
// much as by a white one; the haze before it has its own colour.
TEST(TexturePicture, ColoursTintTheLight) {
    Texture tinted{"tinted", "", own_texture_depth(0)};
    tinted.color.resize(3 * tinted.depth.size());
    for (std::size_t i = 0; i < tinted.depth.size(); ++i) {
        const std::uint8_t code[3] = {255, 188, 0};
        std::copy_n(code, 3, &tinted.color[3 * i]);
    }
    tinted.hash = texture_hash(tinted.depth, tinted.color);
    EXPECT_NE(tinted.hash, texture_hash(tinted.depth));
    SceneDraft draft = painted({{{0, 0, 0}, 1, 1}, {{0.4, 0.3, 0.5}, 0.8, 3}}, "soft");
    const Rendered white = render(draft);
    draft.textures = {std::make_shared<const Texture>(tinted)};
    draft.texture = "tinted";
    const Rendered colored = render(draft);
    const double share[4] = {1, std::pow((188 / 255.0 + .055) / 1.055, 2.4), 0, 1};
    double most = 0;
    for (std::size_t i = 0; i < white.image.pixels.size(); ++i) {
        const auto here = static_cast<double>(white.image.pixels[i]);
        most = std::max(most, here);
        EXPECT_NEAR(static_cast<double>(colored.image.pixels[i]), share[i % 4] * here,
                    1e-3 * (1e-3 + here));
    }
    EXPECT_GT(most, 0.1);
    draft.haze = Haze{};
    draft.haze->extinction = 0.02;
    draft.haze->scale_height = 1000;
    const Rendered hazy = render(draft);
    const auto middle = static_cast<std::size_t>(
        4 * (hazy.image.height / 2 * hazy.image.width + hazy.image.width / 2));
    EXPECT_GT(hazy.image.pixels[middle + 2], 0.005F);
    EXPECT_LT(hazy.image.pixels[middle + 2], hazy.image.pixels[middle]);
}

TEST(TexturePicture, TheNearerHidesTheFarther) {
    SceneDraft draft =
        painted({{{0, 0, -2}, 3, 50, {1, 0, 0}}, {{0, 0, 2}, 3, 50, {0, 1, 0}}}, "soft");
    const auto middle = pixel(render(draft).image, 32, 24);
    EXPECT_GT(middle.g, 100 * middle.r);
    std::swap(draft.clouds[0].ready.positions[0], draft.clouds[0].ready.positions[1]);
    const auto swapped = pixel(render(draft).image, 32, 24);
    EXPECT_GT(swapped.r, 100 * swapped.g);
}

// Far below a pixel a billboard covers what it covers.
TEST(TexturePicture, FarAwayItsMassStays) {
    const auto alpha_of = [](double eye) {
        SceneDraft draft = painted({{{0, 0, 0}, 1, 0.05}}, "puff");
        draft.camera.eye = {0, 0, eye};
        double sum = 0;
        const Image image = render(draft).image;
        for (std::size_t i = 3; i < image.pixels.size(); i += 4)
            sum += static_cast<double>(image.pixels[i]);
        return sum * eye * eye;
    };
    const double near = alpha_of(10);
    EXPECT_GT(near, 0);
    for (const double eye : {40.0, 300.0}) EXPECT_NEAR(alpha_of(eye) / near, 1, 0.1) << eye;
}

TEST(TexturePicture, AnEyeWithinBillboardsSeesAFinitePicture) {
    SceneDraft draft = painted({}, "hard");
    for (int i = 0; i < 40; ++i)
        draft.clouds[0].ready.positions.push_back({0.3 * (i % 7), 0.2 * (i % 5), 20 - 0.5 * i});
    draft.clouds[0].ready.radii.assign(40, 1.5f);
    draft.clouds[0].ready.densities.assign(40, 2.0f);
    draft.clouds[0].ready.colors.clear();
    const Image image = render(draft).image;
    for (const float one : image.pixels) ASSERT_TRUE(std::isfinite(one) && one >= 0);
    // And one that the eye stands in is not seen at all.
    SceneDraft within = painted({{{0, 0, 20}, 2, 5}}, "hard");
    const Image nothing = render(within).image;
    EXPECT_EQ(*std::max_element(nothing.pixels.begin(), nothing.pixels.end()), 0.0f);
}

TEST(TexturePicture, PaintedAndPlainParticlesStandInOnePicture) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 120;
    draft.image.height = 90;
    draft.clouds[0].cubes[1].texture = "torn";
    const Rendered both = render(draft);
    EXPECT_TRUE(both.plan.on(Effect::kTexture));
    draft.texture = "torn";
    EXPECT_GT(largest_difference(both.image, render(draft).image), 0.05);
    draft.texture.reset();
    draft.clouds[0].cubes[1].texture.reset();
    EXPECT_GT(largest_difference(both.image, render(draft).image), 0.05);
}

}  // namespace
}  // namespace awan
