// The light of single particles, where it has a closed form, and beside the picture that they make.
#include "core/draw/particle_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/draw/march.h"
#include "core/generate/generate.h"
#include "core/light/transport.h"
#include "core/lit_particles.h"
#include "core/scene/outside.h"
#include "core/scene/validate.h"
#include "core/truth/oracles.h"

namespace awan {
namespace {

SceneDraft cloud(double density) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.resize(1);
    draft.clouds[0].model = CloudModel::kParticles;
    draft.clouds[0].ready.positions = {{0, 0, 0}, {1, 0.5, 0}, {0.2, -0.7, 0.4}};
    draft.clouds[0].ready.radii = {2, 1.5, 1};
    draft.density = density;
    draft.detail.reset();
    draft.sky.physical = false;
    draft.camera.automatic = false;
    draft.camera.eye = glm::dvec3(3, 2, 12);
    draft.camera.target = glm::dvec3(0);
    return draft;
}

// Lit as lit_particles.h does it, for one thread and for several.
std::vector<glm::vec3> light_of(const SceneDraft& draft) {
    const Scene scene = *scene_of_light(*validate(draft));
    const ParticleSet particles = *generate(scene, 2, {});
    std::vector<std::vector<glm::vec3>> lights;
    for (const int threads : {1, 3}) {
        auto light = light_particles(scene, *plan_generated(scene, particles, threads, {}, {}, {}),
                                     particles, {nullptr, threads}, {});
        EXPECT_TRUE(light.ok());
        lights.push_back(*std::move(light));
    }
    EXPECT_EQ(lights[0], lights[1]);
    EXPECT_EQ(lights[0].size(), particles.size());
    return lights[0];
}

// Nothing is absorbed under an even sky: all matter is as bright as the sky, from wherever it is seen.
TEST(ParticleLight, IsTheSkysWhereNothingIsAbsorbed) {
    for (const double density : {0.01, 3.0})
        for (const double g : {0.0, 0.85}) {
            SceneDraft draft = cloud(density);
            draft.medium.albedo = 1;
            draft.medium.g = g;
            draft.sun.intensity = 0;
            draft.sky.zenith = draft.sky.horizon = {1, 0.5, 0.25};
            draft.sky.intensity = 0.5;
            for (const glm::vec3& light : light_of(draft))
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(light[c] * std::exp2(c), 0.5F, density < 1 ? 0.005F : 0.05F)
                        << density << ' ' << g << ' ' << c;
        }
}

// In thin matter the sun's light is scattered once: by the whole phase function, its forward peak too.
TEST(ParticleLight, IsTheSunsScatteredOnceInThinMatter) {
    for (const glm::dvec3& eye : {glm::dvec3(3, 2, 12), glm::dvec3(0.1, -12, 0.3)}) {
        SceneDraft draft = cloud(1e-4);
        draft.medium.albedo = 0.8;
        draft.sky.none = true;
        draft.sun.elevation = 60;
        draft.camera.eye = eye;
        const auto light = light_of(draft);
        const Scene scene = *validate(draft);
        const Outside outside = outside_of(scene);
        const ParticleSet particles = *generate(scene, 1, {});
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double cosine =
                glm::dot(glm::normalize(particles.center[i] - eye), outside.to_sun);
            const glm::dvec3 exact =
                0.8 * outside.sun * phase_value(scene->medium, cosine) / (4 * std::numbers::pi);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(light[i][c] / static_cast<float>(exact[c]), 1, 0.01) << i << ' ' << c;
        }
    }
}

// Particles of that light, laid over each other, are about as bright as the picture of the transport rung, where
// they are thick: light that the forward peak has scattered comes through more matter than is behind a thin veil.
TEST(ParticleLight, MakesAboutTheSamePicture) {
    SceneDraft draft;
    draft.clouds.resize(1);
    Cube& cube = draft.clouds[0].cubes.emplace_back();
    cube.particles = 400;
    cube.size = {4, 2, 3};
    cube.radius = 0.9;
    draft.density = 30;
    draft.detail.reset();
    draft.image.width = draft.image.height = 24;
    draft.image.background = Background::kTransparent;
    draft.sun.disc = SunDisc::kHidden;
    for (const double azimuth : {20.0, 170.0}) {
        draft.sun.azimuth = azimuth;
        const Scene scene = *scene_of_light(*validate(draft));
        const ParticleSet particles = *generate(scene, 2, {});
        const Planned planned = *plan_still(scene, 2, {}, {}, {});
        const auto climbed = *climb(scene, planned, {nullptr, 2}, {});
        const View& view = planned.survey.view;
        const auto light = particle_light(scene, particles, *climbed.light, view.eye, 2);
        const Image image = *march(scene, particles, view, *climbed.light, {}, 2, {});
        std::vector<std::size_t> order(particles.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        const auto away = [&](std::size_t i) {
            return glm::dot(particles.center[i] - view.eye, view.forward);
        };
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
        glm::dvec3 ours(0), theirs(0);
        for (int y = 8; y < 16; ++y)
            for (int x = 8; x < 16; ++x) {
                const double u = (2 * (x + 0.5) / 24 - 1) * view.tan_half_fov * view.aspect;
                const double v = (1 - 2 * (y + 0.5) / 24) * view.tan_half_fov;
                const glm::dvec3 along =
                    glm::normalize(view.forward + u * view.right + v * view.up);
                double through = 1;
                for (const std::size_t i : order) {
                    const glm::dvec3 to = particles.center[i] - view.eye;
                    const glm::dvec3 off = to - along * glm::dot(to, along);
                    const double s = static_cast<double>(particles.radius[i]) / 2;
                    const double depth = static_cast<double>(particles.density[i]) * s *
                                         std::sqrt(2 * std::numbers::pi) *
                                         std::exp(-glm::dot(off, off) / (2 * s * s));
                    ours += through * -std::expm1(-depth) * glm::dvec3(light[i]);
                    through *= std::exp(-depth);
                }
                const auto at = static_cast<std::size_t>(4 * (y * image.width + x));
                for (int c = 0; c < 3; ++c)
                    theirs[c] +=
                        static_cast<double>(image.pixels[at + static_cast<std::size_t>(c)]);
            }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[c] / theirs[c], 1, 0.3) << azimuth << ' ' << c;
    }
}

TEST(ParticleLight, IsOfRungsWithAGridAndOfNoLook) {
    SceneDraft draft = cloud(1);
    draft.accuracy = {{}, {}, "transport-24"};
    EXPECT_EQ((*scene_of_light(*validate(draft)))->accuracy.rung, "transport-24");
    draft.accuracy = {{}, 50.0, {}};
    EXPECT_EQ((*scene_of_light(*validate(draft)))->accuracy.rung, "transport-16");
    draft.accuracy = {{}, {}, "harris"};
    EXPECT_EQ((*scene_of_light(*validate(draft)))->accuracy.rung, "transport-16");
}

}  // namespace
}  // namespace awan
