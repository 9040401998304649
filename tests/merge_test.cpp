// Merging many particles into fewer keeps their matter, costs what it states, and is hidden from the truth.
#include "core/survey/merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "core/draw/march.h"
#include "core/draw/picture_difference.h"
#include "core/generate/gaussian.h"
#include "core/generate/generate.h"
#include "core/light/transport.h"
#include "core/planning.h"
#include "core/truth/path_tracer.h"
#include "tests/scenes.h"

namespace awan {
namespace {

constexpr glm::dvec3 kUp{0, 1, 0};

// A box of 3 x 2 x 2 units of optical depth 5 to 10.
SceneDraft box(std::uint64_t count, double radius) {
    SceneDraft draft = test::plain_draft();
    draft.image.width = 16;
    draft.image.height = 12;
    draft.fill = Fill::kUniform;
    Cloud cloud;
    cloud.cubes = {{count, {3, 2, 2}, {0, 0, 0}, radius, 1, {}}};
    draft.clouds = {cloud};
    // s is uniform from 0 to half the radius, so that the mean of its cube is a quarter of the largest.
    const double mass = 15.75 * std::pow(radius / 2, 3) / 4 * static_cast<double>(count);
    draft.density = 4 * 12 / mass;
    draft.accuracy.rung = "transport-16";
    return draft;
}
// In whose radius many others lie; and smaller ones, that do not.
SceneDraft overlapping() {
    return box(100000, 0.8);
}
SceneDraft crumbs() {
    return box(100000, 0.06);
}

// Particles wider than what they fill, and so deep that the edge of the cloud lies in their tails.
SceneDraft deep_ball() {
    SceneDraft draft = box(20000, 2.4);
    draft.density = *draft.density * 20;
    return draft;
}

SceneDraft deep() {
    SceneDraft draft = overlapping();
    draft.density = *draft.density * 10;
    return draft;
}

ParticleSet particles_of(const SceneDraft& draft) {
    return *generate(test::valid(draft), 2, {});
}

double mass_of(const ParticleSet& particles) {
    double mass = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) mass += gaussian_mass(particles, i);
    return mass;
}

glm::dvec3 middle_of(const ParticleSet& particles) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < particles.size(); ++i)
        sum += gaussian_mass(particles, i) * particles.center[i];
    return sum / mass_of(particles);
}

double extinction_at(const ParticleSet& particles, const glm::dvec3& point) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 off = particles.center[i] - point;
        const double s = gaussian_s(particles, i);
        sum +=
            static_cast<double>(particles.density[i]) * std::exp(-glm::dot(off, off) / (2 * s * s));
    }
    return sum;
}

bool same(const ParticleSet& a, const ParticleSet& b) {
    return a.center == b.center && a.radius == b.radius && a.density == b.density;
}

TEST(Merge, KeepsMassItsMiddleAndTheExtinction) {
    const ParticleSet all = particles_of(overlapping());
    const ParticleSet fewer = *merged(all, kUp, 0.05, 2, {});
    ASSERT_TRUE(fewer.whole);
    EXPECT_TRUE(same(*fewer.whole, all));
    EXPECT_LT(2 * fewer.size(), all.size());
    EXPECT_NEAR(mass_of(fewer) / mass_of(all), 1, 1e-6);
    EXPECT_LT(glm::length(middle_of(fewer) - middle_of(all)), 1e-3);
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 point(3 * (std::fmod(0.618 * i, 1) - 0.5),
                               2 * (std::fmod(0.414 * i, 1) - 0.5),
                               2 * (std::fmod(0.732 * i, 1) - 0.5));
        const double exact = extinction_at(all, point);
        EXPECT_NEAR(extinction_at(fewer, point), exact, 0.02 * exact) << i;
    }
}

TEST(Merge, FewParticlesAndColoredOnesStayAsTheyAre) {
    SceneDraft draft = overlapping();
    draft.clouds[0].cubes[0].particles = kFewParticles - 1;
    const ParticleSet few = particles_of(draft);
    const ParticleSet still = *merged(few, kUp, 0.05, 2, {});
    EXPECT_FALSE(still.whole);
    EXPECT_TRUE(same(still, few));
    EXPECT_EQ(still.error, 0);
    ParticleSet colored = particles_of(overlapping());
    colored.color.assign(colored.size(), glm::vec3(1, 0.5f, 0));
    EXPECT_FALSE(merged(colored, kUp, 0.05, 2, {})->whole);
}

TEST(Merge, IsTheSameForEveryNumberOfThreads) {
    for (const SceneDraft& draft : {overlapping(), crumbs()}) {
        const ParticleSet all = particles_of(draft);
        const ParticleSet one = *merged(all, kUp, 0.2, 1, {}), four = *merged(all, kUp, 0.2, 4, {});
        ASSERT_TRUE(one.whole);
        EXPECT_TRUE(same(one, four));
        EXPECT_EQ(one.error, four.error);
        EXPECT_EQ(one.variant, four.variant);
    }
}

TEST(Merge, KeepsToTheErrorThatIsAllowed) {
    const ParticleSet all = particles_of(crumbs());
    for (const double most : {0.2, 0.05, 0.02, 0.012}) {
        const ParticleSet fewer = *merged(all, kUp, most, 2, {});
        EXPECT_LE(fewer.error, most);
        EXPECT_EQ(fewer.error > 0, fewer.whole != nullptr);
    }
    const ParticleSet none = *merged(all, kUp, 0.001, 2, {});
    EXPECT_FALSE(none.whole);
    EXPECT_TRUE(same(none, all));
}

// The picture of the merged particles, by how much it differs from that of all of them, light and eye alike.
TEST(Merge, APictureDiffersByLessThanIsStated) {
    for (const SceneDraft& draft : {overlapping(), crumbs(), deep(), deep_ball()}) {
        const Scene scene = test::valid(draft);
        const ParticleSet all = particles_of(draft);
        const ParticleSet fewer = *merged(all, sun_direction(scene->sun), 0.2, 2, {});
        ASSERT_TRUE(fewer.whole);
        Planned planned = *plan_scene(scene, 2, {});
        const auto picture = [&](const ParticleSet& particles) {
            const auto light =
                transport_light(scene, particles, planned.survey, planned.plan.transport, 2, {});
            return *march(scene, particles, planned.survey.view, *light, {}, 2, {});
        };
        const double difference = picture_difference(picture(fewer), picture(all));
        std::printf("%zu particles of %zu: off %.4f, stated %.4f\n", fewer.size(), all.size(),
                    difference, fewer.error);
        EXPECT_LT(difference, fewer.error);
        // Nor is it stated for nothing.
        EXPECT_GT(difference, fewer.error / 40);
    }
}

TEST(Merge, IsPartOfWhatAPlanStates) {
    const Planned planned = *plan_scene(test::valid(overlapping()), 2, {});
    ASSERT_TRUE(planned.particles.whole);
    EXPECT_EQ(planned.survey.particles, planned.particles.whole->size());
    EXPECT_EQ(planned.survey.drawn, planned.particles.size());
    EXPECT_GT(planned.survey.model_error, 0);
    EXPECT_EQ(planned.survey.model_error, planned.particles.error);
    // The camera stands where it would without merging.
    const Bounds bounds = bounds_of(*planned.particles.whole);
    EXPECT_EQ(planned.survey.bounds.min, bounds.min);
    EXPECT_EQ(planned.survey.bounds.max, bounds.max);
}

TEST(Merge, TruthSeesTheParticlesAsTheyAre) {
    SceneDraft draft = overlapping();
    draft.image.width = 8;
    draft.image.height = 6;
    const Scene scene = test::valid(draft);
    const Planned planned = *plan_scene(scene, 2, {});
    ASSERT_TRUE(planned.particles.whole);
    TruthOptions options;
    options.samples = 4;
    options.threads = 2;
    const View& view = planned.survey.view;
    const Image by_merged = mean_of(*trace_truth(scene, planned.particles, view, options, {}, {}));
    const Image by_all = mean_of(*trace_truth(scene, particles_of(draft), view, options, {}, {}));
    EXPECT_EQ(by_merged.pixels, by_all.pixels);
    ParticleSet alone = planned.particles;
    alone.whole = nullptr;
    EXPECT_NE(mean_of(*trace_truth(scene, alone, view, options, {}, {})).pixels, by_all.pixels);
}

TEST(Merge, LooksAtItsDeadline) {
    const Deadline over{Deadline::Clock::now() - std::chrono::seconds(1), nullptr};
    EXPECT_FALSE(merged(particles_of(overlapping()), kUp, 0.05, 2, over).ok());
}

}  // namespace
}  // namespace awan
