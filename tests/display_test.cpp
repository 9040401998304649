// Display modes: what is drawn of a scene that is displayed instead of lit, and where.
#include "core/draw/display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/draw/display_shapes.h"
#include "core/formats/image_file.h"
#include "core/generate/generate.h"
#include "core/scene/automaton.h"
#include "core/scene/fingerprint.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::pixel;
using test::Pixel;
using test::render;
using test::valid;

// A cube of side 2 about the origin, seen from (0, 0, 10) before nothing: its near face is 48 pixels wide.
SceneDraft cube(Display display) {
    SceneDraft draft = test::plain_draft();
    draft.clouds.push_back({});
    draft.clouds[0].cubes = {{40, {2, 2, 2}, {0, 0, 0}, 1.2, 1, {}}};
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 10};
    draft.camera.target = {0, 0, 0};
    draft.camera.fov = 2 * std::atan(1.0 / 6) * 180 / 3.14159265358979323846;
    draft.image.width = draft.image.height = 72;
    draft.image.background = Background::kTransparent;
    draft.display = display;
    return draft;
}

double alpha(const Image& image, int x, int y) {
    return pixel(image, x, y).a;
}

TEST(Display, HasNeitherEffectsNorRungNorError) {
    SceneDraft draft = cube(Display::kCubes);
    draft.accuracy.error = 0.01;
    const Rendered rendered = render(draft);
    EXPECT_EQ(rendered.rung->id, RungId::kDisplay);
    EXPECT_EQ(rendered.plan.rung, "display");
    EXPECT_TRUE(std::isnan(rendered.stated_error));
    for (const EffectDecision& effect : rendered.plan.effects) EXPECT_FALSE(effect.on);
    EXPECT_EQ(exposure_of(valid(draft)), 0);
}

TEST(Display, ACubeCoversWhereItIs) {
    const Image image = render(cube(Display::kCubes)).image;
    // The near face, at z = 1: half its width is 1/9 of the distance, the picture's 1/6.
    for (const int at : {13, 36, 58}) {
        EXPECT_EQ(alpha(image, at, 36), 1) << at;
        EXPECT_EQ(alpha(image, 36, at), 1) << at;
    }
    for (const int at : {2, 9, 62, 69}) {
        EXPECT_EQ(alpha(image, at, 36), 0) << at;
        EXPECT_EQ(alpha(image, 36, at), 0) << at;
    }
}

TEST(Display, BoundingBoxesAreEdgesAlone) {
    const Image image = render(cube(Display::kBoundingBoxes)).image;
    // The far face's edges are 1/11 of the distance away, the near one's 1/9.
    const auto darkest_near = [&](double slope) {
        const int x = static_cast<int>(36 + 36 * 6 * slope);
        return std::max({alpha(image, x - 1, 36), alpha(image, x, 36), alpha(image, x + 1, 36)});
    };
    EXPECT_GT(darkest_near(1.0 / 9), 0.4);
    EXPECT_GT(darkest_near(1.0 / 11), 0.4);
    EXPECT_EQ(alpha(image, 36, 36), 0);
    EXPECT_EQ(alpha(image, 45, 40), 0);
}

TEST(Display, QuadsShowTheTextureOnTheFaces) {
    SceneDraft draft = cube(Display::kQuads);
    const Image bare = render(draft).image;
    EXPECT_GT(alpha(bare, 36, 36), 0.2);
    EXPECT_LT(alpha(bare, 36, 36), 0.9);
    draft.texture = "soft";
    const Image soft = render(draft).image;
    // Dense in a face's middle, little near its rim.
    EXPECT_GT(alpha(soft, 36, 36), 0.95);
    EXPECT_LT(alpha(soft, 22, 14), 0.25);
}

TEST(Display, BillboardsAreThereWithAndWithoutATexture) {
    SceneDraft draft = cube(Display::kBillboards);
    const Image soft = render(draft).image;
    EXPECT_GT(alpha(soft, 36, 36), 0.9);
    draft.texture = "hard";
    const Image hard = render(draft).image;
    EXPECT_GT(alpha(hard, 36, 36), 0.9);
    EXPECT_NE(hard.pixels, soft.pixels);
    // Without particles there are none, but edges.
    draft.clouds[0].cubes[0].particles = 0;
    EXPECT_EQ(alpha(render(draft).image, 36, 36), 0);
    draft.billboards = 30;
    EXPECT_GT(alpha(render(draft).image, 36, 36), 0.5);
}

TEST(Display, ShowTextureIsTheTextureOnceAndUpright) {
    SceneDraft draft = cube(Display::kShowTexture);
    const Image none = render(draft).image;
    EXPECT_EQ(*std::max_element(none.pixels.begin(), none.pixels.end()), 0.0f);
    std::vector<std::uint8_t> depth(kTextureSide * kTextureSide);
    for (int y = 0; y < kTextureSide / 2; ++y)
        std::fill_n(depth.begin() + y * kTextureSide, kTextureSide / 2, std::uint8_t{255});
    std::string hash = texture_hash(depth);
    draft.textures = {
        std::make_shared<const Texture>(Texture{"corner", std::move(hash), std::move(depth)})};
    draft.texture = "corner";
    const Image image = render(draft).image;
    EXPECT_EQ(alpha(image, 26, 26), 1);
    EXPECT_EQ(alpha(image, 46, 26), 0);
    EXPECT_EQ(alpha(image, 26, 46), 0);
    EXPECT_EQ(alpha(image, 46, 46), 0);
}

TEST(Display, NearCubesHideFarOnes) {
    SceneDraft draft = cube(Display::kCubes);
    draft.clouds[0].cubes.push_back({0, {1, 1, 1}, {0, 0, -6}, 0.4, 1, {}});
    EXPECT_EQ(render(draft).image.pixels, render(cube(Display::kCubes)).image.pixels);
}

TEST(Display, OtherModelsAreOneBoxACloud) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 1}, {{3, 0, 0}, 1}});
    draft.display = Display::kBoundingBoxes;
    draft.clouds.push_back(draft.clouds[0]);
    draft.clouds[1].translate = {0, 5, 0};
    const Scene scene = valid(draft);
    const auto set = generate(scene, 1, {});
    ASSERT_TRUE(set.ok());
    const std::vector<DisplayBox> boxes = display_boxes(scene, *set);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0].corner[0], glm::dvec3(-1, -1, -1));
    EXPECT_EQ(boxes[0].corner[7], glm::dvec3(4, 1, 1));
    EXPECT_EQ(boxes[1].corner[7], glm::dvec3(4, 6, 1));
}

TEST(Display, CubesTurnAndGrowWithTheirCloud) {
    SceneDraft draft = cube(Display::kCubes);
    draft.top_level_cubes = false;
    draft.clouds[0].scale = 2;
    draft.clouds[0].rotate_y = 90;
    draft.clouds[0].cubes[0].size = {2, 4, 6};
    draft.clouds[0].translate = {1, 0, 0};
    const Scene scene = valid(draft);
    const std::vector<DisplayBox> boxes = display_boxes(scene, *generate(scene, 1, {}));
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_NEAR(std::abs(boxes[0].corner[0].x - boxes[0].corner[7].x), 12, 1e-9);
    EXPECT_NEAR(std::abs(boxes[0].corner[0].y - boxes[0].corner[7].y), 8, 1e-9);
    EXPECT_NEAR(std::abs(boxes[0].corner[0].z - boxes[0].corner[7].z), 4, 1e-9);
    EXPECT_NEAR(boxes[0].middle().x, 1, 1e-9);
}

// The picture is drawn in bands of a million pixels.
TEST(Display, BandsMeet) {
    SceneDraft draft = cube(Display::kCubes);
    draft.image.width = draft.image.height = 1500;
    const Image image = render(draft).image;
    const int first = 1500 * 12 / 72 + 4;
    for (int y = first; y < 1500 - first; ++y) ASSERT_EQ(alpha(image, 750, y), 1) << y;
    for (int x = first; x < 1500 - first; ++x) ASSERT_EQ(alpha(image, x, 699), 1) << x;
    EXPECT_EQ(alpha(image, 750, 230), 0);
    EXPECT_EQ(alpha(image, 750, 1270), 0);
}

TEST(Display, ALitPictureAfterADisplayedOneIsTheSame) {
    SceneDraft lit = test::table_4_4();
    lit.image.width = 80;
    lit.image.height = 60;
    const Image before = render(lit).image;
    for (const Display display : {Display::kCubes, Display::kQuads, Display::kBillboards}) {
        SceneDraft shown = lit;
        shown.display = display;
        EXPECT_TRUE(render(shown).image.opaque);
    }
    EXPECT_EQ(render(lit).image.pixels, before.pixels);
}

TEST(Display, AnEyeWithinTheCubeIsNoTrouble) {
    for (const Display display : {Display::kCubes, Display::kQuads, Display::kBillboards,
                                  Display::kBoundingBoxes, Display::kShowTexture}) {
        SceneDraft draft = cube(display);
        draft.texture = "puff";
        draft.camera.eye = {0.2, 0.1, 0.3};
        for (const float one : render(draft).image.pixels) ASSERT_TRUE(std::isfinite(one));
    }
}

// A grid of 10 cells a side, 2 units in all, with ellipsoids of 1 unit across at -.5 and .5 of x.
SceneDraft two_ellipsoids(std::optional<std::uint64_t> chosen) {
    SceneDraft draft = cube(Display::kEllipsoids);
    AutomatonCloud automaton;
    automaton.cells = {10, 10, 10};
    automaton.cell = 0.2;
    automaton.ellipsoids = {{{2.5, 5, 5}, {2.5, 2.5, 2.5}}, {{7.5, 5, 5}, {2.5, 2.5, 2.5}}};
    automaton.wind.ellipsoids = {{-100, 100, {1, 0, 0, 180.0, 0}}};
    automaton.warm_up = 0;
    automaton.chosen = chosen;
    draft.clouds[0] = {};
    draft.clouds[0].model = CloudModel::kAutomaton;
    draft.clouds[0].translate = {0, -1, 0};
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(automaton);
    draft.top_level_cubes = false;
    draft.image.width = draft.image.height = 288;
    return draft;
}

TEST(Display, EllipsoidsStandWhereTheyAreWithinTheirGrid) {
    const Image image = render(two_ellipsoids({})).image;
    // At the middle's distance, 10, the picture is 10/3 units wide. An edge of one pixel may lie in two, half in each.
    const auto any = [&](double x, double y, double red) {
        const double scale = 144 / (10.0 / 6);
        bool found = false;
        for (int a = -2; a <= 2; ++a)
            for (int b = -2; b <= 2; ++b) {
                const auto p = pixel(image, static_cast<int>(144 + scale * x) + a,
                                     static_cast<int>(144 - scale * y) + b);
                found = found || (p.a > 0.4 && (red < 0 || p.r > red));
            }
        return found;
    };
    // The outer ends of both along x, their tops; the near and the far edges of the grid; between, nothing.
    for (const double side : {-1.0, 1.0}) {
        EXPECT_TRUE(any(side, 0, 0.3)) << side;
        EXPECT_TRUE(any(side * 0.5, 0.5, 0.3)) << side;
        EXPECT_TRUE(any(side * 10.0 / 9, 0.7, -1)) << side;
        EXPECT_TRUE(any(side * 10.0 / 11, 0.8, -1)) << side;
        EXPECT_FALSE(any(side * 0.5, 0.75, -1)) << side;
    }
}

TEST(Display, TheChosenEllipsoidAloneIsRed) {
    const auto reds = [](const Image& image, int first, int last) {
        int count = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = first; x < last; ++x) {
                const auto p = pixel(image, x, y);
                count += p.a > 0.5 && p.r > 3 * p.g && p.r > 0.2;
            }
        return count;
    };
    EXPECT_EQ(reds(render(two_ellipsoids({})).image, 0, 288), 0);
    const Image right = render(two_ellipsoids(1)).image;
    EXPECT_GT(reds(right, 146, 288), 300);
    EXPECT_EQ(reds(right, 0, 142), 0);
    const Image left = render(two_ellipsoids(0)).image;
    EXPECT_EQ(reds(left, 146, 288), 0);
    // The wind, of a cell a step towards -z, takes it away from the eye.
    SceneDraft later = two_ellipsoids(0);
    later.time = 5;
    EXPECT_LT(reds(render(later).image, 0, 60), reds(left, 0, 60));
}

TEST(Display, IsPartOfThePictureAndNotOfTheLight) {
    const Scene lit = valid(cube(Display::kLit)), shown = valid(cube(Display::kQuads));
    EXPECT_NE(fingerprint(lit), fingerprint(shown));
    EXPECT_EQ(light_fingerprint(lit), light_fingerprint(shown));
}

}  // namespace
}  // namespace awan
