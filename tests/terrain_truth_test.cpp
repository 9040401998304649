// Pictures of hills, and of clouds over and among them, against the path tracer.
#include <gtest/gtest.h>

#include "core/survey/relief_ray.h"
#include "core/truth/oracles.h"
#include "tests/terrain_scenes.h"

namespace awan {
namespace {

struct Compared {
    test::Apart hills, clouds, all;
};

// Pixels that show hills or level ground, and those with cloud before them.
Compared compare(SceneDraft draft, int cells, std::uint32_t samples) {
    draft.image.width = 120;
    draft.image.height = 80;
    const auto made = test::ground_picture(draft, cells);
    const Scene scene = test::valid(draft);
    TruthOptions options;
    options.samples = samples;
    options.threads = 2;
    options.whole_pixels = true;
    const auto truth = trace_truth(scene, made.planned.particles, made.planned.survey.view, options,
                                   Progress{}, Deadline{});
    EXPECT_TRUE(truth.ok());
    const auto relief = relief_of(*scene, 2);
    const auto sees = [&](int x, int y) {
        const test::Ray r = test::ray(made.planned.survey.view, made.image, x, y);
        const double t = relief ? ground_ahead(*relief, r.eye, r.direction) : 1e30;
        const double alpha = -std::expm1(
            -line_optical_depth(made.planned.particles, r.eye, r.direction, 0, std::min(t, 1e30)));
        return std::pair(std::isfinite(t), alpha);
    };
    Compared compared{
        test::apart(made.image, *truth,
                    [&](int x, int y) { return sees(x, y).first && sees(x, y).second < .02; }),
        test::apart(made.image, *truth, [&](int x, int y) { return sees(x, y).second > .05; }),
        test::apart(made.image, *truth, [](int, int) { return true; })};
    std::printf(
        "  hills %.2f%% (bias %+.2f%%, %d px), clouds %.2f%% (%+.2f%%, %d px), all %.2f%%\n",
        100 * compared.hills.nrmse, 100 * compared.hills.bias, compared.hills.pixels,
        100 * compared.clouds.nrmse, 100 * compared.clouds.bias, compared.clouds.pixels,
        100 * compared.all.nrmse);
    return compared;
}

// Single pixels differ by the truth's noise, and where shadows have edges; the means may not.
void expect_near(const Compared& compared) {
    EXPECT_GT(compared.hills.pixels, 2000);
    EXPECT_GT(compared.clouds.pixels, 300);
    EXPECT_LT(std::abs(compared.hills.bias), .03);
    EXPECT_LT(compared.hills.nrmse, .25);
    EXPECT_LT(std::abs(compared.clouds.bias), .09);
    EXPECT_LT(compared.clouds.nrmse, .2);
}

TEST(TerrainTruth, HillsUnderACumulusAreAsTheTruthHasThem) {
    expect_near(compare(test::over_hills(), 24, 32));
}

TEST(TerrainTruth, ALowSunThrowsLongShadowsOfHillsAndClouds) {
    expect_near(compare(test::over_hills(9), 24, 32));
}

TEST(TerrainTruth, ACloudAmongTheHillsIsCutOffAndShadedByThem) {
    SceneDraft draft = test::over_hills(12);
    draft.ground->height = -8;
    draft.ground->terrain->height = 9;
    draft.haze = Haze{.002, -6, 4, glm::dvec3(1), .5};
    expect_near(compare(draft, 24, 32));
}

}  // namespace
}  // namespace awan
