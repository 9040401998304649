// Clouds of spheres beside the figures of Ostroushko et al. 2010, table 1, pictures of 800 x 600 by ray tracing on one
// core of a Core 2 Duo E6600. The look draws what they drew; the volume path lights the same cloud as real clouds are.
//   build/release/tests/spheres_bench
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <ctime>

#include "core/generate/generate.h"
#include "core/looks/looks.h"
#include "core/looks/ostroushko_tile.h"
#include "core/pipeline.h"
#include "core/scene/spheres.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// Milliseconds of their table 1, by the number of levels: 15,625, 390,625 and 9,765,625 spheres.
double source_ms(std::int64_t levels) {
    return levels == 6 ? 4750 : levels == 8 ? 9203 : 22116;
}

Scene scene_of(std::int64_t levels, Look look) {
    SpheresCloud spheres;
    spheres.levels = static_cast<std::uint64_t>(levels);
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.look = look;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kSpheres;
    cloud.spheres = std::make_shared<SpheresCloud>(spheres);
    draft.camera.automatic = false;  // fills the picture's width
    draft.camera.eye = {330, -40, 450};
    draft.camera.target = {0, 80, 0};
    draft.camera.fov = 45;
    return test::valid(draft);
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Of all threads: what a machine shared with others does not change much.
double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

void finish(benchmark::State& state, double milliseconds) {
    const double each = milliseconds / static_cast<double>(state.iterations());
    state.counters["cpu_ms"] = each;
    state.counters["source_ms"] = source_ms(state.range(0));
    state.counters["source_over_cpu"] = source_ms(state.range(0)) / each;
    state.counters["peak_MB"] = peak_megabytes();  // of the process so far
}

// The whole picture with its sky; range: levels, threads.
void OstroushkoLook(benchmark::State& state) {
    const Scene scene = scene_of(state.range(0), Look::kOstroushko);
    const View view = resolve_view(scene->camera, scene->image, {});
    const auto threads = static_cast<int>(state.range(1));
    double sum = 0;
    for (auto _ : state) {
        const double start = cpu_ms();
        benchmark::DoNotOptimize(ostroushko_look(scene, view, threads, {}));
        sum += cpu_ms() - start;
    }
    finish(state, sum);
    state.counters["forecast_ms"] = ostroushko_look_ms(scene, view, threads);
}

// The hierarchy as Gaussians, as deep as the picture needs.
void SpheresAsGaussians(benchmark::State& state) {
    const Scene scene = scene_of(state.range(0), Look::kPhysical);
    const auto threads = static_cast<int>(state.range(1));
    double sum = 0;
    std::size_t count = 0;
    for (auto _ : state) {
        const double start = cpu_ms();
        const auto made = generate(scene, threads, {});
        sum += cpu_ms() - start;
        count = made->size();
        state.counters["stated_error"] = made->error;
    }
    finish(state, sum);
    state.counters["gaussians"] = static_cast<double>(count);
}

// All of a picture on the way of light: generated, surveyed, planned for the usual error, lit and drawn.
void SpheresLit(benchmark::State& state) {
    const Scene scene = scene_of(state.range(0), Look::kPhysical);
    Tools tools;
    tools.threads = static_cast<int>(state.range(1));
    double sum = 0;
    for (auto _ : state) {
        const double start = cpu_ms();
        SceneDraft draft = *scene;
        draft.accuracy.rung = "transport-32";
        const auto rendered = render_scene(test::valid(draft), tools, {});
        sum += cpu_ms() - start;
        if (!rendered.ok()) state.SkipWithError(rendered.error().message.c_str());
    }
    finish(state, sum);
}

void levels_and_threads(benchmark::internal::Benchmark* bench) {
    for (const int levels : {6, 8, 10})
        for (const int threads : {1, 2}) bench->Args({levels, threads});
    bench->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);
}
BENCHMARK(OstroushkoLook)->Apply(levels_and_threads);
BENCHMARK(SpheresAsGaussians)->Apply(levels_and_threads);
BENCHMARK(SpheresLit)->Apply(levels_and_threads);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
