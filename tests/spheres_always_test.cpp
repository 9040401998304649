// Clouds of spheres through time, on any number of threads, and any that are valid.
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

using spheres::SphereTree;

using test::cloud_of;
using test::particles_of;
using test::request_of;

// --- morph

SpheresCloud morphing(std::uint64_t levels) {
    SpheresCloud cloud = cloud_of(levels);
    cloud.morph = SpheresMorph{7, 10, 3};
    return cloud;
}

ReadyParticles at_time(const SpheresCloud& cloud, std::uint64_t key, double time) {
    ModelRequest request = request_of(key);
    request.place = 2;
    request.time = time;
    return particles_of(cloud, request);
}

TEST(SpheresAlways, AMorphGoesThroughItsRealisations) {
    const SpheresCloud cloud = morphing(4);
    const SpheresCloud still = cloud_of(4);
    const auto same = [&](double time, std::uint64_t key) {
        const ReadyParticles a = at_time(cloud, 99, time), b = at_time(still, key, 0);
        return a.positions == b.positions && a.radii == b.radii && a.densities == b.densities;
    };
    EXPECT_TRUE(same(0, 99));
    EXPECT_TRUE(same(-5, 99));
    EXPECT_TRUE(same(10, keyed(7, 2)));  // what seed 7 makes of cloud 2
    EXPECT_TRUE(same(20, keyed(8, 2)));
    EXPECT_TRUE(same(30, keyed(9, 2)));
    EXPECT_TRUE(same(1e6, keyed(9, 2)));
    EXPECT_FALSE(same(5, 99));
}

TEST(SpheresAlways, AMorphIsLinear) {
    const SpheresCloud cloud = morphing(3);
    const ReadyParticles a = at_time(cloud, 99, 0), b = at_time(cloud, 99, 10),
                         m = at_time(cloud, 99, 2.5);
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        // Doubles of size 500; float32 radii.
        EXPECT_LT(glm::length(0.75 * a.positions[i] + 0.25 * b.positions[i] - m.positions[i]),
                  1e-11);
        EXPECT_NEAR(0.75F * a.radii[i] + 0.25F * b.radii[i], m.radii[i], 1e-6F * m.radii[i] * 4);
    }
}

// --- always

bool same_bytes(const ParticleSet& a, const ParticleSet& b) {
    return a.center == b.center && a.radius == b.radius && a.density == b.density &&
           a.variant == b.variant && a.error == b.error;
}

SceneDraft draft_of(const Cloud& cloud) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.push_back(cloud);
    return draft;
}

Cloud as_cloud(const SpheresCloud& spheres) {
    Cloud cloud;
    cloud.model = CloudModel::kSpheres;
    cloud.spheres = std::make_shared<SpheresCloud>(spheres);
    return cloud;
}

TEST(SpheresAlways, ThreadsDoNotShow) {
    SpheresCloud cloud = morphing(7);
    SceneDraft draft = draft_of(as_cloud(cloud));
    draft.time = 4;
    const Scene scene = test::valid(draft);
    const ParticleSet one = *generate(scene, 1, {});
    EXPECT_GT(one.size(), 50000u);
    for (const int threads : {2, 7}) {
        EXPECT_TRUE(same_bytes(one, *generate(scene, threads, {}))) << threads;
    }
}

// Places of all of a small cloud's spheres, as bits: the same on every machine.
TEST(SpheresAlways, HasTheSameBitsEverywhere) {
    SpheresCloud cloud = cloud_of(5);
    std::uint64_t hash = 0;
    const ReadyParticles set = particles_of(cloud, request_of(1));
    for (std::size_t i = 0; i < set.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
            hash = keyed(hash, std::bit_cast<std::uint64_t>(set.positions[i][axis] + 0.0));
        hash = keyed(hash, std::bit_cast<std::uint32_t>(set.radii[i]));
        hash = keyed(hash, std::bit_cast<std::uint32_t>(set.densities[i]));
    }
    EXPECT_EQ(hash, 0x79a17cafd10286deu) << std::hex << hash;
}

TEST(SpheresAlways, RandomCloudsAreSound) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        test::Dice dice(seed);
        test::Whereabouts where;
        where.size = dice.chance(0.7) ? dice.log_between(0.1, 1e3) : dice.log_between(1e-4, 1e5);
        if (dice.chance(0.2)) where.middle = dice.any_vector(0.9 * limits::kMaxCoordinate);
        SceneDraft draft = draft_of(test::random_spheres(dice, where));
        draft.time = dice.chance(0.3) ? 0 : dice.any(limits::kMaxTime);
        const Cloud cloud = draft.clouds[0];
        const Scene scene = test::valid(draft);
        const auto made = generate(scene, 1, {});
        ASSERT_TRUE(made.ok()) << seed;
        ASSERT_LE(made->size(), most_particles(cloud)) << seed;
        ASSERT_GT(made->size(), 0u) << seed;
        // Everything lies in the root sphere; .36 of a leaf's radius is its s, so that 2 s does not.
        const SphereTree tree(*cloud.spheres, 1, 0, draft.time);
        const spheres::Sphere& root = tree.root().sphere;
        const double reach = (glm::length(root.center) + 1.5 * root.radius) * cloud.scale;
        for (std::size_t i = 0; i < made->size(); ++i) {
            ASSERT_LE(glm::length(made->center[i] - cloud.translate),
                      reach + 1e-15 * limits::kMaxCoordinate)
                << seed;
            const double own = static_cast<double>(made->radius[i]) / cloud.scale;
            ASSERT_GE(own, limits::kMinRadius) << seed;
            ASSERT_LE(own, limits::kMaxRadius) << seed;
            ASSERT_GE(made->density[i], 0) << seed;
            ASSERT_LE(made->density[i], static_cast<float>(limits::kMaxDensity)) << seed;
        }
        ASSERT_TRUE(made->error >= 0 && made->error <= 1) << seed;
        ASSERT_TRUE(same_bytes(*made, *generate(scene, 2, {}))) << seed;
    }
}

TEST(SpheresAlways, GivesUpWhenNobodyWaits) {
    Deadline over;
    over.until = Deadline::Clock::now();
    const auto made = spheres::make_particles(cloud_of(8), request_of(1, 2), over);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::kOverDeadline);
}

}  // namespace
}  // namespace awan
