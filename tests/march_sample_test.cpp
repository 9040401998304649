// Pictures of which only some blocks are marched: what errors are measured with.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/base/morton.h"
#include "core/draw/backdrop.h"
#include "core/draw/march_bins.h"
#include "core/draw/march_setup.h"
#include "core/draw/picture_difference.h"
#include "core/generate/detail.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

using test::Ball;

constexpr int kWidth = 330, kHeight = 250;  // no whole number of blocks

// A long cloud, low in the picture, and a small one above it.
test::Stage two_clouds() {
    std::vector<Ball> list;
    for (int i = 0; i < 40; ++i) list.push_back({{0.2 * i - 4, -1.2, 0.1 * (i % 7)}, 0.7, 2});
    list.push_back({{2.5, 1.6, 0}, 0.5, 5});
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = kWidth;
    draft.image.height = kHeight;
    draft.camera.eye = {0, 0, 9};
    draft.camera.target = {0, 0, 0};
    return test::stage(draft);
}

std::vector<std::uint8_t> sampled(const test::Stage& stage, int count) {
    return sample_blocks(see_particles(stage.particles, stage.view, kWidth, kHeight, 1), kWidth,
                         kHeight, count);
}

TEST(Morton, NeighboursAreInterleaved) {
    EXPECT_EQ(morton_place(0, 0), 0u);
    EXPECT_EQ(morton_place(1, 0), 1u);
    EXPECT_EQ(morton_place(0, 1), 2u);
    EXPECT_EQ(morton_place(3, 5), 0b100111u);
    EXPECT_EQ(morton_place(0xffffffffu, 0xffffffffu), ~0ull);
}

// Block by block as in the whole picture, or empty; in any light, on any threads.
TEST(MarchSample, HasThePicturesOwnBlocks) {
    const test::Stage stage = two_clouds();
    const TransportLight light = test::grid_light(stage.scene, stage.particles, 16, 1,
                                                  [](glm::dvec3 p) { return 2 + std::sin(p.x); });
    MarchSettings settings;
    settings.one_ray = true;
    const Image whole = test::marched(stage, light, 2, settings);
    settings.sampled_blocks = 24;
    const Image sample = test::marched(stage, light, 1, settings);
    EXPECT_EQ(sample.pixels, test::marched(stage, light, 3, settings).pixels);
    const std::vector<std::uint8_t> blocks = sampled(stage, 24);
    EXPECT_EQ(std::count(blocks.begin(), blocks.end(), 1), 24);
    double seen = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool is_wanted = blocks[static_cast<std::size_t>(
                                       y / kBlockSide * blocks_in(kWidth) + x / kBlockSide)] == 1;
            const test::Pixel is = test::pixel(sample, x, y), all = test::pixel(whole, x, y);
            seen += is.a;
            ASSERT_EQ(is.r, is_wanted ? all.r : 0) << x << ' ' << y;
            ASSERT_EQ(is.a, is_wanted ? all.a : 0) << x << ' ' << y;
        }
    EXPECT_GT(seen, 1000);
}

// Light that is the same everywhere, on other grids: other steps meet other places in the matter.
TEST(MarchSample, PicturesThatShareTheirFinenessDifferByTheirLightAlone) {
    test::Stage stage = two_clouds();
    stage.particles.detail = std::make_shared<const DetailField>(
        make_detail({2, 1, {0, 0, 0}}, 1, 4, make_detail_tile(1, 1)));
    const auto constant = [](glm::dvec3) { return 2.0; };
    const TransportLight coarse = test::grid_light(stage.scene, stage.particles, 14, 1, constant),
                         fine = test::grid_light(stage.scene, stage.particles, 24, 1, constant);
    MarchSettings settings;
    settings.one_ray = true;
    const Image own_of_coarse = test::marched(stage, coarse, 2, settings),
                own_of_fine = test::marched(stage, fine, 2, settings);
    settings.fineness = fineness_of(stage.view, coarse, stage.particles,
                                    see_particles(stage.particles, stage.view, kWidth, kHeight, 1));
    ASSERT_EQ(settings.fineness.size(), 1u);  // there are no islands
    const Image of_coarse = test::marched(stage, coarse, 2, settings);
    EXPECT_EQ(of_coarse.pixels, own_of_coarse.pixels);
    const Image of_fine = test::marched(stage, fine, 2, settings);
    const double by_light = picture_difference(of_coarse, of_fine),
                 by_steps = picture_difference(own_of_coarse, own_of_fine);
    EXPECT_LT(by_light, 1e-5);
    EXPECT_GT(by_steps, 20 * by_light);
    EXPECT_GT(by_steps, 0.002);
}

TEST(MarchSample, IsSpreadOverAllThatThereIs) {
    const test::Stage stage = two_clouds();
    const auto all = sampled(stage, 1 << 20), some = sampled(stage, 24);
    const auto touched = std::count(all.begin(), all.end(), 1);
    EXPECT_GT(touched, 80);
    EXPECT_LT(touched, static_cast<std::ptrdiff_t>(all.size()) * 3 / 4);
    // Left and right half of the long cloud, and the small one.
    int left = 0, right = 0, above = 0;
    const int across = blocks_in(kWidth), down = blocks_in(kHeight);
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const auto at = static_cast<std::size_t>(y * across + x);
            if (some[at] == 0) continue;
            EXPECT_EQ(all[at], 1);
            ++(y < down / 2 ? above : x < across / 2 ? left : right);
        }
    EXPECT_GE(left, 6);
    EXPECT_GE(right, 6);
    EXPECT_GE(above, 1);
}

TEST(MarchSample, OfNothingIsNothing) {
    const std::vector<std::uint8_t> none = sample_blocks({}, 40, 20, 8);
    EXPECT_EQ(none, std::vector<std::uint8_t>(6, 0));
}

// A picture over nothing lacks what stands behind it, and nothing else: in haze, above a ground, too.
TEST(MarchSample, OverNothingWithWhatStandsBehindIsTheWhole) {
    std::vector<Ball> list;
    for (int i = 0; i < 20; ++i) list.push_back({{0.3 * i - 3, 1 + 0.1 * (i % 5), 0}, 0.7, 1});
    SceneDraft draft = test::balls(list);
    draft.sky = {};
    draft.ground.emplace().height = -1;
    draft.image.width = 120;
    draft.image.height = 80;
    draft.camera.eye = {0, 1, 9};
    draft.camera.target = {0, 0.8, 0};
    for (const double extinction : {0.0, 0.02, 0.3}) {
        draft.haze.emplace().extinction = extinction;
        MarchSettings settings;
        settings.one_ray = true;
        settings.eye_effects.aerial_perspective = settings.eye_effects.light_shafts =
            extinction > 0;
        draft.image.background = Background::kSky;
        const test::Stage over_sky = test::stage(draft);
        TransportLight light = test::grid_light(over_sky.scene, over_sky.particles, 8, 1,
                                                [](glm::dvec3) { return 2; });
        light.sun = test::exact_sun(over_sky.scene, over_sky.particles, 9, 2);
        light.ground = bare_ground(*over_sky.scene);
        const Image whole = test::marched(over_sky, light, 2, settings);
        draft.image.background = Background::kTransparent;
        Image laid = test::marched(test::stage(draft), light, 2, settings);
        double clear = 0, cloud = 0;
        for (std::size_t i = 0; i < laid.pixel_count(); ++i) {
            clear = std::max(clear, 1.0 - static_cast<double>(laid.pixels[4 * i + 3]));
            cloud = std::max(cloud, static_cast<double>(laid.pixels[4 * i + 3]));
        }
        EXPECT_GT(clear, 0.01) << extinction;
        EXPECT_GT(cloud, 0.5) << extinction;
        lay_under(laid, make_backdrop(over_sky.scene, over_sky.view, 120, 80, light.ground, 1));
        for (std::size_t i = 0; i < laid.pixels.size(); ++i)
            ASSERT_NEAR(laid.pixels[i], whole.pixels[i], 1e-5F + 1e-5F * whole.pixels[i])
                << extinction << ' ' << i;
    }
}

// What the sample says of two lights is what the whole picture says.
TEST(MarchSample, TellsHowLightsDiffer) {
    const test::Stage stage = two_clouds();
    const auto light = [&](double slope) {
        return test::grid_light(stage.scene, stage.particles, 16, 1,
                                [=](glm::dvec3 p) { return 2 + slope * std::sin(1.3 * p.x); });
    };
    MarchSettings settings;
    settings.one_ray = true;
    const auto difference = [&](int blocks) {
        settings.sampled_blocks = blocks;
        return picture_difference(test::marched(stage, light(0.5), 2, settings),
                                  test::marched(stage, light(0.3), 2, settings));
    };
    EXPECT_NEAR(difference(40) / difference(0), 1, 0.15);
}

}  // namespace
}  // namespace awan
