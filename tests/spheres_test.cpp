// The hierarchy of spheres of Ostroushko et al. and the Gaussians made of it.
#include "core/scene/spheres.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "core/generate/generate.h"
#include "core/generate/models.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/cut.h"
#include "core/generate/spheres/subdivision.h"
#include "core/scene/limits.h"
#include "tests/random_models_spheres.h"
#include "tests/scenes.h"
#include "tests/spheres_clouds.h"

namespace awan {
namespace {

using spheres::child_offset;
using spheres::cluster_blob;
using spheres::cluster_moments;
using spheres::ClusterMoments;
using spheres::GaussianBlob;
using spheres::kLeafMass;
using spheres::kLeafVariance;
using spheres::leaf_blob;
using spheres::other_coordinate;
using spheres::other_coordinate_printed;
using spheres::SphereDraw;
using spheres::SphereNode;
using spheres::SphereTree;

using test::cloud_of;
using test::particles_of;
using test::request_of;

double mass_of(const ReadyParticles& set) {
    double mass = 0;
    for (std::size_t i = 0; i < set.radii.size(); ++i)
        mass += static_cast<double>(set.densities[i]) *
                std::pow(static_cast<double>(set.radii[i]) / 2, 3);
    return mass * std::pow(2 * std::numbers::pi, 1.5);
}

// Calls check(parent, child, level of the parent) for all of the tree.
template <typename Check>
void each_pair(const SphereTree& tree, const SphereNode& node, int level, const Check& check) {
    if (level == tree.levels()) return;
    for (const SphereNode& child : tree.children(node, level)) {
        check(node, child, level);
        each_pair(tree, child, level + 1, check);
    }
}

// --- subdivision

// The law that makes every sphere a bounding volume. Rounding: three additions of numbers no larger than the parent's
// place.
TEST(Spheres, EveryChildLiesInItsParent) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        test::Dice dice(seed);
        const Cloud cloud = test::random_spheres(dice, {glm::dvec3(0), 100});
        const double time = dice.between(0, 20);
        const SphereTree tree(*cloud.spheres, seed, 0, time);
        const double rounding = 1e-14 * tree.root().sphere.radius;
        each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
            ASSERT_LE(glm::length(c.sphere.center - p.sphere.center) + c.sphere.radius,
                      p.sphere.radius + rounding)
                << seed;
            ASSERT_GT(c.sphere.radius, 0);
        });
    }
}

// Unscaled, a corrected child touches its parent from within: (s D)^2 + f(s D, D)^2 = D^2.
TEST(Spheres, ChildrenTouchTheirParentWhereAxesAreNotScaled) {
    SpheresCloud cloud = cloud_of(4);
    cloud.size = glm::dvec3(2);
    const SphereTree tree(cloud, 5, 0, 0);
    each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
        ASSERT_NEAR(glm::length(c.sphere.center - p.sphere.center) + c.sphere.radius,
                    p.sphere.radius, 1e-14);
    });
}

TEST(Spheres, TheFiveGoWhereTheSourceSays) {
    const SphereDraw draw{0.4, 0.95, 1};
    const glm::dvec3 axes(1, 0.5, 0.25), across(1);
    const double along = 0.95 * 0.6, aside = std::sqrt(0.6 * 0.6 - along * along);
    EXPECT_EQ(child_offset(0, draw, axes, across, 1), glm::dvec3(along, 0, aside));
    EXPECT_EQ(child_offset(1, draw, axes, across, 1), glm::dvec3(-along, 0, aside));
    EXPECT_EQ(child_offset(2, draw, axes, across, 1), glm::dvec3(aside, 0, along * 0.25));
    EXPECT_EQ(child_offset(3, draw, axes, across, 1), glm::dvec3(aside, 0, -along * 0.25));
    EXPECT_EQ(child_offset(4, draw, axes, across, -1), glm::dvec3(0, -along * 0.5, aside));
    const SphereDraw other{0.4, 0.95, -1};
    EXPECT_EQ(child_offset(4, other, axes, across, -1), glm::dvec3(-aside, -along * 0.5, 0));
}

// Without its root the printed f is an area: the same cloud drawn ten times as large throws its children ten times as
// far, in parents' radii, and out of their parents. The fifth's f(s, D) is not even an area.
TEST(Spheres, ThePrintedCoordinateLeavesTheParent) {
    const double s = 0.9, ratio = 0.26;
    const auto reach = [&](double radius, auto f) {
        const double most = radius * (1 - ratio);
        return std::hypot(s * most, f(s * most, most)) / radius;
    };
    EXPECT_LE(reach(100, other_coordinate), 1 - ratio + 1e-12);
    EXPECT_DOUBLE_EQ(reach(1, other_coordinate), reach(1000, other_coordinate));
    EXPECT_GT(reach(100, other_coordinate_printed), 10);
    EXPECT_LT(reach(0.01, other_coordinate_printed), s * (1 - ratio) + 1e-4);
    EXPECT_LT(other_coordinate_printed(s, 0.5), 0);  // s against a D of .5: no place at all
}

TEST(Spheres, AxesAreScaledAtTheFirstStepOnlyOrAtEvery) {
    SpheresCloud cloud = cloud_of(3);
    cloud.size = {10, 2, 6};
    EXPECT_EQ(SphereTree(cloud, 1, 0, 0).axes(0), glm::dvec3(1, 0.2, 0.6));
    EXPECT_EQ(SphereTree(cloud, 1, 0, 0).axes(1), glm::dvec3(1));
    cloud.scaling = SpheresScaling::kEvery;
    EXPECT_EQ(SphereTree(cloud, 1, 0, 0).axes(1), glm::dvec3(1, 0.2, 0.6));
}

// Scaled at every step, all centres stay within the cloud's sides; scaled at the first they do not, for a flat cloud.
TEST(Spheres, OnlyScalingAtEveryStepKeepsAFlatCloudFlat) {
    const auto highest = [](SpheresScaling scaling) {
        double most = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SpheresCloud cloud = cloud_of(4);
            cloud.size = {100, 5, 100};
            cloud.scaling = scaling;
            const SphereTree tree(cloud, seed, 0, 0);
            each_pair(tree, tree.root(), 0, [&](const SphereNode&, const SphereNode& c, int) {
                most = std::max(most, std::abs(c.sphere.center.y));
            });
        }
        return most;
    };
    EXPECT_LE(highest(SpheresScaling::kEvery), 2.5);
    EXPECT_GT(highest(SpheresScaling::kFirst), 10);
}

TEST(Spheres, RatiosAndShiftsFillTheirRanges) {
    SpheresCloud cloud = cloud_of(5);
    cloud.size = glm::dvec3(2);
    const SphereTree tree(cloud, 3, 0, 0);
    double low = 1, high = 0, sum = 0, count = 0;
    each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
        const double ratio = c.sphere.radius / p.sphere.radius;
        low = std::min(low, ratio);
        high = std::max(high, ratio);
        sum += ratio;
        ++count;
    });
    EXPECT_GE(low, 0.26);
    EXPECT_LE(high, 0.76);
    EXPECT_LT(low, 0.262);  // of 3905 draws; the chance of none in .002 of .5 is 2e-7
    EXPECT_GT(high, 0.758);
    EXPECT_NEAR(sum / count, 0.51, 0.5 / std::sqrt(12.0) / std::sqrt(count) * 5);  // five sigma
}

TEST(Spheres, GrowsUpwardOrAsPrinted) {
    for (const bool up : {true, false}) {
        SpheresCloud cloud = cloud_of(4);
        cloud.growth = up ? SpheresGrowth::kUp : SpheresGrowth::kDown;
        const SphereTree tree(cloud, 8, 0, 0);
        double sum = 0;
        each_pair(tree, tree.root(), 0, [&](const SphereNode& p, const SphereNode& c, int) {
            const double rise = c.sphere.center.y - p.sphere.center.y;
            EXPECT_GE(up ? rise : -rise, 0);
            sum += rise;
        });
        EXPECT_NE(sum, 0);
    }
}

// --- particles

TEST(Spheres, AsManyLeavesAsTheSourceCounts) {
    std::uint64_t expected = 1;
    for (std::uint64_t levels = 0; levels <= 7; ++levels, expected *= 5) {
        EXPECT_EQ(particles_of(cloud_of(levels), request_of(1)).positions.size(), expected);
        EXPECT_EQ(most_particles(cloud_of(levels)), expected);
    }
    EXPECT_EQ(most_particles(cloud_of(10)), limits::kMaxSpheresParticles);
}

TEST(Spheres, NoLevelsIsOneSphereOfTheShortestSide) {
    SpheresCloud cloud = cloud_of(0);
    cloud.size = {8, 4, 6};
    ModelRequest request = request_of(1);
    request.density = 0.5;
    const ReadyParticles set = particles_of(cloud, request);
    ASSERT_EQ(set.positions.size(), 1u);
    EXPECT_EQ(set.positions[0], glm::dvec3(0));
    EXPECT_NEAR(set.radii[0], 2 * 2 * std::sqrt(kLeafVariance), 1e-6);
    EXPECT_NEAR(mass_of(set), kLeafMass * 0.5 * 8, 1e-5);
}

// The two constants against sums over the disc of rule (3)'s thin limit, depth f sigma l.
TEST(Spheres, ALeafHasTheMassAndWidthOfTheSourcesRule) {
    double mass = 0, square = 0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
        const double d = (i + 0.5) / kSteps, depth = (1 - d) * 2 * std::sqrt(1 - d * d);
        mass += 2 * std::numbers::pi * d * depth / kSteps;
        square += 2 * std::numbers::pi * d * d * d * depth / kSteps;
    }
    EXPECT_NEAR(kLeafMass, mass, 1e-8);
    EXPECT_NEAR(kLeafVariance, square / mass / 2, 1e-8);
    const GaussianBlob blob = leaf_blob({glm::dvec3(1, 2, 3), 5});
    EXPECT_NEAR(blob.peak * std::pow(2 * std::numbers::pi, 1.5) * std::pow(blob.s, 3) / 125,
                kLeafMass, 1e-12);
}

TEST(Spheres, VisualRangeIsWhereTwoPercentAreLeft) {
    SpheresCloud cloud = cloud_of(3);
    cloud.visual_range = 40;
    ModelRequest request = request_of(4);
    request.density = 123;  // not used then
    const double ranged = mass_of(particles_of(cloud, request));
    cloud.visual_range.reset();
    request.density = -std::log(0.02) / 40;  // exp(-density * 40) = .02
    // Float32 densities.
    EXPECT_NEAR(mass_of(particles_of(cloud, request)) / ranged, 1, 1e-6);
}

TEST(Spheres, ExpectedMomentsAreThoseOfManyClouds) {
    SpheresCloud cloud = cloud_of(4);
    cloud.size = glm::dvec3(2);
    for (const SpheresKind kind : {SpheresKind::kCumulus, SpheresKind::kCirrus}) {
        cloud.kind = kind;
        const int kClouds = 4000;
        double mass = 0, square_mass = 0;
        glm::dvec3 moment(0);
        double second = 0;
        for (int i = 0; i < kClouds; ++i) {
            const SphereTree tree(cloud, static_cast<std::uint64_t>(i), 0, 0);
            double own = 0;
            // Three levels below the root: the moments of n = 3 by brute force.
            each_pair(tree, tree.root(), 0, [&](const SphereNode&, const SphereNode& c, int level) {
                if (level != 2) return;
                const double m = std::pow(c.sphere.radius, 3);
                own += m;
                moment += m * c.sphere.center;
                second += m * (glm::dot(c.sphere.center, c.sphere.center) +
                               3 * kLeafVariance * c.sphere.radius * c.sphere.radius);
            });
            mass += own;
            square_mass += own * own;
        }
        const ClusterMoments expected = cluster_moments(SphereTree(cloud, 1, 0, 0))[3];
        // Five standard errors of the mean mass; its share for the other moments.
        const double spread = std::sqrt(square_mass / kClouds - mass / kClouds * mass / kClouds) /
                              std::sqrt(kClouds) / (mass / kClouds) * 5;
        EXPECT_NEAR(mass / kClouds / expected.mass, 1, spread);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(moment[axis] / mass, expected.mean[axis], spread) << axis;
        EXPECT_NEAR(second / mass / expected.square, 1, spread);
    }
}

// With one ratio and one shift all that is left to chance is each sphere's side: its two are tried in turn. Exact.
TEST(Spheres, ExpectedMomentsAreTheMeansOverAllSides) {
    SpheresCloud cloud = cloud_of(4);
    cloud.size = glm::dvec3(2);
    const double ratio = 0.55, shift = 0.6;
    cloud.ratio_min = cloud.ratio_max = ratio;
    cloud.shift_min = cloud.shift_max = shift;
    const SphereTree tree(cloud, 1, 0, 0);
    std::vector<glm::dvec3> offsets;  // of ten children, two in each place, in radii of the parent
    for (int j = 0; j < spheres::kSphereChildren; ++j)
        for (const double side : {-1.0, 1.0})
            offsets.push_back(
                child_offset(j, {ratio, shift, side}, glm::dvec3(1), glm::dvec3(1), tree.up()));
    glm::dvec3 mean(0);
    double square = 0;
    for (const glm::dvec3& a : offsets)
        for (const glm::dvec3& b : offsets) {
            const glm::dvec3 at = a + ratio * b;
            mean += at / 100.0;
            square += (glm::dot(at, at) + 3 * kLeafVariance * std::pow(ratio, 4)) / 100;
        }
    const ClusterMoments moments = cluster_moments(tree)[2];
    EXPECT_NEAR(moments.mass, std::pow(5 * ratio * ratio * ratio, 2), 1e-12);
    EXPECT_NEAR(moments.square, square, 1e-12);
    EXPECT_LT(glm::length(moments.mean - mean), 1e-12);
    EXPECT_GT(glm::length(mean), 0.05);  // so that the square of a sum is not a sum of squares
}

// Of clusters that are not round about their spheres' middles: the sums over all of them, place by place.
TEST(Spheres, AClusterOfClustersKeepsItsMoments) {
    const SphereTree tree(cloud_of(5), 9, 0, 0);
    const auto children = tree.children(tree.children(tree.root(), 0)[3], 1);
    const ClusterMoments below{2.5, {0.1, 0.3, -0.2}, 0.8};
    const GaussianBlob blob = cluster_blob(children, below);
    double mass = 0, square = 0;
    glm::dvec3 mean(0);
    for (const SphereNode& node : children) {
        const double r = node.sphere.radius, own = r * r * r * below.mass;
        const glm::dvec3 middle = node.sphere.center + r * below.mean;
        // Steiner: about the cluster's own middle, and that about the origin.
        const double about = r * r * (below.square - glm::dot(below.mean, below.mean));
        mass += own;
        mean += own * middle;
        square += own * (about + glm::dot(middle, middle));
    }
    mean /= mass;
    EXPECT_LT(glm::length(blob.center - mean), 1e-12);
    EXPECT_NEAR(3 * blob.s * blob.s / (square / mass - glm::dot(mean, mean)), 1, 1e-9);
    EXPECT_NEAR(
        blob.peak * std::pow(2 * std::numbers::pi, 1.5) * std::pow(blob.s, 3) / (kLeafMass * mass),
        1, 1e-12);
}

// A cluster of five leaves keeps mass, centre of mass and mean square exactly; 1e-12 is rounding.
TEST(Spheres, AClusterOfLeavesKeepsItsMoments) {
    const SphereTree tree(cloud_of(2), 9, 0, 0);
    const auto children = tree.children(tree.children(tree.root(), 0)[3], 1);
    const GaussianBlob blob = cluster_blob(children, ClusterMoments{});
    double mass = 0, square = 0;
    glm::dvec3 mean(0);
    for (const SphereNode& node : children) {
        const double m = std::pow(node.sphere.radius, 3);
        mass += m;
        mean += m * node.sphere.center;
    }
    mean /= mass;
    for (const SphereNode& node : children) {
        const double m = std::pow(node.sphere.radius, 3);
        const glm::dvec3 v = node.sphere.center - mean;
        square +=
            m * (glm::dot(v, v) + 3 * kLeafVariance * node.sphere.radius * node.sphere.radius);
    }
    EXPECT_NEAR(glm::length(blob.center - mean) / glm::length(mean), 0, 1e-12);
    EXPECT_NEAR(3 * blob.s * blob.s / (square / mass), 1, 1e-12);
    EXPECT_NEAR(
        blob.peak * std::pow(2 * std::numbers::pi, 1.5) * std::pow(blob.s, 3) / (kLeafMass * mass),
        1, 1e-12);
}

}  // namespace
}  // namespace awan
