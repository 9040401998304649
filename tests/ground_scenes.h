// Scenes over a ground for tests, and how far a picture of one is from the truth.
#pragma once

#include <cmath>
#include <cstdio>

#include "core/accuracy/error_measures.h"
#include "core/draw/march.h"
#include "core/light/transport.h"
#include "tests/scenes.h"

namespace awan::test {

// A cumulus `above` the ground (of its lowest centre, scene units; it is 7 high), seen from above its base, ground in
// view.
inline SceneDraft over_ground(double albedo, double above = 3) {
    SceneDraft draft = table_4_4();
    draft.ground = Ground{-6 - above, glm::dvec3(albedo)};
    draft.camera.automatic = false;
    draft.camera.target = {0, -4 - 0.5 * above, 0};
    draft.camera.eye = draft.camera.target + glm::dvec3(14, 9, 24);
    draft.camera.fov = 44;
    draft.image.width = 48;
    draft.image.height = 36;
    return draft;
}

struct GroundPicture {
    Planned planned;
    TransportLight light;
    Image image;
};

inline GroundPicture ground_picture(const SceneDraft& draft, int cells, bool light_on = true,
                                    bool shadow_on = true, int threads = 2) {
    const Scene scene = valid(draft);
    auto planned = plan_scene(scene, threads, {});
    EXPECT_TRUE(planned.ok());
    TransportSettings settings;
    settings.cells = cells;
    settings.ground = light_on;
    settings.ground_shadow = shadow_on;
    auto light = transport_light(scene, planned->particles, planned->survey, settings, threads, {});
    EXPECT_TRUE(light.ok());
    auto image =
        march(scene, planned->particles, planned->survey.view, *light, {}, threads, Deadline{});
    EXPECT_TRUE(image.ok());
    return {*std::move(planned), *std::move(light), *std::move(image)};
}

inline TruthImage ground_truth(const SceneDraft& draft, std::uint32_t samples) {
    const Scene scene = valid(draft);
    const auto planned = plan_scene(scene, 2, {});
    TruthOptions options;
    options.samples = samples;
    options.threads = 2;
    auto truth = trace_truth(scene, planned->particles, planned->survey.view, options, Progress{},
                             Deadline{});
    EXPECT_TRUE(truth.ok());
    return *std::move(truth);
}

// Of some pixels, all channels: sqrt(mean (x - a)(x - b)) and mean x - mean truth, relative to the truth's mean.
struct Apart {
    double nrmse = 0, bias = 0;
    int pixels = 0;
};
template <typename Wanted>
Apart apart(const Image& x, const TruthImage& truth, const Wanted& wanted) {
    double square = 0, mean = 0, off = 0;
    Apart result;
    for (int j = 0; j < x.height; ++j)
        for (int i = 0; i < x.width; ++i) {
            if (!wanted(i, j)) continue;
            ++result.pixels;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at =
                    4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(x.width) +
                         static_cast<std::size_t>(i)) +
                    c;
                const auto v = static_cast<double>(x.pixels[at]);
                const auto a = static_cast<double>(truth.half_a.pixels[at]);
                const auto b = static_cast<double>(truth.half_b.pixels[at]);
                square += (v - a) * (v - b);
                mean += (a + b) / 2;
                off += v - (a + b) / 2;
            }
        }
    if (result.pixels == 0) return result;
    result.nrmse =
        std::sqrt(std::max(0.0, square / result.pixels / 3)) / (mean / result.pixels / 3);
    result.bias = off / mean;
    return result;
}

// Optical depth of a pixel's ray down to the ground, if it meets it (`ground`).
struct PixelSight {
    double alpha = 0;
    bool ground = false;
};
inline PixelSight sight(const Planned& planned, const SceneDraft& draft, const Image& image, int x,
                        int y) {
    const Ray r = ray(planned.survey.view, image, x, y);
    const bool meets = draft.ground && r.direction.y < 0 && r.eye.y > draft.ground->height;
    const double end = meets ? (draft.ground->height - r.eye.y) / r.direction.y : 1e30;
    return {-std::expm1(-line_optical_depth(planned.particles, r.eye, r.direction, 0, end)), meets};
}

}  // namespace awan::test
