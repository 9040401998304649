// Both passes against the plain methods, and what share of the bare arithmetic they reach.
//   build/release/tests/passes_bench
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"
#include "core/draw/draw.h"
#include "core/light/light.h"
#include "core/scene/validate.h"
#include "tests/bench/baselines.h"
#include "tests/bench/paired.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// Table 4.4's shape (its large cubes) with `count` particles and about 16 million fragments at
// 10,000 of them, as thick as table 4.4; 800 x 600, one sun, no sky: one light pass and one eye
// pass, as in the papers.
SceneDraft cloud_of(std::uint64_t count) {
    SceneDraft draft = test::table_4_4();
    const double times = static_cast<double>(count) / 460, shrink = std::cbrt(0.09 / times);
    for (Cube& cube : draft.clouds[0].cubes) {
        cube.particles = static_cast<std::uint64_t>(static_cast<double>(cube.particles) * times);
        cube.radius *= shrink;
    }
    draft.density = 0.2 / (times * shrink * shrink * shrink);
    draft.sky.none = true;
    draft.image.background = Background::kTransparent;
    return draft;
}

struct Setting {
    Scene scene;
    Planned planned;
    Lighting lighting;
    SplatList splats;
    glm::dvec3 sun_in_frame;
};

Setting set_up(std::uint64_t count) {
    Scene scene = test::valid(cloud_of(count));
    Planned planned = *plan_scene(scene, 2, {});
    Lighting lighting = *light(scene, planned.particles, planned.plan, test::device(), {});
    const View& view = planned.survey.view;
    SplatList splats =
        make_splats(splat_setting(scene, planned.particles, view, planned.plan, lighting),
                    whole_picture(view, scene->image),
                    drawing_order(scene, planned.particles, view, planned.plan));
    const glm::dvec3 sun = sun_direction(scene->sun);
    const glm::dvec3 in_frame(glm::dot(sun, view.right), glm::dot(sun, view.up),
                              glm::dot(sun, view.forward));
    return {std::move(scene), std::move(planned), std::move(lighting), std::move(splats), in_frame};
}

bench::QuadSplats quads_of(const Setting& set) {
    const View& view = set.planned.survey.view;
    return {set.splats,
            800,
            600,
            view.tan_half_fov * view.aspect,
            view.tan_half_fov,
            set.sun_in_frame,
            set.scene->medium.g};
}

void run_light(const Setting& set) {
    benchmark::DoNotOptimize(
        light(set.scene, set.planned.particles, set.planned.plan, test::device(), {}));
}
void run_draw(const Setting& set) {
    benchmark::DoNotOptimize(draw(set.scene, set.planned.particles, set.planned.survey.view,
                                  set.planned.plan, set.lighting, test::device(), {}));
}

double gain_of(const Scene& scene) {
    return scene->medium.albedo * gathering_fraction(scene->medium, kSunGathering);
}

void BothPassesAgainstOneReadbackAParticle(benchmark::State& state) {
    const Setting set = set_up(static_cast<std::uint64_t>(state.range(0)));
    bench::ReadbackLight readback(set.planned.particles, sun_direction(set.scene->sun),
                                  gain_of(set.scene));
    bench::QuadSplats quads = quads_of(set);
    bench::paired(
        state,
        [&] {
            run_light(set);
            run_draw(set);
        },
        [&] {
            readback.run();
            quads.run();
        });
    state.counters["Mfragments"] = quads.fragments() / 1e6;
}
BENCHMARK(BothPassesAgainstOneReadbackAParticle)
    ->Arg(1000)
    ->Arg(10000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7);

void LightPassAgainstOneReadbackAParticle(benchmark::State& state) {
    const Setting set = set_up(static_cast<std::uint64_t>(state.range(0)));
    bench::ReadbackLight readback(set.planned.particles, sun_direction(set.scene->sun),
                                  gain_of(set.scene));
    bench::paired(
        state, [&] { run_light(set); }, [&] { readback.run(); });
}
BENCHMARK(LightPassAgainstOneReadbackAParticle)
    ->Arg(1000)
    ->Arg(10000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7);

void EyePassAgainstInstancedQuads(benchmark::State& state) {
    const Setting set = set_up(static_cast<std::uint64_t>(state.range(0)));
    bench::QuadSplats quads = quads_of(set);
    bench::paired(
        state, [&] { run_draw(set); }, [&] { quads.run(); });
    state.counters["Mfragments"] = quads.fragments() / 1e6;
}
BENCHMARK(EyePassAgainstInstancedQuads)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(50000)
    ->Arg(200000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7);

// The bare arithmetic of a fragment: two exponentials and the blend of four channels, as many lanes
// at a time as the machine has, everything in the first cache.
AWAN_INLINE float blend_row_body(float* left, float* light, int count, float start, float step,
                                 float tau) {
    for (int i = 0; i < count; ++i) {
        const float x = start + step * static_cast<float>(i);
        // exp(y) = 2^(y log2 e) by exponent bits and a cubic; y is never below -20 here
        const auto power = [](float y) __attribute__((always_inline)) {
            const float f = y * 1.442695F;
            const int whole = static_cast<int>(f) - 1;
            const float r = f - static_cast<float>(whole);
            const float p = 1 + r * (0.6951786F + r * (0.2276402F + r * 0.0781478F));
            const int bits = std::bit_cast<int>(p) + (whole << 23);
            return std::bit_cast<float>(bits);
        };
        const float depth = tau * power(-x * x);
        const float alpha = 1 - power(-depth);
        light[i] += left[i] * alpha * (0.5F + 0.1F * x) * 4;
        left[i] -= left[i] * alpha;
    }
    return left[count / 2];
}
AWAN_KERNEL(float, blend_row,
            (float* left, float* light, int count, float start, float step, float tau),
            (left, light, count, start, step, tau))

// Fragments that a picture needs: those within 4 s of a particle and not behind what is opaque.
double needed_fragments(const Setting& set) {
    const View& view = set.planned.survey.view;
    const double pixel = 2 * view.tan_half_fov / 600;
    std::vector<float> left(800 * 600, 1.F);
    double count = 0;
    for (const Splat& splat : set.splats.splats) {
        const double z = static_cast<double>(splat.place.z),
                     s = 1 / std::sqrt(2 * static_cast<double>(splat.place.w)) / z / pixel;
        const double cx = static_cast<double>(splat.place.x) / z / pixel + 400,
                     cy = 300 - static_cast<double>(splat.place.y) / z / pixel;
        for (int y = std::max(0, static_cast<int>(cy - 4 * s));
             y <= std::min(599, static_cast<int>(cy + 4 * s)); ++y)
            for (int x = std::max(0, static_cast<int>(cx - 4 * s));
                 x <= std::min(799, static_cast<int>(cx + 4 * s)); ++x) {
                const double d2 =
                    ((x + 0.5 - cx) * (x + 0.5 - cx) + (y + 0.5 - cy) * (y + 0.5 - cy)) / (s * s);
                float& t = left[static_cast<std::size_t>(y) * 800 + static_cast<std::size_t>(x)];
                if (d2 > 16 || t < 1e-4F) continue;
                count += 1;
                t *= static_cast<float>(
                    std::exp(-static_cast<double>(splat.matter.w) * std::exp(-d2 / 2)));
            }
    }
    return count;
}

void EyePassAgainstArithmeticFloor(benchmark::State& state) {
    const Setting set = set_up(static_cast<std::uint64_t>(state.range(0)));
    const double fragments = needed_fragments(set);
    const auto rows = static_cast<std::size_t>(fragments / 64);
    bench::paired(
        state, [&] { run_draw(set); },
        [&] {
            parallel_for(2, 2, [&](std::size_t) {
                std::vector<float> left(64, 1.F), light(64, 0.F);
                for (std::size_t r = 0; r < rows / 2; ++r)
                    benchmark::DoNotOptimize(
                        blend_row(left.data(), light.data(), 64, -3.F, 0.1F, 1e-6F));
            });
        });
    state.counters["Mfragments_needed"] = fragments / 1e6;
    state.counters["share_of_floor"] = state.counters["baseline_ms"] / state.counters["ours_ms"];
}
BENCHMARK(EyePassAgainstArithmeticFloor)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(50000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
