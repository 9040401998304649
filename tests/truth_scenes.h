// What the tests of the truth share: scenes traced, paths walked, sums.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/generate/generate.h"
#include "core/generate/keyed_random.h"
#include "core/truth/path_tracer.h"
#include "core/truth/walk.h"
#include "tests/scenes.h"

namespace awan::test {

inline ParticleSet particles_of(const SceneDraft& draft) {
    return generate(valid(draft), 1, {}).value();
}

inline ParticleSet particles_of(const std::vector<Ball>& list) {
    return particles_of(balls(list));
}

inline TruthImage traced(const SceneDraft& draft, const TruthOptions& options) {
    const Scene scene = valid(draft);
    const ParticleSet particles = particles_of(draft);
    const View view = resolve_view(draft.camera, draft.image, bounds_of(particles));
    auto truth = trace_truth(scene, particles, view, options, {}, {});
    if (!truth.ok()) {
        ADD_FAILURE() << truth.error().message;
        std::abort();
    }
    return *std::move(truth);
}

inline double mean_red(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        sum += static_cast<double>(image.pixels[4 * i]);
    return sum / static_cast<double>(image.pixel_count());
}

inline double simpson(double a, double b, int n, const std::function<double(double)>& f) {
    double sum = f(a) + f(b);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(a + (b - a) * i / n);
    return sum * (b - a) / n / 3;
}

// What n paths from one start bring, each with a key of its own.
inline std::vector<truth::Brought> walks(const truth::Setting& setting, truth::Start start, int n,
                                         std::uint64_t seed, truth::Tally& tally) {
    std::vector<truth::Start> starts;
    for (int i = 0; i < n; ++i) {
        start.key = keyed(seed, static_cast<std::uint64_t>(i));
        starts.push_back(start);
    }
    std::vector<truth::Brought> brought(starts.size());
    EXPECT_TRUE(truth::walk(setting, starts, brought, tally, {}));
    return brought;
}

inline glm::dvec3 sum_of(const std::vector<truth::Brought>& brought) {
    glm::dvec3 sum(0);
    for (const truth::Brought& one : brought) sum += one.radiance;
    return sum;
}

inline glm::dvec3 any_direction(truth::PathRandom& random) {
    const double z = 2 * random.unit() - 1, angle = 2 * std::numbers::pi * random.unit();
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace awan::test
