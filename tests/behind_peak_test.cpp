// What stands behind a cloud, as light that the forward peak has scattered shows it.
#include "core/draw/behind_peak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/light/delta_m.h"
#include "core/light/ground_light.h"
#include "core/scene/outside.h"
#include "tests/scenes.h"

namespace awan {
namespace {

Medium medium_of(double g) {
    Medium medium;
    medium.g = g;
    medium.albedo = 1;
    return medium;
}

Peak peak_of(const Medium& medium) {
    return {4, split_scattering(medium).peak_share};
}

// An even sky of radiance 1, seen level with 90 degrees from top to bottom.
SceneDraft under_even_sky(double g) {
    SceneDraft draft = test::table_4_4();
    draft.medium = medium_of(g);
    draft.sky.zenith = draft.sky.horizon = glm::dvec3(1);
    draft.sky.intensity = 1;
    draft.camera.eye = {0, 0, 30};
    draft.camera.target = {0, 0, 0};
    draft.camera.fov = 90;
    return draft;
}

std::vector<float> seen(const SceneDraft& draft, int width, int height) {
    const Scene scene = test::valid(draft);
    View view;
    view.eye = draft.camera.eye;
    view.forward = {0, 0, -1};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.tan_half_fov = 1;
    view.aspect = static_cast<double>(width) / height;
    return behind_through_peak(scene, view, width, height, bare_ground(*scene),
                               peak_of(scene->medium), true, true, 2);
}

TEST(BehindPeak, RingsRiseAndAreNarrowerForSteeperPeaks) {
    double before = std::numbers::pi;
    for (const double g : {0.3, 0.6, 0.85, 0.95, 0.99}) {
        const Medium medium = medium_of(g);
        const std::vector<double> rings = rings_of_peak(medium, peak_of(medium), 8);
        ASSERT_EQ(rings.size(), 8U);
        EXPECT_GT(rings.front(), 0);
        EXPECT_LE(rings.back(), std::numbers::pi);
        EXPECT_TRUE(std::is_sorted(rings.begin(), rings.end()));
        EXPECT_LT(rings[4], before);
        before = rings[4];
    }
    // Three or four times scattered, by about 1 - g = .01 each.
    EXPECT_LT(before, 0.08);
}

TEST(BehindPeak, AnEvenSkyStaysAsItIs) {
    for (const float one : seen(under_even_sky(0.85), 16, 12)) EXPECT_NEAR(one, 1, 1e-5);
}

// Beside the horizon half of what the peak brings is the black ground's; some tens of degrees away nothing is, or all.
TEST(BehindPeak, TheHorizonIsAsSoftAsThePeakIsWide) {
    double softer = 0;
    for (const double g : {0.95, 0.85, 0.6}) {
        SceneDraft draft = under_even_sky(g);
        draft.ground = Ground{};
        draft.ground->height = -20;
        draft.ground->albedo = glm::dvec3(0);
        const int height = 90;
        const std::vector<float> rgb = seen(draft, 8, height);
        const auto at = [&](int row) {
            return static_cast<double>(rgb[3 * static_cast<std::size_t>(row * 8 + 4)]);
        };
        EXPECT_NEAR(0.5 * (at(height / 2 - 1) + at(height / 2)), 0.5, 0.07);
        EXPECT_GT(at(0), 0.9);
        EXPECT_LT(at(height - 1), 0.1);
        // Sums of what lies on the other side.
        double lost = 0;
        for (int row = 0; row < height / 2; ++row) lost += 1 - at(row);
        EXPECT_GT(lost, softer);
        softer = lost;
    }
}

}  // namespace
}  // namespace awan
