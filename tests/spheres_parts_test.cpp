// Numbers of parts, their places and distributions, and motion in time: what the printed five are one case of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/generate/models.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/subdivision.h"
#include "tests/random_models_spheres.h"
#include "tests/spheres_clouds.h"

namespace awan {
namespace {

using spheres::at_share;
using spheres::child_offset;
using spheres::cluster_moments;
using spheres::ClusterMoments;
using spheres::kLeafVariance;
using spheres::mean_of_power;
using spheres::part_offset;
using spheres::pose_at;
using spheres::rotation_of;
using spheres::sphere_part;
using spheres::SphereDraw;
using spheres::SphereNode;
using spheres::SpherePart;
using spheres::SphereTree;

using test::cloud_of;
using test::particles_of;
using test::request_of;

constexpr SpheresPlaces kAllPlaces[] = {SpheresPlaces::kCross, SpheresPlaces::kTurned,
                                        SpheresPlaces::kDome, SpheresPlaces::kBall,
                                        SpheresPlaces::kRow};
constexpr SpheresLaw kAllLaws[] = {SpheresLaw::kUniform, SpheresLaw::kFalling, SpheresLaw::kRising,
                                   SpheresLaw::kMiddle, SpheresLaw::kEnds};

template <typename Check>
void each_pair(const SphereTree& tree, const SphereNode& node, int level, const Check& check) {
    if (level == tree.levels()) return;
    for (const SphereNode& child : tree.children(node, level)) {
        check(node, child, level);
        each_pair(tree, child, level + 1, check);
    }
}

// --- places

// The printed five are one case of the rule for any number: the same ten places, side by side.
TEST(SpheresParts, ACrossOfFiveIsThePrintedOne) {
    for (const double up : {1.0, -1.0}) {
        std::vector<glm::dvec3> printed, ours;
        for (int j = 0; j < 5; ++j)
            for (const double side : {-1.0, 1.0}) {
                const SphereDraw draw{0.4, 0.93, side};
                printed.push_back(child_offset(j, draw, glm::dvec3(1), glm::dvec3(1), up));
                ours.push_back(part_offset(sphere_part(SpheresPlaces::kCross, j, 5, up), draw,
                                           SpheresPlaces::kCross, {0, 1}));
            }
        for (const glm::dvec3& place : printed)
            EXPECT_TRUE(std::any_of(
                ours.begin(), ours.end(),
                [&](const glm::dvec3& one) { return glm::length(one - place) < 1e-15; }))
                << place.x << ' ' << place.y << ' ' << place.z;
    }
}

// (s D)^2 + f(s D, D)^2 = D^2, whatever the places: all parts touch their parent from within.
TEST(SpheresParts, EveryPartTouchesItsParentFromWithin) {
    test::Dice dice(1);
    for (const SpheresPlaces places : kAllPlaces)
        for (int n = 2; n <= 12; ++n)
            for (int j = 0; j < n; ++j) {
                const SpherePart part = sphere_part(places, j, n, 1);
                ASSERT_NEAR(glm::length(part.along), 1, 1e-12);
                for (const glm::dvec3& across : part.across) {
                    ASSERT_NEAR(glm::length(across), 1, 1e-12);
                    ASSERT_NEAR(glm::dot(across, part.along), 0, 1e-12);
                }
                const SphereDraw draw{dice.uniform(), dice.uniform(), dice.chance(0.5) ? 1. : -1.};
                const glm::dvec3 at =
                    part_offset(part, draw, places, exact::sincos_degrees(dice.between(0, 360)));
                ASSERT_NEAR(glm::length(at), 1 - draw.ratio, 1e-12);
            }
}

TEST(SpheresParts, StandWhereTheirWordSays) {
    for (const int n : {2, 5, 9}) {
        for (int j = 0; j < n; ++j) {
            EXPECT_EQ(sphere_part(SpheresPlaces::kCross, j, n, 1).along.y, j == n - 1 ? 1 : 0);
            EXPECT_GE(sphere_part(SpheresPlaces::kDome, j, n, 1).along.y, 0);
            EXPECT_LE(sphere_part(SpheresPlaces::kDome, j, n, -1).along.y, 0);
            const SpherePart row = sphere_part(SpheresPlaces::kRow, j, n, 1);
            EXPECT_NEAR(row.share * row.along.x, 2.0 * j / (n - 1) - 1, 1e-15);
        }
        double sum = 0;
        for (int j = 0; j < n; ++j) sum += sphere_part(SpheresPlaces::kBall, j, n, 1).along.y;
        EXPECT_NEAR(sum, 0, 1e-12);
    }
    EXPECT_EQ(sphere_part(SpheresPlaces::kDome, 0, 7, 1).along.y, 0);
    EXPECT_EQ(sphere_part(SpheresPlaces::kDome, 6, 7, 1).along.y, 1);
}

TEST(SpheresParts, ACloudHasAsManySpheresAsItsPartsSay) {
    for (const std::uint64_t parts : {2, 3, 7, 12}) {
        SpheresCloud cloud = cloud_of(3);
        cloud.parts = parts;
        EXPECT_EQ(most_particles(cloud), parts * parts * parts);
        EXPECT_EQ(particles_of(cloud, request_of(1)).positions.size(), parts * parts * parts);
        EXPECT_EQ(particles_of(cloud, request_of(1, 4)).positions,
                  particles_of(cloud, request_of(1)).positions);
    }
}

// A cross points the same way in every sphere, which is why its cloud is a pyramid of pyramids; turned, it does not.
TEST(SpheresParts, TurnedCrossesPointEveryWay) {
    const auto skewed = [](SpheresPlaces places) {
        SpheresCloud cloud = cloud_of(5);
        cloud.size = glm::dvec3(2);
        cloud.places = places;
        cloud.shift_min = cloud.shift_max = 1.0;  // no way across
        const SphereTree tree(cloud, 3, 0, 0);
        double both = 0, all = 0;
        each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
            const glm::dvec3 way = (c.sphere.center - p.sphere.center) / p.sphere.radius;
            both += std::abs(way.x * way.z);
            all += way.x * way.x + way.z * way.z;
        });
        return both / all;
    };
    EXPECT_LT(skewed(SpheresPlaces::kCross), 1e-12);
    // The mean of |cos sin| is 1/pi; 3,124 parts have theirs.
    EXPECT_NEAR(skewed(SpheresPlaces::kTurned), 1 / std::numbers::pi, 0.02);
}

// --- ratios from 0 to 1, and their distributions

TEST(SpheresParts, RatiosMayBeAnythingFromZeroToOne) {
    SpheresCloud cloud = cloud_of(5);
    cloud.size = glm::dvec3(2e5);
    cloud.ratio_min = 0;
    cloud.ratio_max = 1;
    const SphereTree tree(cloud, 3, 0, 0);
    double low = 1, high = 0;
    each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
        const double ratio = c.sphere.radius / p.sphere.radius;
        low = std::min(low, ratio);
        high = std::max(high, ratio);
        ASSERT_LE(glm::length(c.sphere.center - p.sphere.center) + c.sphere.radius,
                  p.sphere.radius + 1e-9);
    });
    EXPECT_LT(low, 0.002);  // of 3905 draws
    EXPECT_GT(high, 0.998);
    // Nothing is cut for being small: all leaves are there.
    EXPECT_EQ(particles_of(cloud, request_of(1)).positions.size(), 3125u);
    // At 1 a child is its parent.
    cloud.ratio_min = cloud.ratio_max = 1;
    const auto same = particles_of(cloud, request_of(1));
    for (const glm::dvec3& at : same.positions) EXPECT_EQ(at, glm::dvec3(0));
}

// Means and second moments of straight densities, by hand: 1/2 and 1/3; 1/3 and 1/6; 2/3 and 1/2; 1/2 and 7/24; 1/2
// and 3/8.
TEST(SpheresParts, LawsHaveTheMomentsOfTheirDensities) {
    const double means[] = {1.0 / 2, 1.0 / 3, 2.0 / 3, 1.0 / 2, 1.0 / 2};
    const double squares[] = {1.0 / 3, 1.0 / 6, 1.0 / 2, 7.0 / 24, 3.0 / 8};
    for (std::size_t i = 0; i < std::size(kAllLaws); ++i) {
        constexpr int kDraws = 100000;
        double sum = 0, square = 0, before = 0;
        for (int k = 0; k < kDraws; ++k) {
            const double x = at_share(kAllLaws[i], (k + 0.5) / kDraws);
            EXPECT_GE(x, before);
            EXPECT_LE(x, 1);
            before = x;
            sum += x / kDraws;
            square += x * x / kDraws;
        }
        EXPECT_NEAR(sum, means[i], 1e-5) << i;
        EXPECT_NEAR(square, squares[i], 1e-5) << i;
        EXPECT_NEAR(mean_of_power({0, 1}, kAllLaws[i], 1), means[i], 1e-14) << i;
        EXPECT_NEAR(mean_of_power({0, 1}, kAllLaws[i], 2), squares[i], 1e-14) << i;
        // (a + b x)^2 and ^3, expanded.
        const double x3 = mean_of_power({0, 1}, kAllLaws[i], 3);
        EXPECT_NEAR(mean_of_power({0.2, 0.7}, kAllLaws[i], 3),
                    0.008 + 3 * 0.04 * 0.5 * means[i] + 3 * 0.2 * 0.25 * squares[i] + 0.125 * x3,
                    1e-14)
            << i;
    }
}

// What is drawn for spheres that are cut, against many clouds: the moments of two levels by brute force.
TEST(SpheresParts, ExpectedMomentsAreThoseOfManyClouds) {
    for (const SpheresPlaces places : kAllPlaces) {
        SpheresCloud cloud = cloud_of(3);
        cloud.size = glm::dvec3(2);
        cloud.parts = 7;
        cloud.places = places;
        cloud.ratio_min = 0;
        cloud.ratio_max = 0.8;
        cloud.ratio_law = SpheresLaw::kRising;
        cloud.shift_law = SpheresLaw::kEnds;
        const int kClouds = 3000;
        double mass = 0, square_mass = 0, second = 0;
        glm::dvec3 moment(0);
        for (int i = 0; i < kClouds; ++i) {
            const SphereTree tree(cloud, static_cast<std::uint64_t>(i), 0, 0);
            double own = 0;
            each_pair(tree, tree.root(), 0, [&](const SphereNode&, const SphereNode& c, int level) {
                if (level != 1) return;
                const double m = std::pow(c.sphere.radius, 3);
                own += m;
                moment += m * c.sphere.center;
                second += m * (glm::dot(c.sphere.center, c.sphere.center) +
                               3 * kLeafVariance * c.sphere.radius * c.sphere.radius);
            });
            mass += own;
            square_mass += own * own;
        }
        const ClusterMoments expected = cluster_moments(SphereTree(cloud, 1, 0, 0))[2];
        const double spread = std::sqrt(square_mass / kClouds - mass / kClouds * mass / kClouds) /
                              std::sqrt(kClouds) / (mass / kClouds) * 5;
        EXPECT_NEAR(mass / kClouds / expected.mass, 1, spread);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(moment[axis] / mass, expected.mean[axis], spread) << axis;
        EXPECT_NEAR(second / mass / expected.square, 1, spread);
    }
}

// --- motion

SpheresPose pose(double time, const glm::dvec3& shift, const glm::dvec3& turn,
                 const glm::dvec3& scale) {
    return {time, shift, turn, scale};
}

TEST(SpheresParts, PosesGoLinearlyAndStayAtTheirEnds) {
    const std::vector<SpheresPose> poses = {pose(1, {0, 0, 0}, {0, 0, 0}, glm::dvec3(1)),
                                            pose(3, {10, 4, 2}, {0, 90, 0}, {2, 4, 6})};
    EXPECT_EQ(pose_at(poses, -5).shift, glm::dvec3(0));
    EXPECT_EQ(pose_at(poses, 1.5).shift, glm::dvec3(2.5, 1, 0.5));
    EXPECT_EQ(pose_at(poses, 2).turn, glm::dvec3(0, 45, 0));
    EXPECT_EQ(pose_at(poses, 2).scale, glm::dvec3(1.5, 2.5, 3.5));
    EXPECT_EQ(pose_at(poses, 9).scale, glm::dvec3(2, 4, 6));
    EXPECT_EQ(pose_at({}, 9).scale, glm::dvec3(1));
}

// The affine transformations of the source: "rotation and translation require only to recalculate the coordinates of
// spheres center, and scaling will require an additional conversion of radii". p -> shift + s R p, r -> s r.
TEST(SpheresParts, APoseMovesEverySphereAsAWhole) {
    SpheresCloud still = cloud_of(4);
    still.places = SpheresPlaces::kDome;
    SpheresCloud moved = still;
    moved.poses = {pose(0, {0, 0, 0}, {0, 0, 0}, glm::dvec3(1)),
                   pose(10, {100, -20, 7}, {30, 60, -45}, glm::dvec3(3))};
    const auto before = particles_of(still, request_of(4));
    ModelRequest request = request_of(4);
    request.time = 5;
    const auto after = particles_of(moved, request);
    ASSERT_EQ(before.positions.size(), after.positions.size());
    const glm::dmat3 turn = rotation_of({15, 30, -22.5});
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const glm::dvec3 there = glm::dvec3(50, -10, 3.5) + 2.0 * (turn * before.positions[i]);
        ASSERT_LT(glm::length(after.positions[i] - there), 1e-9);
        ASSERT_NEAR(after.radii[i] / before.radii[i], 2, 1e-6);
    }
    EXPECT_NE(turn, glm::dmat3(1));
}

// Unlike scales squeeze the cloud by the rule of its sides: it is the cloud of sides that are so much larger.
TEST(SpheresParts, UnlikeScalesAreThoseOfTheSides) {
    SpheresCloud stretched = cloud_of(3), wide = cloud_of(3);
    stretched.poses = {pose(0, {0, 0, 0}, {0, 0, 0}, {2, 0.5, 1})};
    wide.size = stretched.size * glm::dvec3(2, 0.5, 1);
    EXPECT_EQ(particles_of(stretched, request_of(2)).positions,
              particles_of(wide, request_of(2)).positions);
}

TEST(SpheresParts, RotationsTurnAboutTheirAxisByTheirLength) {
    const glm::dmat3 about_y = rotation_of({0, 90, 0});
    EXPECT_LT(glm::length(about_y * glm::dvec3(0, 0, 1) - glm::dvec3(1, 0, 0)), 1e-15);
    test::Dice dice(3);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 turn = dice.any_vector(400);
        const glm::dmat3 r = rotation_of(turn);
        EXPECT_LT(glm::length(r * turn - turn), 1e-9);
        EXPECT_NEAR(glm::determinant(r), 1, 1e-12);
        EXPECT_NEAR(r[0][0] + r[1][1] + r[2][2],
                    1 + 2 * std::cos(glm::length(turn) * std::numbers::pi / 180), 1e-10);
    }
}

// Turning moves centres alone: radii stay, every sphere stays in its parent, and at time 0 nothing has turned.
TEST(SpheresParts, PartsTurnWithinTheirSpheres) {
    SpheresCloud cloud = cloud_of(4);
    cloud.places = SpheresPlaces::kDome;
    const auto still = particles_of(cloud, request_of(1));
    cloud.turning = 20;
    EXPECT_EQ(particles_of(cloud, request_of(1)).positions, still.positions);
    ModelRequest later = request_of(1);
    later.time = 3;
    const auto turned = particles_of(cloud, later);
    EXPECT_EQ(turned.radii, still.radii);
    double most = 0;
    for (std::size_t i = 0; i < still.positions.size(); ++i) {
        most = std::max(most, glm::length(turned.positions[i] - still.positions[i]));
        EXPECT_EQ(turned.positions[i].y, still.positions[i].y);
    }
    EXPECT_GT(most, 10);
    const SphereTree tree(cloud, 1, 0, 3);
    each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
        ASSERT_LE(glm::length(c.sphere.center - p.sphere.center) + c.sphere.radius,
                  p.sphere.radius * (1 + 1e-12));
    });
}

}  // namespace
}  // namespace awan
