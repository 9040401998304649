// What density a cloud gets that is given none: closed forms, the survey's optical depths, laws.
#include "core/generate/auto_density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/automaton/cells.h"
#include "core/generate/generate.h"
#include "core/generate/keyed_random.h"
#include "core/pipeline.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/spheres.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

const double kRootTwoPi = std::sqrt(2 * std::numbers::pi);

Cloud one_particle(double radius) {
    Cloud cloud;
    cloud.model = CloudModel::kParticles;
    cloud.ready.positions = {{3, 4, 5}};
    cloud.ready.radii = {static_cast<float>(radius)};
    return cloud;
}

Cloud box(std::uint64_t particles, const glm::dvec3& size, double radius) {
    Cloud cloud;
    cloud.cubes = {{particles, size, {0, 1, 0}, radius, 1, {}}};
    return cloud;
}

double density(const Cloud& cloud) {
    return auto_density(cloud, Fill::kUniform, 7);
}

Scene scene_of(const Cloud& cloud, double time) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds = {cloud};
    draft.time = time;
    const auto scene = validate(draft);
    EXPECT_TRUE(scene.ok());
    return *scene;
}

Survey surveyed(const Cloud& cloud, double time = 0) {
    const Scene scene = scene_of(cloud, time);
    return *survey(scene, *generate(scene, 2, Deadline{}), 2, Deadline{});
}

TEST(AutoDensity, OfOneParticleIsTheClosedForm) {
    // Its depth is density s sqrt(2 pi) through the middle, and half of that on average over its mass. Three digits.
    for (const double radius : {0.002, 1.0, 370.0})
        EXPECT_NEAR(density(one_particle(radius)) * radius / 2 * kRootTwoPi / 2, kAutoDepth,
                    0.006 * kAutoDepth);
}

TEST(AutoDensity, OfAFlatLayerIsByItsThickness) {
    // 20 000 particles of radius 0..1 over 100 x 100: a column of density * n / area * (2 pi)^1.5 <s^3>, where
    // <s^3> = 1/8 * 1/4; the rim is thinner. Sideways it is far deeper, which does not count.
    const double column = 20000 / 1e4 * std::pow(kRootTwoPi, 3) / 32;
    EXPECT_NEAR(density(box(20000, {100, 1, 100}, 1)), kAutoDepth / column,
                0.12 * kAutoDepth / column);
}

TEST(AutoDensity, MakesPlainLayoutsDeep) {
    const Cloud layouts[] = {box(2000, {7.4, 2, 4}, 0.8), box(100, {2, 1, 2}, 0.5),
                             box(1, {1, 1, 1}, 1), box(50, {300, 300, 300}, 120),
                             box(300000, {10, 10, 10}, 0.3)};
    for (const Cloud& cloud : layouts) {
        const Survey seen = surveyed(cloud);
        EXPECT_GT(seen.optical_depth_zenith, 22);
        EXPECT_LT(seen.optical_depth_zenith, 100);
        ASSERT_EQ(seen.cloud_density.size(), 1u);
    }
}

TEST(AutoDensity, IsTheSameHoweverTheCloudStandsAndAtAllTimes) {
    Cloud cloud = box(500, {4, 2, 3}, 0.7);
    cloud.velocity = {1.1, 0, 0.3};
    const double here = surveyed(cloud).cloud_density[0];
    EXPECT_EQ(surveyed(cloud, 1e5).cloud_density[0], here);
    cloud.translate = {1e6, 3, 7};
    cloud.rotate_y = 33;
    EXPECT_EQ(surveyed(cloud).cloud_density[0], here);
    // Twice as large it would be twice as deep.
    cloud.scale = 2;
    EXPECT_NEAR(surveyed(cloud).cloud_density[0], here / 2, 0.006 * here);
}

TEST(AutoDensity, OfASampleIsThatOfAllParticles) {
    // The same cloud of 256 and of 256 000 particles: the latter are looked at one in a thousand.
    const double few = density(box(256, {4, 2, 3}, 0.7)),
                 many = density(box(256000, {4, 2, 3}, 0.7));
    EXPECT_NEAR(many * 1000 / few, 1, 0.2);
}

TEST(AutoDensity, StaysWithinWhatAParticleMayHave) {
    EXPECT_EQ(density(one_particle(2e-6)), limits::kMaxDensity);
    Cloud cloud = box(3, {1, 1, 1}, 1);
    cloud.cubes[0].density = limits::kMaxDensity;
    cloud.cubes.push_back({9, {1, 1, 1}, {50, 0, 0}, 1e-6, 1e-9, {}});
    EXPECT_LE(density(cloud) * limits::kMaxDensity, limits::kMaxDensity * (1 + 1e-9));
    EXPECT_GT(density(cloud), 0);
    // Without matter.
    for (Cube& cube : cloud.cubes) cube.density = 0;
    EXPECT_EQ(density(cloud), kDefaultDensity);
    cloud.cubes.clear();
    EXPECT_EQ(density(cloud), kDefaultDensity);
}

// By its description alone; its cells, once they have grown, are that deep within a factor of two.
TEST(AutoDensity, OfAnAutomatonMakesWhatGrowsAsDeepAsOthers) {
    const auto automaton = [](double cell, double height, double humidity, double extinction) {
        AutomatonCloud one;
        one.cells = {160, 40, 160};
        one.cell = cell;
        one.random = RandomEllipsoids{24, {5, height / 2, 5}, {18, height, 18}, 5.0};
        one.humidity = humidity;
        one.extinction = extinction;
        return one;
    };
    for (const AutomatonCloud& one :
         {automaton(5, 13, 0.1, 0.12), automaton(1, 13, 0.1, 0.12), automaton(5, 6, 0.1, 0.12),
          automaton(3, 30, 0.12, 0.06), automaton(2, 10, 0.05, 0.2)}) {
        Cloud cloud;
        cloud.model = CloudModel::kAutomaton;
        cloud.automaton = std::make_shared<const AutomatonCloud>(one);
        const std::uint64_t key = keyed(1, 0);
        const double density = auto_density(cloud, Fill::kUniform, key);
        ModelRequest request;
        request.key = key;
        const auto cells = automaton::cells_of(one, request, true, {});
        ASSERT_TRUE(cells.ok());
        std::map<std::pair<int, int>, double> columns;
        for (const automaton::Cell& at : *cells)
            columns[{at.i, at.k}] += static_cast<double>(at.density) * one.cell * density;
        double mass = 0, squares = 0;
        for (const auto& [place, depth] : columns) mass += depth, squares += depth * depth;
        EXPECT_GT(squares / mass, kAutoDepth / 2) << one.cell << " " << one.humidity;
        EXPECT_LT(squares / mass, kAutoDepth * 2) << one.cell << " " << one.humidity;
        // A cloud made twice as large is twice as deep.
        cloud.scale = 2;
        EXPECT_NEAR(auto_density(cloud, Fill::kUniform, key), density / 2, 0.01 * density);
    }
    // Nothing grows.
    Cloud cloud;
    cloud.model = CloudModel::kAutomaton;
    AutomatonCloud none;
    none.activation = 0;
    cloud.automaton = std::make_shared<const AutomatonCloud>(none);
    EXPECT_EQ(auto_density(cloud, Fill::kUniform, 1), kDefaultDensity);
}

// The mean depth along an axis, weighted by mass, of what a scene shows: of lines evenly through its bounds.
double mean_depth_of(const Cloud& cloud, double time, int axis) {
    const auto set = generate(scene_of(cloud, time), 2, Deadline{});
    EXPECT_TRUE(set.ok());
    const Bounds bounds = bounds_of(*set);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    constexpr int kLines = 75;
    const double du = (bounds.max[u] - bounds.min[u]) / kLines;
    const double dv = (bounds.max[v] - bounds.min[v]) / kLines;
    std::vector<double> depths(kLines * kLines);
    for (std::size_t n = 0; n < set->size(); ++n) {
        const double s = static_cast<double>(set->radius[n]) / 2;
        const double depth = static_cast<double>(set->density[n]) * s * kRootTwoPi;
        const double a = set->center[n][u] - bounds.min[u], b = set->center[n][v] - bounds.min[v];
        const auto first = [&](double at, double step) {
            return std::max(static_cast<int>((at - 4 * s) / step), 0);
        };
        for (int i = first(a, du); i < kLines && (i - 1) * du < a + 4 * s; ++i)
            for (int j = first(b, dv); j < kLines && (j - 1) * dv < b + 4 * s; ++j) {
                const double x = (i + .5) * du - a, y = (j + .5) * dv - b;
                depths[static_cast<std::size_t>(i * kLines + j)] +=
                    depth * std::exp(-(x * x + y * y) / (2 * s * s));
            }
    }
    double sum = 0, squares = 0;
    for (const double depth : depths) sum += depth, squares += depth * depth;
    return squares / sum;
}

Cloud procedural(CloudModel model) {
    Cloud cloud;
    cloud.model = model;
    cloud.auto_density = true;
    if (model == CloudModel::kImplicit) cloud.implicit = std::make_shared<const ImplicitCloud>();
    if (model == CloudModel::kSpheres) cloud.spheres = std::make_shared<const SpheresCloud>();
    if (model == CloudModel::kEllipsoids) {
        auto own = std::make_shared<EllipsoidsCloud>();
        own->formations.emplace_back();
        cloud.ellipsoids = own;
    }
    return cloud;
}

// A cloud of any model that says "auto" is 24 deep in the mean along its thinnest axis.
TEST(AutoDensity, OfACloudThatAsksForItWhateverItsModel) {
    for (const CloudModel model :
         {CloudModel::kImplicit, CloudModel::kSpheres, CloudModel::kEllipsoids}) {
        const Cloud cloud = procedural(model);
        double least = 1e300;
        for (int axis = 0; axis < 3; ++axis) least = std::min(least, mean_depth_of(cloud, 0, axis));
        EXPECT_GT(least, 0.65 * kAutoDepth) << static_cast<int>(model);
        EXPECT_LT(least, 1.5 * kAutoDepth) << static_cast<int>(model);
        // A cloud made twice as large is twice as deep. And the scene's "auto" leaves it at the default.
        const double here = surveyed(cloud).cloud_density[0];
        Cloud large = cloud;
        large.scale = 2;
        EXPECT_NEAR(surveyed(large).cloud_density[0], here / 2, 0.01 * here);
        large.auto_density = false;
        EXPECT_EQ(surveyed(large).cloud_density[0], kDefaultDensity);
    }
}

// A cloud that grows has one density at all times, and from all eyes.
TEST(AutoDensity, OfAGrowthIsTheSameAtAllTimes) {
    Cloud cloud = procedural(CloudModel::kImplicit);
    auto own = std::make_shared<ImplicitCloud>();
    own->growth = ImplicitGrowth{};
    cloud.implicit = own;
    const double grown = surveyed(cloud, 60).cloud_density[0];
    EXPECT_EQ(surveyed(cloud, 3).cloud_density[0], grown);
    EXPECT_GT(mean_depth_of(cloud, 60, 1), 0.5 * kAutoDepth);
    EXPECT_LT(mean_depth_of(cloud, 3, 1), mean_depth_of(cloud, 60, 1));
}

TEST(AutoDensity, GivesWayToWhatIsGiven) {
    Cloud cloud = box(10, {1, 1, 1}, 1);
    cloud.density = 0.75;
    EXPECT_EQ(surveyed(cloud).cloud_density[0], 0.75);
}

}  // namespace
}  // namespace awan
