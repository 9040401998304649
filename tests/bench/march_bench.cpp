// The eye pass of the transport rungs, with a light that costs nothing to make.
//   build/release/tests/march_bench
#include <array>
#include <cmath>

#include "tests/bench/paired.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

// Table 4.4, or its shape with more and smaller particles, as thick.
SceneDraft cloud_of(std::uint64_t count) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 800;
    draft.image.height = 600;
    if (count == 460) return draft;
    const double times = static_cast<double>(count) / 460, shrink = std::cbrt(0.09 / times);
    for (Cube& cube : draft.clouds[0].cubes) {
        cube.particles = static_cast<std::uint64_t>(static_cast<double>(cube.particles) * times);
        cube.radius *= shrink;
    }
    draft.density = 0.2 / (times * shrink * shrink * shrink);
    return draft;
}

// As smooth as a solver's: a grid of 32 cells, 96 nodes of the sun's depth, 3 bands.
TransportLight light_of(const test::Stage& stage) {
    TransportLight light =
        test::grid_light(stage.scene, stage.particles, 32, 3, [](const glm::dvec3& p) {
            return 1 + 0.3 * std::sin(p.x) + 0.3 * std::cos(1.7 * p.y + p.z);
        });
    const test::Around box = test::around(stage.particles, 1);
    ParticleSet few;  // of the same place and depth
    for (int i = 0; i < 6; ++i) {
        few.center.push_back(box.center + box.half * 0.3 * glm::dvec3(i % 3 - 1, i % 2 - 0.5, 0));
        few.radius.push_back(static_cast<float>(box.half / 3));
        few.density.push_back(static_cast<float>(20 / box.half));
    }
    const test::Around small = test::around(few, 1);
    light.sun = test::exact_sun(stage.scene, few, 96, box.half / small.half);
    return light;
}

void March(benchmark::State& state) {
    const test::Stage stage = test::stage(cloud_of(static_cast<std::uint64_t>(state.range(0))));
    const TransportLight light = light_of(stage);
    const auto threads = static_cast<int>(state.range(1));
    for (auto _ : state) benchmark::DoNotOptimize(test::marched(stage, light, threads));
}
BENCHMARK(March)
    ->ArgsProduct({{460, 10000, 200000}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
