// What the rung harris shows, beside the transport of light: detail of the same lumps, and no side without light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/draw/splats.h"
#include "core/generate/generate.h"
#include "core/light/light.h"
#include "core/scene/automaton.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::pixel;
using test::Pixel;

SceneDraft table(const char* rung) {
    SceneDraft draft = test::table_4_4();
    draft.density = std::nullopt;
    draft.image.width = 160;
    draft.image.height = 100;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = rung;
    return draft;
}

double luminance(const Pixel& p) {
    return 0.2126 * p.r + 0.7152 * p.g + 0.0722 * p.b;
}

// Root of the mean squared difference of opacity.
double apart(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 3; i < a.pixels.size(); i += 4) {
        const double d = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(a.pixel_count()));
}

TEST(SplatPicture, HasTheLumpsOfTheMarch) {
    SceneDraft splats = table("harris"), march = table("transport-16");
    const Image smooth = test::render(splats).image;
    splats.detail = march.detail = Detail{};
    const Image lumps = test::render(splats).image, marched = test::render(march).image;
    // The field is the same; only how it is summed along a ray differs.
    EXPECT_GT(apart(smooth, marched), 0.08);
    EXPECT_LT(apart(lumps, marched), 0.6 * apart(smooth, marched));
}

TEST(SplatPicture, DetailIsTheSameFromWithinAndFromFarAway) {
    // The eye in the cloud takes the other program; far from the origin digits are few.
    SceneDraft draft = table("harris");
    draft.detail = Detail{};
    draft.camera.automatic = false;
    draft.camera.eye = {3, 2, 24};
    draft.camera.target = {0, -1, 0};
    const Image once = test::render(draft).image;
    draft.effects[static_cast<int>(Effect::kInterior)] = Switch::kOn;
    EXPECT_LT(apart(once, test::render(draft).image), 2e-3);
}

TEST(SplatPicture, NoSideIsBlack) {
    // Seen from the side that the sun does not see, where the printed recurrence leaves nothing of a deep cloud.
    for (const double azimuth : {60.0, 180.0, 300.0}) {
        SceneDraft splats = table("harris"), march = table("transport-16");
        splats.sun.azimuth = march.sun.azimuth = azimuth;
        splats.detail = march.detail = Detail{};
        const Image drawn = test::render(splats).image, marched = test::render(march).image;
        double least = 1e9, sum = 0, truth = 0;
        for (int y = 0; y < drawn.height; ++y)
            for (int x = 0; x < drawn.width; ++x) {
                const Pixel p = pixel(drawn, x, y), q = pixel(marched, x, y);
                if (p.a < 0.95 || q.a < 0.95) continue;
                least = std::min(least, luminance(p) / luminance(q));
                sum += luminance(p);
                truth += luminance(q);
            }
        ASSERT_GT(truth, 0);
        EXPECT_GT(least, 0.35) << azimuth;
        EXPECT_GT(sum / truth, 0.65) << azimuth;
        EXPECT_LT(sum / truth, 1.35) << azimuth;
    }
}

TEST(SplatPicture, InPassingIsTheSameButCoarser) {
    // An odd size: half of it is no whole number of pixels.
    SceneDraft draft = table("harris");
    draft.image.width = 161;
    draft.image.height = 101;
    const Scene scene = test::valid(draft);
    const Tools tools{&test::device(), 2, nullptr, {}, {}};
    auto planned = plan_scene(scene, 2, {});
    auto passing = render_planned(scene, as_preview(scene, *planned), tools, {});
    ASSERT_TRUE(passing.ok());
    EXPECT_TRUE(std::isnan(passing->stated_error));
    const Image whole = test::render(draft).image;
    ASSERT_EQ(passing->image.pixels.size(), whole.pixels.size());
    EXPECT_GT(apart(passing->image, whole), 0);
    EXPECT_LT(apart(passing->image, whole), 0.02);
}

// Many splats look their lumps up with less care, and are cut closer to their middles.
TEST(SplatPicture, OfManyHasTheLumpsOfTheMarch) {
    SceneDraft draft = table("harris");
    draft.top_level_cubes = false;
    draft.clouds.push_back({});
    draft.clouds[0].model = CloudModel::kAutomaton;
    auto automaton = std::make_shared<AutomatonCloud>();
    automaton->most_particles = 65536;
    draft.clouds[0].automaton = automaton;
    const Scene smooth = test::valid(draft);
    ASSERT_GT(generate(smooth, 2, {})->size(), kManySplats);
    SceneDraft lumpy = draft, marched = draft;
    lumpy.detail = marched.detail = Detail{};
    marched.accuracy.rung = "transport-16";
    const Image splats = test::render(lumpy).image, march = test::render(marched).image;
    EXPECT_LT(apart(splats, march), 0.6 * apart(test::render(draft).image, march));
}

TEST(SplatPicture, OfAnAutomatonInPassingHasFewSplats) {
    SceneDraft draft = test::plain_draft();
    draft.top_level_cubes = false;
    draft.clouds.push_back({});
    draft.clouds[0].model = CloudModel::kAutomaton;
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>();
    for (const char* const rung : {"harris", "transport-16"}) {
        draft.accuracy.rung = rung;
        const Scene passing = for_preview(test::valid(draft));
        EXPECT_EQ(passing->clouds[0].automaton->most_particles,
                  std::string(rung) == "harris" ? 16384U : 65536U);
    }
}

// Light on the particles of a cloud, by the passes.
std::vector<ParticleLight> lit(const SceneDraft& draft) {
    const Scene scene = test::valid(draft);
    auto planned = plan_scene(scene, 1, {});
    auto lighting = light(scene, planned->particles, planned->plan, test::device(), {});
    EXPECT_TRUE(lighting.ok());
    return lighting->particles;
}

TEST(SplatLight, OfAFurnaceNothingIsLost) {
    // What both halves of the sky send into matter that does not absorb is all of it, at any depth (light/light.h).
    for (const double density : {0.01, 1.0, 1e4}) {
        SceneDraft draft = test::table_4_4();
        draft.density = density;
        draft.medium.albedo = 1;
        for (const ParticleLight& p : lit(draft))
            ASSERT_NEAR(p.from_above.w + p.from_below.w, 2, 1e-3) << density;
    }
}

TEST(SplatLight, MatterThatAbsorbsIsDarkInside) {
    SceneDraft draft = test::table_4_4();
    draft.density = 5;
    draft.medium.albedo = 0.7;
    const std::vector<ParticleLight> light = lit(draft);
    float least = 2;
    for (const ParticleLight& p : light) least = std::min(least, p.from_above.w + p.from_below.w);
    EXPECT_LT(least, 0.2F);
}

TEST(SplatLight, AThinCloudHasNothingScatteredAbout) {
    SceneDraft draft = test::table_4_4();
    draft.density = 1e-5;
    for (const ParticleLight& p : lit(draft)) {
        ASSERT_LT(p.diffuse.w, 1e-3F);
        ASSERT_NEAR(p.from_above.w, 1, 1e-3);
        ASSERT_NEAR(p.from_below.w, 1, 1e-3);
    }
}

// The light that is scattered about in a layer, against its closed form: one wide particle lies over another.
TEST(SplatLight, WhatDeepMatterKeepsFollowsTheLayer) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 4, 3}, {{0, 14, 0}, 4, 3}});
    draft.sun.elevation = 90;
    draft.medium.g = 0;
    draft.medium.albedo = 1;
    const std::vector<ParticleLight> light = lit(draft);
    ASSERT_EQ(light.size(), 2U);
    // The lower one has all the depth of the upper above it: less of the beam, and less from about.
    EXPECT_LT(light[0].direct.w, 0.2F * light[1].direct.w);
    EXPECT_LT(light[0].diffuse.w, light[1].diffuse.w);
    EXPECT_GT(light[0].diffuse.w, 0.2F * light[1].diffuse.w);
}

}  // namespace
}  // namespace awan
