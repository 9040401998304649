// The survey's figures against closed forms, and the planner's table.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "core/generate/generate.h"
#include "core/gl/tile_lists.h"
#include "core/survey/gauss.h"
#include "core/survey/optical_depth.h"
#include "core/survey/projection.h"
#include "core/survey/volume.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::balls;
using test::valid;

const double kRootTwoPi = std::sqrt(2 * std::numbers::pi);

Planned planned(const SceneDraft& draft) {
    auto result = plan_scene(valid(draft), 2, {});
    EXPECT_TRUE(result.ok());
    return *std::move(result);
}

double mass_in(const DensityVolume& volume) {
    double sum = 0;
    for (const float cell : volume.extinction) sum += static_cast<double>(cell);
    return sum * volume.cell * volume.cell * volume.cell;
}

TEST(Survey, VolumeHoldsTheMassExactly) {
    for (const SceneDraft& draft :
         {balls({{}}), balls({{{0, 0, 0}, 1, 3}, {{5, 1, 2}, 0.01, 7}}), test::table_4_4(),
          balls({{{1e9, -1e9, 3}, 2, 0.5}}), balls({{{0, 0, 0}, 1e-6, 1}, {{1, 0, 0}, 1e6, 1}})}) {
        const Survey survey = planned(draft).survey;
        EXPECT_NEAR(mass_in(survey.volume) / survey.total_mass, 1, 1e-5);
    }
}

TEST(Survey, BreaksOffAtItsDeadline) {
    const ParticleSet particles = *generate(valid(balls({{}})), 1, {});
    Deadline over;
    over.until = Deadline::Clock::now();
    EXPECT_GT(mass_in(density_volume(particles, 16)), 0);
    EXPECT_EQ(mass_in(density_volume(particles, 16, kMaxVolumeWork, over)), 0);
    const auto surveyed = survey(valid(balls({{}})), particles, 1, over);
    ASSERT_FALSE(surveyed.ok());
    EXPECT_EQ(surveyed.error().code, ErrorCode::kOverDeadline);
}

TEST(Survey, OneGaussiansFigures) {
    const Survey survey = planned(balls({{{0, 0, 0}, 2, 0.7}})).survey;  // s = 1
    EXPECT_NEAR(survey.optical_depth_sun, 0.7 * kRootTwoPi, 1e-6);
    EXPECT_NEAR(survey.optical_depth_eye, 0.7 * kRootTwoPi, 1e-6);
    EXPECT_NEAR(survey.max_sigma_s, 0.7, 1e-7);
    EXPECT_NEAR(survey.total_mass, 0.7 * std::pow(2 * std::numbers::pi, 1.5), 1e-6);
    EXPECT_EQ(survey.bounds.max, glm::dvec3(2));
    EXPECT_FALSE(survey.eye_inside);
    const double tan_half = std::tan(20 * std::numbers::pi / 180);
    EXPECT_NEAR(survey.max_projected_px, 1.0 / 20 * 48 / (2 * tan_half), 1e-9);
    // A disc: to where 1 - e^-tau is a twentieth of what it is in the middle.
    const double middle = 0.7 * kRootTwoPi, edge = -std::log1p(0.05 * std::expm1(-middle));
    const double radius = std::sqrt(2 * std::log(middle / edge)) / 20 / tan_half * 24;  // pixels
    EXPECT_NEAR(survey.covered, std::numbers::pi * radius * radius / (64 * 48), 0.02 * 0.3);
    EXPECT_GT(survey.mean_depth_eye, edge);
    EXPECT_LT(survey.mean_depth_eye, middle);
}

TEST(Survey, OpticalDepthsOfManyAreThoseOfTheLines) {
    // The largest over a fine set of lines, summed exactly.
    const SceneDraft draft = test::table_4_4();
    const Planned all = planned(draft);
    double largest = 0;
    for (double x = -9; x < 9; x += 0.1)
        for (double z = -4; z < 4; z += 0.1) {
            double sum = 0;
            for (std::size_t i = 0; i < all.particles.size(); ++i) {
                const double s = all.particles.radius[i] / 2.0;
                const glm::dvec3 c = all.particles.center[i];
                sum += static_cast<double>(all.particles.density[i]) * s * kRootTwoPi *
                       std::exp(-((c.x - x) * (c.x - x) + (c.z - z) * (c.z - z)) / (2 * s * s));
            }
            largest = std::max(largest, sum);
        }
    EXPECT_NEAR(all.survey.optical_depth_zenith / largest, 1, 0.02);
}

TEST(Survey, AutomaticDensityMakesTable44AThickCumulus) {
    SceneDraft draft;
    const std::string text = [] {
        std::FILE* file = std::fopen(AWAN_TEST_DATA "/table-4.4.awn", "rb");
        std::string all;
        for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) all += static_cast<char>(c);
        std::fclose(file);
        return all;
    }();
    const Survey survey = planned(*read_awn(text)).survey;
    EXPECT_GT(survey.optical_depth_zenith, 30);
    EXPECT_LT(survey.optical_depth_eye, 80);
}

TEST(Survey, FarFromTheOriginNothingChanges) {
    SceneDraft draft = balls({{{0, 0, 0}, 1, 3}, {{2, 1, 0}, 0.5, 7}});
    const Survey near = planned(draft).survey;
    const glm::dvec3 away(9e8, -9e8, 9e8);
    for (glm::dvec3& p : draft.clouds[0].ready.positions) p += away;
    draft.camera.eye += away;
    draft.camera.target += away;
    const Survey far = planned(draft).survey;
    EXPECT_NEAR(far.optical_depth_sun / near.optical_depth_sun, 1, 1e-5);
    EXPECT_NEAR(far.optical_depth_eye / near.optical_depth_eye, 1, 1e-5);
    EXPECT_NEAR(far.max_extinction / near.max_extinction, 1, 1e-5);
}

TEST(Survey, EyeInsideSeesHalfTheCloud) {
    SceneDraft draft = balls({{{0, 0, 0}, 2, 1}});
    draft.camera.eye = {0, 0, 0};
    draft.camera.target = {0, 0, -1};
    const Survey survey = planned(draft).survey;
    EXPECT_TRUE(survey.eye_inside);
    EXPECT_NEAR(survey.optical_depth_eye, kRootTwoPi / 2, 1e-5);
    EXPECT_TRUE(std::isinf(survey.max_projected_px));
}

TEST(Survey, EmptySceneHasNoFigures) {
    const Survey survey = planned(balls({})).survey;
    EXPECT_EQ(survey.particles, 0u);
    EXPECT_EQ(survey.optical_depth_sun, 0);
    EXPECT_EQ(survey.volume.cells.x, 0);
}

TEST(Survey, AutomaticCameraHoldsTheWholeCloud) {
    for (const double aspect : {0.1, 1.0, 4.0}) {
        SceneDraft draft = test::table_4_4();
        draft.image.width = static_cast<int>(400 * aspect);
        draft.image.height = 400;
        const Survey survey = planned(draft).survey;
        const View& view = survey.view;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p((corner & 1) ? survey.bounds.max.x : survey.bounds.min.x,
                               (corner & 2) ? survey.bounds.max.y : survey.bounds.min.y,
                               (corner & 4) ? survey.bounds.max.z : survey.bounds.min.z);
            const glm::dvec3 q = p - view.eye;
            const double depth = glm::dot(q, view.forward);
            EXPECT_GT(depth, 0);
            EXPECT_LE(std::abs(glm::dot(q, view.right)),
                      depth * view.tan_half_fov * view.aspect * 1.0001);
            EXPECT_LE(std::abs(glm::dot(q, view.up)), depth * view.tan_half_fov * 1.0001);
        }
    }
}

TEST(Projection, DiscSlopesAreThoseOfItsPoints) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-5, 5), size(0.01, 4);
    for (int n = 0; n < 2000; ++n) {
        const double x = place(random), z = place(random), r = size(random);
        const Interval slopes = disc_slopes(x, z, r);
        for (int i = 0; i < 100; ++i) {
            const double angle = i * 2 * std::numbers::pi / 100;
            const double px = x + r * std::cos(angle), pz = z + r * std::sin(angle);
            if (pz <= 1e-9) continue;
            ASSERT_GE(px / pz, slopes.low - 1e-6 * std::abs(px / pz));
            ASSERT_LE(px / pz, slopes.high + 1e-6 * std::abs(px / pz));
        }
    }
}

TEST(Gauss, TableIsTheNormalDistribution) {
    for (double x = -7; x < 7; x += 0.001)
        ASSERT_NEAR(normal_cdf(x), 0.5 * std::erfc(-x / std::numbers::sqrt2), 2e-7);
    for (const double end : {-5.5, 5.5})  // of the table that it is made from
        for (const double x : {std::nextafter(end, -6.0), end, std::nextafter(end, 6.0)})
            ASSERT_NEAR(normal_cdf(x), end > 0 ? 1 : 0, 2e-7);
    EXPECT_EQ(normal_cdf(std::numeric_limits<double>::infinity()), 1);
    EXPECT_EQ(normal_cdf(-std::numeric_limits<double>::infinity()), 0);
}

TEST(TileLists, AreThoseOfBruteForceHoweverTheRasterIsCut) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> column(0, 22), row(0, 16), layer(0, 2);
    std::vector<gl::TileBox> boxes(300);
    for (gl::TileBox& box : boxes) {
        const int x = column(random), y = row(random), z = layer(random);
        box = {x - 2, y - 1, x + 1, y + 1, z, std::min(z + 1, 2)};
    }
    for (const std::uint64_t most : {1u, 40u, 1000u, 1000000u}) {
        std::vector<std::vector<std::uint32_t>> found(23 * 17 * 3);
        const auto status = gl::for_each_region(
            boxes, 23, 17, 3, most, most, {}, [&](const gl::TileRegion& region) -> Status {
                for (int z = 0; z < 3; ++z)
                    for (int y = 0; y < region.height; ++y)
                        for (int x = 0; x < region.width; ++x) {
                            const auto t = static_cast<std::size_t>(
                                (z * region.height + y) * region.width + x);
                            auto& list = found[static_cast<std::size_t>(
                                (z * 17 + y + region.y) * 23 + x + region.x)];
                            EXPECT_TRUE(list.empty());
                            list.assign(region.items.begin() + region.begin[t],
                                        region.items.begin() + region.begin[t + 1]);
                        }
                return std::nullopt;
            });
        ASSERT_FALSE(status.has_value());
        for (int z = 0; z < 3; ++z)
            for (int y = 0; y < 17; ++y)
                for (int x = 0; x < 23; ++x) {
                    std::vector<std::uint32_t> expected;
                    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
                        const gl::TileBox& b = boxes[i];
                        if (x >= b.first_x && x <= b.last_x && y >= b.first_y && y <= b.last_y &&
                            z >= b.first_z && z <= b.last_z)
                            expected.push_back(i);
                    }
                    ASSERT_EQ(found[static_cast<std::size_t>((z * 17 + y) * 23 + x)], expected);
                }
    }
}

// Of a disc the tiles that it reaches into, by the nearest of many points of each.
TEST(TileLists, OfADiscAreTheTilesThatItReachesInto) {
    gl::TileBox disc{0, 0, 11, 9, 0, 0, 6.3F, 4.6F, 1 / 3.2F, 1 / 2.4F};
    std::vector<std::size_t> count(12 * 10);
    const auto status = gl::for_each_region(std::span(&disc, 1), 12, 10, 1, 1000, 1000, {},
                                            [&](const gl::TileRegion& region) -> Status {
                                                for (std::size_t t = 0; t < count.size(); ++t)
                                                    count[t] =
                                                        region.begin[t + 1] - region.begin[t];
                                                return std::nullopt;
                                            });
    ASSERT_FALSE(status.has_value());
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x) {
            double nearest = 1e9;
            for (int i = 0; i <= 100; ++i)
                for (int j = 0; j <= 100; ++j)
                    nearest = std::min(nearest, std::hypot((x + i / 100.0 - 6.3) / 3.2,
                                                           (y + j / 100.0 - 4.6) / 2.4));
            if (std::abs(nearest - 1) < 0.01) continue;  // too near to say
            EXPECT_EQ(count[static_cast<std::size_t>(y * 12 + x)], nearest < 1 ? 1U : 0U)
                << x << ' ' << y;
        }
}

TEST(TileLists, StopAtTheDeadline) {
    const std::vector<gl::TileBox> boxes(1);
    Deadline over;
    over.until = Deadline::Clock::now();
    const auto status = gl::for_each_region(boxes, 1, 1, 1, 1, 1, over,
                                            [](const gl::TileRegion&) { return Status{}; });
    ASSERT_TRUE(status.has_value());
    EXPECT_EQ(status->code, ErrorCode::kOverDeadline);
}

TEST(Plan, ThinCloudsNeedNeitherShadowNorSortingNorScattering) {
    const auto on = [](double tau, double g, Effect effect) {
        SceneDraft draft = balls({{{0, 0, 0}, 2, tau / kRootTwoPi}});
        draft.medium.g = g;
        return planned(draft).plan.on(effect);
    };
    EXPECT_FALSE(on(0.029, 0.85, Effect::kViewExtinction));
    EXPECT_TRUE(on(0.031, 0.85, Effect::kViewExtinction));
    EXPECT_FALSE(on(0.029, 0, Effect::kSelfShadow));
    EXPECT_TRUE(on(0.031, 0, Effect::kSelfShadow));
    EXPECT_FALSE(on(0.039, 0, Effect::kMultipleScattering));
    EXPECT_TRUE(on(0.041, 0, Effect::kMultipleScattering));
    EXPECT_FALSE(on(0.019, 0.85, Effect::kMultipleScattering));
    EXPECT_TRUE(on(0.021, 0.85, Effect::kMultipleScattering));
    EXPECT_TRUE(on(0.021, 0.85, Effect::kSelfShadow))
        << "scattered light travels with the light pass";
}

TEST(Plan, SwitchesWinAndSayWhatTheSceneWouldHaveSaid) {
    SceneDraft draft = balls({{{0, 0, 0}, 2, 5}});
    test::effect(draft, Effect::kSelfShadow) = Switch::kOff;
    test::effect(draft, Effect::kInterior) = Switch::kOn;
    const Plan plan = planned(draft).plan;
    EXPECT_FALSE(plan.on(Effect::kSelfShadow));
    EXPECT_FALSE(plan.on(Effect::kMultipleScattering));
    EXPECT_TRUE(plan.on(Effect::kInterior));
    EXPECT_NE(plan.effects[0].reason.find("switched off"), std::string::npos);
    EXPECT_NE(plan.effects[0].reason.find("is over 0.03"), std::string::npos);
    for (const EffectDecision& decision : plan.effects) EXPECT_FALSE(decision.reason.empty());
    EXPECT_EQ(plan.rung, "harris");
}

TEST(Plan, NoLightNoEffects) {
    SceneDraft draft = balls({{{0, 0, 0}, 2, 5}});
    draft.sun.intensity = 0;
    const Plan plan = planned(draft).plan;
    EXPECT_FALSE(plan.on(Effect::kSelfShadow));
    EXPECT_FALSE(plan.on(Effect::kSkyLight));
    EXPECT_TRUE(plan.on(Effect::kViewExtinction));
}

}  // namespace
}  // namespace awan
