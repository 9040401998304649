// Implicit clouds as particles: through generate(), as every caller gets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "core/draw/picture_difference.h"
#include "core/generate/generate.h"
#include "core/generate/implicit/sampling.h"
#include "core/generate/keyed_random.h"
#include "core/generate/models.h"
#include "core/pipeline.h"
#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "tests/implicit_clouds.h"
#include "tests/random_models_implicit.h"

namespace awan {
namespace {

using implicit::Box;
using implicit::box_of;
using implicit::finer;
using implicit::ImplicitField;
using implicit::lattice_over;
using implicit::limit_octaves;
using implicit::prepare_field;
using implicit::sample;
using implicit::take_means;

Scene scene_of(Cloud cloud, double time = 0) {
    SceneDraft draft = test::plain_draft();
    draft.top_level_cubes = false;
    draft.clouds.push_back(std::move(cloud));
    draft.time = time;
    Result<Scene> scene = validate(std::move(draft));
    EXPECT_TRUE(scene.ok()) << scene.error().pointer << ": " << scene.error().message;
    return *scene;
}

Scene scene_of(const ImplicitCloud& implicit, double time = 0) {
    Cloud cloud;
    cloud.model = CloudModel::kImplicit;
    cloud.implicit = std::make_shared<ImplicitCloud>(implicit);
    return scene_of(cloud, time);
}

ImplicitCloud of_preset(ImplicitPreset preset, std::uint64_t resolution) {
    ImplicitCloud cloud;
    cloud.preset = preset;
    cloud.resolution = resolution;
    return cloud;
}

ParticleSet particles_of(const Scene& scene, int threads = 2, bool coarse = false) {
    Result<ParticleSet> set = generate(scene, threads, {}, coarse);
    EXPECT_TRUE(set.ok());
    return *set;
}

// As implicit::make_particles() samples it.
void fill(const ImplicitCloud& cloud, std::uint64_t key, LatticeField& lattice) {
    ImplicitField field = prepare_field(cloud, key, 0);
    limit_octaves(cloud, key, 0, lattice.cell, field);
    EXPECT_FALSE(sample(field, 2, {}, lattice));
    LatticeField fine = finer(lattice);
    limit_octaves(cloud, key, 0, fine.cell, field);
    EXPECT_FALSE(sample(field, 2, {}, fine, &lattice));
    take_means(fine, 2, lattice);
}

void expect_equal(const ParticleSet& a, const ParticleSet& b) {
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.error, b.error);
}

TEST(ImplicitParticles, TheSameBytesOnAnyNumberOfThreadsAndFramesInAnyOrder) {
    for (int preset = 0; preset < 5; ++preset) {
        ImplicitCloud cloud = of_preset(static_cast<ImplicitPreset>(preset), 40);
        const ParticleSet one = particles_of(scene_of(cloud, 3), 1);
        EXPECT_GT(one.size(), 100u);
        particles_of(scene_of(cloud, 8), 1);
        for (const int threads : {2, 7})
            expect_equal(one, particles_of(scene_of(cloud, 3), threads));
    }
}

TEST(ImplicitParticles, KeepTheFieldsMass) {
    for (int preset = 0; preset < 5; ++preset) {
        const ImplicitCloud cloud = of_preset(static_cast<ImplicitPreset>(preset), 40);
        const Scene scene = scene_of(cloud);
        const ParticleSet set = particles_of(scene);
        const std::uint64_t key = keyed(scene->seed, 0);
        LatticeField lattice = lattice_over(prepare_field(cloud, key, 0), 40);
        fill(cloud, key, lattice);
        double mass = 0;
        for (std::size_t i = 0; i < set.size(); ++i)
            mass +=
                static_cast<double>(set.density[i]) *
                std::pow(std::sqrt(2 * std::numbers::pi) * static_cast<double>(set.radius[i]) / 2,
                         3);
        // Floats, one for each particle.
        EXPECT_NEAR(mass / (kDefaultDensity * lattice_mass(lattice)), 1, 1e-6) << preset;
    }
}

TEST(ImplicitParticles, CoarseOnesAreFewAndLieWhereTheOthersDo) {
    for (int preset = 0; preset < 5; ++preset) {
        const Scene scene = scene_of(of_preset(static_cast<ImplicitPreset>(preset), 64));
        const Bounds fine = bounds_of(particles_of(scene)),
                     coarse = bounds_of(particles_of(scene, 2, true));
        EXPECT_LE(particles_of(scene, 2, true).size(), 4096u);
        const glm::dvec3 size = fine.max - fine.min;
        const double longest = std::max({size.x, size.y, size.z});
        for (int i = 0; i < 3; ++i) {
            // A cell of sixteen along the longest side, and its particle's reach.
            EXPECT_NEAR(coarse.min[i], fine.min[i], 0.2 * longest) << preset;
            EXPECT_NEAR(coarse.max[i], fine.max[i], 0.2 * longest) << preset;
        }
    }
}

// A lit picture of it, in which the grid of light is as fine as all of the cloud.
Image picture_of(const ImplicitCloud& implicit, double density, std::uint64_t seed) {
    SceneDraft draft = test::plain_draft();
    draft.top_level_cubes = false;
    draft.seed = seed;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kImplicit;
    cloud.implicit = std::make_shared<ImplicitCloud>(implicit);
    cloud.density = density;
    draft.camera.automatic = false;
    draft.camera.eye = {300, 250, 900};
    draft.image.width = 80;
    draft.image.height = 60;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = "transport-32";
    Result<Scene> scene = validate(std::move(draft));
    EXPECT_TRUE(scene.ok());
    return render_scene(*scene, {nullptr, 2, nullptr, {}, {}}, {})->image;
}

TEST(ImplicitParticles, TheStatedErrorIsThatToAFinerLattice) {
    // Of what is to be seen at 40 cells against three times as many.
    std::vector<double> ratios;
    for (int preset = 0; preset < 5; ++preset)
        for (const double density : {0.05, 0.8}) {
            const std::uint64_t seed = 11 + static_cast<std::uint64_t>(preset);
            ImplicitCloud cloud = of_preset(static_cast<ImplicitPreset>(preset), 40);
            ModelRequest request;
            request.key = keyed(seed, 0);
            request.density = density;
            const double stated = implicit::make_particles(cloud, request, {})->error;
            const Image coarse = picture_of(cloud, density, seed);
            cloud.resolution = 120;
            const double measured = picture_difference(coarse, picture_of(cloud, density, seed));
            std::printf("preset %d, density %.2f at 40 cells: stated %.4f, measured %.4f\n", preset,
                        density, stated, measured);
            ratios.push_back(stated / measured);
        }
    // Filaments thinner than cells of forty, in thin air, are not in its eighty cells either; and a flat sheet's grid
    // of light changes with its bounds.
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[0], 0.5);
    EXPECT_GT(ratios[2], 1);
    EXPECT_LT(ratios[ratios.size() / 2], 1.6);
    EXPECT_LT(ratios.back(), 3.5);
}

// A lattice over a flat cloud may have more cells along its length, and no more in all.
TEST(ImplicitParticles, FlatCloudsMayHaveFinerCells) {
    const ImplicitField flat = prepare_field(of_preset(ImplicitPreset::kMackerel, 0), 1, 0);
    const LatticeField sheet = lattice_over(flat, 320);
    EXPECT_EQ(std::max(sheet.nx, sheet.nz), 320);
    const ImplicitField round = prepare_field(test::bare({test::ball({0, 0, 0}, 1)}), 1, 0);
    EXPECT_EQ(lattice_over(round, 160).nx, 160);
    for (const std::uint64_t resolution : {161, 400}) {
        const LatticeField lattice = lattice_over(round, resolution);
        EXPECT_LE(lattice.nx, 160);
        EXPECT_GE(lattice.nx, 158);
    }
}

TEST(ImplicitParticles, RandomCloudsAreFiniteWithinBoundsAndTheSameOnTwoThreads) {
    std::size_t empty = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::Dice dice(seed);
        test::Whereabouts where;
        where.size = dice.log_between(1e-3, 1e5);
        if (dice.chance(0.3)) where.middle = dice.any_vector(1e8);
        const Cloud cloud = test::random_implicit(dice, where);
        const double time = dice.chance(0.3) ? dice.any(limits::kMaxTime) : dice.between(0, 60);
        const Scene scene = scene_of(cloud, time);
        const ParticleSet set = particles_of(scene, 1);
        expect_equal(set, particles_of(scene, 2));
        ASSERT_LE(set.size(), most_particles(cloud)) << seed;
        empty += set.size() == 0;
        const std::uint64_t key = keyed(scene->seed, 0);
        const Box box = box_of(prepare_field(*cloud.implicit, key, time));
        // A cloud turned about y stays within its box's far corner.
        const double reach =
            box.empty() ? 0
                        : cloud.scale * glm::length(glm::max(glm::abs(box.min), glm::abs(box.max)));
        EXPECT_TRUE(std::isfinite(set.error) && set.error >= 0) << seed;
        for (std::size_t i = 0; i < set.size(); ++i) {
            ASSERT_TRUE(std::isfinite(set.density[i]) && set.density[i] >= 0) << seed;
            ASSERT_GE(set.radius[i], limits::kMinRadius) << seed;
            ASSERT_LE(set.radius[i], limits::kMaxRadius) << seed;
            const double far = glm::distance(set.center[i], cloud.translate);
            ASSERT_LE(far, reach * 1.01 + 2.0 * static_cast<double>(set.radius[i])) << seed;
        }
    }
    EXPECT_LT(empty, 150u);  // weights of any sign, shapes finer than sixteen cells
}

TEST(ImplicitParticles, AFullCubeStaysWithinTheLimitOnParticles) {
    // A solid that fills its box at the finest resolution.
    ImplicitPrimitive solid = test::ball({0, 0, 0}, 0.01);
    solid.core = 1e5;
    ImplicitCloud cloud = test::bare({solid});
    cloud.resolution = limits::kMaxImplicitResolution;
    const ParticleSet set = particles_of(scene_of(cloud));
    EXPECT_GT(set.size(), 2'000'000u);  // pi/6 of the cube
    EXPECT_LE(set.size(), limits::kMaxParticles);
    EXPECT_LE(most_particles(cloud), limits::kMaxParticles);
}

TEST(ImplicitParticles, NothingIsMadeOfNothing) {
    EXPECT_EQ(particles_of(scene_of(test::bare({}))).size(), 0u);
    EXPECT_EQ(particles_of(scene_of(test::bare({test::ball({0, 0, 0}, 1, -1)}))).size(), 0u);
    EXPECT_EQ(particles_of(scene_of(test::bare({test::ball({0, 0, 0}, 1, 0)})), 2, true).size(),
              0u);
}

TEST(ImplicitParticles, ADeadlineEndsIt) {
    Deadline over;
    over.until = Deadline::Clock::now();
    const Result<ParticleSet> set =
        generate(scene_of(of_preset(ImplicitPreset::kCumulus, 160)), 2, over);
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().code, ErrorCode::kOverDeadline);
    Deadline cancelled;
    cancelled.cancelled = std::make_shared<std::atomic<bool>>(true);
    EXPECT_FALSE(generate(scene_of(ImplicitCloud{}), 2, cancelled).ok());
}

TEST(ImplicitParticles, AMovingCloudMovesThroughItsLattice) {
    // Cells stay where they are from frame to frame: every particle of one frame is on the lattice of the next.
    ImplicitPrimitive moving = test::ball({0, 0, 0}, 1);
    moving.keys.resize(2);
    moving.keys[0].center = glm::dvec3(0);
    moving.keys[1].time = 10, moving.keys[1].center = glm::dvec3(3, 0, 0);
    ImplicitCloud cloud = test::bare({moving});
    cloud.resolution = 50;
    const ParticleSet a = particles_of(scene_of(cloud, 2)), b = particles_of(scene_of(cloud, 7));
    ASSERT_GT(a.size(), 0u);
    const double cell = 5.0 / 50;
    EXPECT_EQ(a.radius[0], b.radius[0]);
    for (int i = 0; i < 3; ++i) {
        const double cells = (a.center[0][i] - b.center[0][i]) / cell;
        EXPECT_NEAR(cells, std::round(cells), 1e-6);
    }
}

}  // namespace
}  // namespace awan
