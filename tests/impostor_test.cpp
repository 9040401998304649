// The views of an impostor: that they go all around, and hold the cloud.
#include "core/impostor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/formats/atlas.h"
#include "core/generate/generate.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

SceneDraft cloud() {
    SceneDraft draft;
    draft.clouds.resize(1);
    draft.clouds[0].cubes.push_back({});
    Cube& cube = draft.clouds[0].cubes[0];
    cube.particles = 40;
    cube.size = {2, 1, 3};
    cube.center = {5, 2, -1};
    cube.radius = 0.5;
    return draft;
}

// From a direction back to its place, by the inverse of the sphere's formula.
void expect_place(const glm::dvec3& d, double u, double v) {
    const glm::dvec3 flat = d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    double x = flat.x, z = flat.z;
    if (flat.y < 0) {
        x = (1 - std::abs(flat.z)) * (flat.x < 0 ? -1 : 1);
        z = (1 - std::abs(flat.x)) * (flat.z < 0 ? -1 : 1);
    }
    EXPECT_NEAR(x, u, 1e-12);
    EXPECT_NEAR(z, v, 1e-12);
}

TEST(Impostor, DirectionsAreOctahedral) {
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
            const double u = 0.0999 * i - 0.999, v = 0.0997 * j - 0.9971;
            const glm::dvec3 sphere = impostor_direction(ImpostorMapping::kSphere, u, v);
            EXPECT_NEAR(glm::length(sphere), 1, 1e-12);
            expect_place(sphere, u, v);
            const glm::dvec3 d = impostor_direction(ImpostorMapping::kHemisphere, u, v);
            EXPECT_GE(d.y, 0);
            const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
            EXPECT_NEAR((d.x + d.z) / sum, u, 1e-12);
            EXPECT_NEAR((d.x - d.z) / sum, v, 1e-12);
        }
    const auto up = impostor_direction(ImpostorMapping::kHemisphere, 0, 0);
    EXPECT_EQ(up, glm::dvec3(0, 1, 0));
    const auto down = impostor_direction(ImpostorMapping::kSphere, 1, 1);
    EXPECT_NEAR(down.y, -1, 1e-12);
}

TEST(Impostor, EveryViewHoldsTheCloud) {
    const Scene scene = *validate(cloud());
    const ParticleSet particles = *generate(scene, 2, {});
    const auto impostor =
        impostor_of(scene, {5, 64, ImpostorMapping::kSphere}, true, 2, Deadline{});
    ASSERT_TRUE(impostor.ok());
    ASSERT_EQ(impostor->views.size(), 25U);
    for (const ImpostorView& view : impostor->views) {
        EXPECT_EQ(view.scene->image.background, Background::kTransparent);
        EXPECT_EQ(view.scene->accuracy.rung, kImpostorRung);
        EXPECT_EQ(view.scene->image.layers, "depth");
        const Camera& camera = view.scene->camera;
        const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
        EXPECT_NEAR(glm::dot(forward, view.direction), -1, 1e-9);
        for (std::size_t i = 0; i < particles.size(); ++i) {
            // The angle to the middle and half of that under which the particle is seen.
            const glm::dvec3 away = particles.center[i] - camera.eye;
            const double angle =
                std::acos(std::min(glm::dot(glm::normalize(away), forward), 1.0)) +
                std::asin(static_cast<double>(particles.radius[i]) / glm::length(away));
            EXPECT_LE(angle, glm::radians(kImpostorFov) / 2 + 1e-9);
        }
    }
}

TEST(Impostor, KeepsTheScenesRungAndAsksForDepthWhereThereIsOne) {
    SceneDraft draft = cloud();
    draft.haze = Haze{};
    for (const auto& [rung, layers] :
         {std::pair("harris", "none"), std::pair("single", "depth"), std::pair("truth", "none")}) {
        draft.accuracy.rung = rung;
        const auto impostor = impostor_of(*validate(draft), {2, 16}, true, 1, Deadline{});
        ASSERT_TRUE(impostor.ok());
        EXPECT_EQ(impostor->views[0].scene->accuracy.rung, rung);
        EXPECT_EQ(impostor->views[0].scene->image.layers, layers);
        EXPECT_FALSE(impostor->views[0].scene->haze);
    }
    const auto large = impostor_of(*validate(draft), {32, 512}, false, 1, Deadline{});
    ASSERT_FALSE(large.ok());
    EXPECT_EQ(large.error().code, ErrorCode::kTooLarge);
    draft.clouds[0].cubes.clear();
    EXPECT_TRUE(impostor_of(*validate(draft), {2, 16}, true, 1, Deadline{}).ok());
}

TEST(Impostor, ViewsLieSideBySide) {
    Atlas atlas = begin_atlas(2, 3);
    EXPECT_EQ(atlas.image.width, 6);
    for (std::uint64_t i = 0; i < 4; ++i) {
        const auto value = static_cast<float>(i + 1);
        Image picture{3, 3, false, std::vector<float>(36, value)};
        PictureLayers layers;
        if (i != 2) layers.depth.assign(9, 10 * value);
        put_on_atlas(i, picture, layers, atlas);
    }
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) {
            const auto at = static_cast<std::size_t>(6 * y + x);
            const auto value = static_cast<float>(y / 3 * 2 + x / 3 + 1);
            EXPECT_EQ(atlas.image.pixels[4 * at], value);
            EXPECT_EQ(atlas.depth[at], value == 3 ? kNoDepth : 10 * value);
        }
}

}  // namespace
}  // namespace awan
