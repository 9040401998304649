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
                               peak_of(scene->medium), true, true, 2)
        .often;
}

// Angle within which half of the light turns.
double middle_of(const std::vector<Ring>& rings) {
    double within = 0;
    for (const Ring& ring : rings) {
        within += ring.share;
        if (within >= 0.5) return ring.angle;
    }
    return std::numbers::pi;
}

TEST(BehindPeak, RingsRiseAndAreNarrowerForSteeperPeaksAndThinMatter) {
    double before = std::numbers::pi;
    for (const double g : {0.3, 0.6, 0.85, 0.95, 0.99}) {
        const Medium medium = medium_of(g);
        const Peak peak = peak_of(medium);
        const double most = depth_of_most(medium, peak);
        const std::vector<Ring> rings = rings_of_peak(medium, peak, most, 24);
        ASSERT_EQ(rings.size(), 24U);
        EXPECT_GT(rings.front().angle, 0);
        EXPECT_LE(rings.back().angle, std::numbers::pi);
        double sum = 0;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            if (i > 0) {
                EXPECT_GT(rings[i].angle, rings[i - 1].angle);
            }
            sum += rings[i].share;
        }
        EXPECT_NEAR(sum, 1, 1e-9);
        EXPECT_LT(middle_of(rings), before);
        EXPECT_LE(middle_of(rings_of_peak(medium, peak, 0, 24)), middle_of(rings));
        before = middle_of(rings);
    }
    // Three or four times scattered, by about 1 - g = .01 each.
    EXPECT_LT(before, 0.08);
}

// Scattered once, a sky of one Legendre order about any axis is that sky times what the peak keeps of the order.
TEST(BehindPeak, KeepsOfEveryOrderWhatThePhaseFunctionDoes) {
    const Medium medium = medium_of(0.85);
    const Peak peak = peak_of(medium);
    for (const double x : {0.0, depth_of_most(medium, peak)}) {
        const std::vector<Ring> rings = rings_of_peak(medium, peak, x, 24);
        for (int l = 1; l <= 12; ++l) {
            double mean = 0;
            for (const Ring& ring : rings)
                mean += ring.share * std::legendre(static_cast<unsigned>(l), std::cos(ring.angle));
            const double ratio = l < peak.from ? 1 : std::pow(0.85, l) / peak.share;
            const double wanted = x > 0 ? std::expm1(x * ratio) / std::expm1(x) : ratio;
            EXPECT_NEAR(mean, wanted, 0.02) << "order " << l << " x " << x;
        }
    }
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
