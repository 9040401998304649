// Small scenes for tests of the rooms, and one device for those that draw.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/formats/awn.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"

namespace awan::test {

inline Scene valid(SceneDraft draft) {
    auto scene = validate(std::move(draft));
    if (!scene.ok()) {
        ADD_FAILURE() << scene.error().pointer << ": " << scene.error().message;
        std::abort();
    }
    return *std::move(scene);
}

// A scene in the plainest light, for what does not test what a document gets by itself: boxes filled evenly at a fixed
// density, without detail, under a gradient and a sun of its own colour.
inline SceneDraft plain_draft() {
    SceneDraft draft;
    draft.fill = Fill::kUniform;
    draft.density = kDefaultDensity;
    draft.detail = std::nullopt;
    draft.sun.auto_color = false;
    draft.sun.azimuth = 60;
    // Tests are of what rungs draw, which is all but the sun itself.
    draft.sun.disc = SunDisc::kHidden;
    draft.sky.physical = false;
    draft.sky.intensity = kGradientSkyIntensity;
    return draft;
}

struct Ball {
    glm::dvec3 center{0};
    double radius = 1;  // 2 s
    double density = 1;
    glm::vec3 color{1};
};

// The rung is harris in both: their tests are of the two passes of splats, whatever a plan would choose.

// Ready particles, a black sky, a sun of irradiance 1 overhead-right, the eye on the +z axis
// looking at the origin.
inline SceneDraft balls(const std::vector<Ball>& list) {
    SceneDraft draft = plain_draft();
    draft.top_level_cubes = false;
    Cloud cloud;
    cloud.model = CloudModel::kParticles;
    for (const Ball& ball : list) {
        cloud.ready.positions.push_back(ball.center);
        cloud.ready.radii.push_back(static_cast<float>(ball.radius));
        cloud.ready.densities.push_back(static_cast<float>(ball.density));
        cloud.ready.colors.push_back(ball.color);
    }
    draft.clouds.push_back(cloud);
    draft.density = 1.0;
    draft.sky.none = true;
    draft.sun.color = {1, 1, 1};
    draft.sun.intensity = 1;
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 20};
    draft.camera.target = {0, 0, 0};
    draft.image.width = 64;
    draft.image.height = 48;
    draft.medium.albedo = 1;
    draft.accuracy.rung = "harris";
    return draft;
}

inline SceneDraft table_4_4() {
    SceneDraft draft = plain_draft();
    draft.clouds.push_back({});
    draft.clouds[0].cubes = {
        {200, {7.39642, 1.07048, 2.89284}, {-3.4, -3.3, -0.600002}, 2.1, 1, {}},
        {100, {4.99599, 1.30149, 2.33467}, {1.1, -0.899999, 0}, 3, 1, {}},
        {110, {3.02839, 1.58117, 3.05433}, {-3.8, -0.499999, 0}, 3, 1, {}},
        {50, {2.36429, 1.50285, 2.29693}, {4.6, -3, 0}, 2.2345, 1, {}}};
    draft.accuracy.rung = "harris";
    return draft;
}

inline Switch& effect(SceneDraft& draft, Effect effect) {
    return draft.effects[static_cast<std::size_t>(effect)];
}

// Opened once a program; a machine without a renderer fails every test that asks for it.
inline Device& device() {
    static Device device = [] {
        auto opened = Device::open(DeviceChoice::kSoftware);
        if (!opened.ok()) {
            ADD_FAILURE() << opened.error().message;
            std::abort();
        }
        return *std::move(opened);
    }();
    return device;
}

inline Rendered render(const SceneDraft& draft, int threads = 1) {
    auto rendered = render_scene(valid(draft), {&device(), threads, nullptr, {}, {}}, {});
    if (!rendered.ok()) {
        ADD_FAILURE() << rendered.error().message;
        std::abort();
    }
    return *std::move(rendered);
}

struct Pixel {
    double r, g, b, a;
};
inline Pixel pixel(const Image& image, int x, int y) {
    const float* p = image.pixels.data() +
                     4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(x));
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]),
            static_cast<double>(p[3])};
}

// Unit direction of a pixel's ray and the eye, in scene units.
struct Ray {
    glm::dvec3 eye, direction;
};
inline Ray ray(const View& view, const Image& image, int x, int y) {
    const double u = ((x + 0.5) / image.width * 2 - 1) * view.tan_half_fov * view.aspect;
    const double v = (1 - (y + 0.5) / image.height * 2) * view.tan_half_fov;
    return {view.eye, glm::normalize(view.forward + u * view.right + v * view.up)};
}

}  // namespace awan::test
