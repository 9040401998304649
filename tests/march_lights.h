// Light for tests and benchmarks of the march, made without the solver.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/parallel.h"
#include "core/draw/march.h"
#include "core/generate/gaussian.h"
#include "core/generate/generate.h"
#include "core/survey/projection.h"
#include "tests/scenes.h"

namespace awan::test {

// Exact, in double, by erfc of arguments of one sign; direction unit.
inline double half_normal(double low, double high) {  // integral of the normal density
    if (low > 0)
        return 0.5 * (std::erfc(low / std::numbers::sqrt2) - std::erfc(high / std::numbers::sqrt2));
    return 0.5 * (std::erfc(-high / std::numbers::sqrt2) - std::erfc(-low / std::numbers::sqrt2));
}
inline double line_depth(const ParticleSet& set, const glm::dvec3& from,
                         const glm::dvec3& direction, double least = 0, double most = 1e300) {
    double depth = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::dvec3 q = set.center[i] - from;
        const double s = gaussian_s(set, i), t = glm::dot(q, direction);
        const glm::dvec3 off = q - t * direction;
        depth += central_depth(set, i) * std::exp(-glm::dot(off, off) / (2 * s * s)) *
                 half_normal((least - t) / s, (most - t) / s);
    }
    return depth;
}

// The cube around the matter out to `reach` of the bounds' half diagonal.
struct Around {
    glm::dvec3 center;
    double half;
};
inline Around around(const ParticleSet& set, double reach) {
    const Bounds bounds = bounds_of(set);
    return {(bounds.min + bounds.max) / 2.0, reach * glm::length(bounds.max - bounds.min) / 2};
}

// Exact at its nodes.
inline SunDepth exact_sun(const Scene& scene, const ParticleSet& set, int nodes, double reach = 1) {
    const Around box = around(set, reach);
    SunDepth sun;
    sun.w = -sun_direction(scene->sun);
    const SideAxes side = side_axes(sun.w);
    sun.u = side.u;
    sun.v = side.v;
    sun.cell = glm::dvec3(2 * box.half / (nodes - 1));
    sun.origin = box.center - box.half * (sun.u + sun.v + sun.w);
    sun.nodes = glm::ivec3(nodes);
    const auto n = static_cast<std::size_t>(nodes);
    sun.depth.resize(n * n * n);
    parallel_for(2, n * n, [&](std::size_t row) {
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec3 p = sun.origin + sun.cell.x * (static_cast<double>(i) * sun.u +
                                                          static_cast<double>(row % n) * sun.v +
                                                          static_cast<double>(row / n) * sun.w);
            sun.depth[row * n + i] = static_cast<float>(line_depth(set, p, -sun.w));
        }
    });
    return sun;
}

// The share of scattering in the peak, with moments 0..3 on the grid.
inline double share_of(const Medium& medium) {
    return std::pow(medium.g, 4);
}

// A grid whose source function is value(p) (for each band) in all directions.
template <typename Value>
TransportLight grid_light(const Scene& scene, const ParticleSet& set, int cells, int bands,
                          const Value& value, double reach = 1) {
    const Around box = around(set, reach);
    TransportLight light;
    light.origin = box.center - box.half;
    light.cell = glm::dvec3(2 * box.half / cells);
    light.cells = glm::ivec3(cells);
    light.peak_from = 4;
    light.peak_share = share_of(scene->medium);
    const auto n = static_cast<std::size_t>(cells);
    light.bands.resize(static_cast<std::size_t>(bands));
    for (LightBand& band : light.bands) {
        band.moments.resize(n * n * n);
        for (std::size_t c = 0; c < n * n * n; ++c) {
            const glm::dvec3 p =
                light.origin +
                light.cell * (glm::dvec3(static_cast<double>(c % n), static_cast<double>(c / n % n),
                                         static_cast<double>(c / n / n)) +
                              0.5);
            band.moments[c][0] = static_cast<float>(value(p) * std::sqrt(4 * std::numbers::pi));
        }
    }
    return light;
}

struct Stage {
    Scene scene;
    ParticleSet particles;
    View view;
};
inline Stage stage(const SceneDraft& draft) {
    Scene scene = valid(draft);
    ParticleSet particles = *generate(scene, 1, {});
    const View view = resolve_view(scene->camera, scene->image, bounds_of(particles));
    return {std::move(scene), std::move(particles), view};
}
inline Image marched(const Stage& stage, const TransportLight& light, int threads = 2,
                     MarchSettings settings = {}) {
    auto image =
        march(stage.scene, stage.particles, stage.view, light, settings, threads, Deadline{});
    if (!image.ok()) {
        ADD_FAILURE() << image.error().message;
        std::abort();
    }
    return *std::move(image);
}

}  // namespace awan::test
