// Filling cubes on one core, against the figure of Sunar et al. 2005 and against a plain pseudo-random fill.
//   build/release/tests/fill_bench
#include <random>

#include "core/generate/cubes.h"
#include "core/generate/generate.h"
#include "core/survey/survey.h"
#include "tests/bench/paired.h"
#include "tests/scenes.h"

namespace awan {
namespace {

SceneDraft one_cube(Fill fill, std::uint64_t count) {
    SceneDraft draft;
    draft.clouds.push_back({});
    draft.clouds[0].cubes = {{count, {8, 7, 3}, {10, 10, 10}, 2.5, 1, {}}};
    draft.fill = fill;
    return draft;
}

// A Mersenne twister and the library's uniform distribution, four numbers a particle.
ParticleSet plain_fill(const Cube& cube) {
    ParticleSet set;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::uint64_t i = 0; i < cube.particles; ++i) {
        set.center.push_back(cube.center + cube.size * glm::dvec3(uniform(random), uniform(random),
                                                                  uniform(random)));
        set.radius.push_back(static_cast<float>(cube.radius * (uniform(random) + 0.5)));
        set.density.push_back(1);
    }
    return set;
}

void FillAgainstPlainRandom(benchmark::State& state) {
    const Scene scene = test::valid(one_cube(static_cast<Fill>(state.range(0)), 50000));
    bench::paired(
        state, [&] { benchmark::DoNotOptimize(generate(scene, 1, {})); },
        [&] { benchmark::DoNotOptimize(plain_fill(scene->clouds[0].cubes[0])); });
    state.counters["Mparticles_per_s"] = 50000 / state.counters["ours_ms"] / 1e3;
    state.SetLabel(state.range(0) == 0 ? "uniform" : state.range(0) == 1 ? "gardner" : "printed");
}
BENCHMARK(FillAgainstPlainRandom)
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(31);

// The points alone, into memory that is there already.
void FillCubeAlone(benchmark::State& state) {
    const Scene scene = test::valid(one_cube(Fill::kUniform, 50000));
    std::vector<FilledParticle> out(50000);
    for (auto _ : state) {
        fill_cube(scene->clouds[0].cubes[0], Fill::kUniform, 1, 0, 50000, out.data());
        benchmark::DoNotOptimize(out.data());
    }
}
BENCHMARK(FillCubeAlone)->Unit(benchmark::kMillisecond);

void SurveyOf(benchmark::State& state) {
    SceneDraft draft = test::table_4_4();
    for (Cube& cube : draft.clouds[0].cubes)
        cube.particles = cube.particles * static_cast<std::uint64_t>(state.range(0)) / 460;
    const Scene scene = test::valid(draft);
    const ParticleSet particles = *generate(scene, 1, {});
    for (auto _ : state) benchmark::DoNotOptimize(survey(scene, particles, 2, {}));
}
BENCHMARK(SurveyOf)->Arg(460)->Arg(10000)->Arg(200000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
