// The look of Upchurch 2009: cells of an automaton as billboards and points (core/looks/upchurch.h).
#include "core/looks/upchurch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/generate/automaton/cells.h"
#include "core/generate/automaton/state.h"
#include "core/generate/keyed_random.h"
#include "core/generate/own_textures.h"
#include "core/looks/gardner.h"
#include "core/looks/looks.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::pixel;
using test::render;
using test::valid;
using upchurch::axes_of;
using upchurch::CellStyle;
using upchurch::style_of;

TEST(UpchurchLook, DensityMakesCellsWhiteOpaqueAndLarge) {
    AutomatonDrawing drawing;
    drawing.color_multiplier = 1.5;
    drawing.opacity = 0.5;
    drawing.billboard_scale = 8;
    drawing.point_size = 3;
    for (const double q : {0.1, 0.4, 0.6, 1.0}) {
        const CellStyle billboard = style_of(drawing, q);
        EXPECT_DOUBLE_EQ(billboard.whiteness, std::min(1.5 * q, 1.0));
        EXPECT_DOUBLE_EQ(billboard.opacity, 0.5 * q);
        EXPECT_DOUBLE_EQ(billboard.side, 8 * q);
        drawing.mode = AutomatonMode::kDensity;
        EXPECT_DOUBLE_EQ(style_of(drawing, q).whiteness, std::min(1.5 * q, 1.0));
        EXPECT_EQ(style_of(drawing, q).side, 3);
        drawing.mode = AutomatonMode::kPresence;
        EXPECT_EQ(style_of(drawing, q).opacity, 1);
        EXPECT_EQ(style_of(drawing, q).whiteness, 1);
        drawing.mode = AutomatonMode::kGenerated;
    }
}

// look = camera - billboard, right = up_camera x look, up = look x right, in a right-handed frame: z towards the
// viewer.
TEST(UpchurchLook, BillboardsHaveThePrintedAxes) {
    for (const glm::dvec3& q :
         {glm::dvec3(0, 0, 5), {1, 2, 3}, {-4, 0.3, 2}, {0.1, -9, 1}, {30, 20, 0.5}}) {
        const glm::dvec3 look = -glm::dvec3(q.x, q.y, -q.z);
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), look));
        const glm::dvec3 up = glm::normalize(glm::cross(look, right));
        const auto axes = axes_of(q);
        for (int i = 0; i < 3; ++i) {
            const double sign = i == 2 ? -1 : 1;
            EXPECT_NEAR(axes.right[i], sign * right[i], 1e-14);
            EXPECT_NEAR(axes.up[i], sign * up[i], 1e-14);
        }
        EXPECT_NEAR(glm::dot(axes.up, q), 0, 1e-12);
    }
    const auto above = axes_of({0, 7, 0});
    EXPECT_TRUE(std::isfinite(above.right.x + above.up.x + above.up.z));
}

// A cloud of one cell, full at step 0 and empty from step 1 on, 2 units wide about (0, 1, 0).
Cloud one_cell(const AutomatonDrawing& drawing, std::size_t place) {
    AutomatonCloud automaton;
    automaton.cells = {1, 1, 1};
    automaton.cell = 2;
    automaton.ellipsoids = {{{90, 90, 90}, {1, 1, 1}}};
    automaton.outside_extinction = 1;
    automaton.smooth = {0, 0, 0};
    automaton.warm_up = 0;
    automaton.drawing = drawing;
    AutomatonState state;
    state.nx = state.ny = state.nz = 1;
    state.key = keyed(SceneDraft{}.seed, place);
    state.rules = automaton::rules_key(automaton);
    state.hum = state.act = {0};
    state.cld = {1};
    state.ellipsoids = automaton.ellipsoids;
    automaton.starts = {std::make_shared<const AutomatonState>(state)};
    Cloud cloud;
    cloud.model = CloudModel::kAutomaton;
    cloud.automaton = std::make_shared<const AutomatonCloud>(automaton);
    return cloud;
}

// Seen from 20 units away along z, straight on, 100 pixels a unit at 20 units.
SceneDraft scene_of(const std::vector<AutomatonDrawing>& drawings) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    for (std::size_t n = 0; n < drawings.size(); ++n) {
        draft.clouds.push_back(one_cell(drawings[n], n));
        draft.clouds.back().translate.z = -3.0 * static_cast<double>(n);
    }
    draft.look = Look::kUpchurch;
    draft.image.background = Background::kTransparent;
    draft.image.width = 96;
    draft.image.height = 80;
    draft.camera.automatic = false;
    draft.camera.eye = {0, 1, 20};
    draft.camera.target = {0, 1, 0};
    draft.camera.fov = 2 * std::atan(0.1) * 180 / 3.14159265358979323846;
    return draft;
}

Image picture_of(const SceneDraft& draft, int threads = 1) {
    const Scene scene = valid(draft);
    const View view = resolve_view(draft.camera, draft.image, {glm::dvec3(-1), glm::dvec3(1)});
    auto image = draw_look(scene, view, threads, {});
    EXPECT_TRUE(image.ok());
    return *std::move(image);
}

AutomatonDrawing points(AutomatonMode mode, double size = 1) {
    AutomatonDrawing drawing;
    drawing.mode = mode;
    drawing.point_size = size;
    drawing.color_multiplier = 0.25;
    drawing.opacity = 0.5;
    return drawing;
}

double sum_of_alpha(const Image& image) {
    double sum = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        sum += static_cast<double>(image.pixels[i]);
    return sum;
}

TEST(UpchurchLook, APointCoversItsCellAndHasItsColour) {
    const SceneDraft draft = scene_of({points(AutomatonMode::kPresence)});
    const double white = gardner::whites_of(valid(draft)).sunlit.x;
    const Image image = picture_of(draft);
    // 80 rows are 4 units there, so 2 units are 40 pixels.
    EXPECT_NEAR(sum_of_alpha(image), 40.0 * 40, 1e-2);
    EXPECT_EQ(pixel(image, 48, 40).a, 1);
    EXPECT_NEAR(pixel(image, 48, 40).r, white, 1e-6 * white);
    EXPECT_EQ(pixel(image, 26, 40).a, 0);
    EXPECT_EQ(pixel(image, 48, 61).a, 0);
    // By density, which is 1.
    const Image thin = picture_of(scene_of({points(AutomatonMode::kDensity, 0.33)}));
    EXPECT_NEAR(sum_of_alpha(thin), 0.5 * std::pow(40 * 0.33, 2), 1e-2);
    EXPECT_NEAR(pixel(thin, 48, 40).a, 0.5, 1e-6);
    EXPECT_NEAR(pixel(thin, 48, 40).r, 0.5 * 0.25 * white, 1e-6 * white);
}

TEST(UpchurchLook, WhatIsNearerIsBlendedOverWhatIsBehind) {
    AutomatonDrawing near = points(AutomatonMode::kDensity), far = near;
    near.opacity = 0.3, near.color_multiplier = 0.9;
    far.opacity = 0.8, far.color_multiplier = 0.4;
    const SceneDraft draft = scene_of({near, far});
    const double white = gardner::whites_of(valid(draft)).sunlit.x;
    const auto middle = pixel(picture_of(draft), 48, 40);
    EXPECT_NEAR(middle.a, 1 - 0.7 * 0.2, 1e-6);
    EXPECT_NEAR(middle.r, white * (0.3 * 0.9 + 0.7 * 0.8 * 0.4), 1e-5 * white);
}

TEST(UpchurchLook, ABillboardIsItsTexture) {
    AutomatonDrawing drawing;
    drawing.mode = AutomatonMode::kTextures;
    drawing.textures = "wisp";
    drawing.billboard_scale = 1.6;
    drawing.opacity = 0.75;
    const Image image = picture_of(scene_of({drawing}));
    // 64 pixels wide: two texels a pixel, whose means are a level of the texture.
    const std::vector<std::uint8_t> depth = own_texture_depth(4);
    double worst = 0, most = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto texel = [&](int i, int j) {
                return depth[static_cast<std::size_t>((2 * y + j) * kTextureSide + 2 * x + i)] /
                       255.0;
            };
            const double wanted =
                0.75 * 0.25 * (texel(0, 0) + texel(1, 0) + texel(0, 1) + texel(1, 1));
            worst = std::max(worst, std::abs(pixel(image, 16 + x, 8 + y).a - wanted));
            most = std::max(most, wanted);
        }
    EXPECT_LT(worst, 1e-3);
    EXPECT_GT(most, 0.3);
    EXPECT_EQ(pixel(image, 10, 40).a, 0);
}

TEST(UpchurchLook, BetweenStepsDensitiesBlendOrHold) {
    SceneDraft draft = scene_of({points(AutomatonMode::kDensity)});
    const auto alpha_at = [&](double time, bool hold) {
        AutomatonCloud automaton = *draft.clouds[0].automaton;
        automaton.drawing.hold = hold;
        draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(automaton);
        draft.time = time;
        return pixel(picture_of(draft), 48, 40).a;
    };
    EXPECT_NEAR(alpha_at(0, false), 0.5, 1e-6);
    // rho = rho0 + t (rho1 - rho0).
    EXPECT_NEAR(alpha_at(0.25, false), 0.5 * 0.75, 1e-6);
    EXPECT_NEAR(alpha_at(0.75, false), 0.5 * 0.25, 1e-6);
    EXPECT_NEAR(alpha_at(0.75, true), 0.5, 1e-6);
    EXPECT_EQ(alpha_at(1, false), 0);
}

TEST(UpchurchLook, IsTheSameForAnyThreadsAndFiniteFromAnywhere) {
    for (int mode = 0; mode < 4; ++mode) {
        SceneDraft draft = scene_of({{}});
        AutomatonCloud automaton;
        automaton.cells = {64, 20, 64};
        automaton.random = RandomEllipsoids{8, {5, 5, 5}, {12, 9, 12}, {}};
        automaton.drawing.mode = static_cast<AutomatonMode>(mode);
        draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(automaton);
        draft.camera.fov = 60;
        for (const glm::dvec3& eye : {glm::dvec3(0, 30, 300), {10, 40, 5}, {0, 400, 1}}) {
            draft.camera.eye = eye;
            draft.camera.target = {0, 20, 0};
            const Image image = picture_of(draft);
            EXPECT_EQ(image.pixels, picture_of(draft, 4).pixels);
            for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                ASSERT_TRUE(std::isfinite(image.pixels[i]) && image.pixels[i] >= 0);
                if (i % 4 == 3) {
                    ASSERT_LE(image.pixels[i], 1);
                }
            }
            if (eye.z == 300) {
                EXPECT_GT(sum_of_alpha(image), 1) << mode;
            }
        }
    }
}

TEST(UpchurchLook, TexturesAreNamedAndKnown) {
    SceneDraft draft = scene_of({{}});
    const auto pointer_of = [&](const char* textures) {
        AutomatonCloud automaton = *draft.clouds[0].automaton;
        automaton.drawing.textures = textures;
        draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(automaton);
        const auto scene = validate(draft);
        return scene.ok() ? std::string() : scene.error().pointer;
    };
    EXPECT_EQ(pointer_of("puff"), "");
    EXPECT_EQ(pointer_of("puff,torn,soft"), "");
    for (const char* wrong : {"", "puff,", "puff,none", "puff, torn", "unknown"})
        EXPECT_EQ(pointer_of(wrong), "/clouds/0/automaton/drawing/textures") << wrong;
}

}  // namespace
}  // namespace awan
