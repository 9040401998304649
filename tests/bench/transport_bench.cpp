// What the transport rungs cost, as ratios within one run: table 4.4 at 800 x 600, g = .85.
//   build/release/tests/transport_bench
#include <cmath>
#include <ctime>

#include "core/accuracy/error_measures.h"
#include "core/draw/march.h"
#include "core/truth/path_tracer.h"
#include "tests/bench/cloud_of_bench.h"
#include "tests/bench/paired.h"
#include "tests/plain_sweep.h"

namespace awan {
namespace {

constexpr int kThreads = 2;

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Tools tools_with(LightCache* lights) {
    return {&test::device(), kThreads, lights, {}, {}};
}

// Seen as the library does by default: with a sky.
SceneDraft shown(const std::string& rung) {
    SceneDraft draft = bench::table_draft(rung);
    draft.image.background = Background::kSky;
    return draft;
}

Rendered rendered(const Scene& scene, LightCache* lights = nullptr) {
    return *render_scene(scene, tools_with(lights), {});
}

// times_faster of `paired`, turned over: times the baseline.
void note_times(benchmark::State& state) {
    state.counters["times_harris"] = 1 / state.counters["times_faster"];
}

// Argument: cells. times_harris: whole render over harris's, median of neighbours; cpu_times_harris: CPU time likewise.
void WholeRenderAgainstHarris(benchmark::State& state) {
    const Scene ours = test::valid(shown("transport-" + std::to_string(state.range(0))));
    const Scene harris = test::valid(shown("harris"));
    std::vector<double> light, draw, cpu, baseline_cpu;
    bench::paired(
        state,
        [&] {
            const double start = cpu_ms();
            const Rendered one = rendered(ours);
            cpu.push_back(cpu_ms() - start);
            light.push_back(one.times.light_ms);
            draw.push_back(one.times.draw_ms);
        },
        [&] {
            const double start = cpu_ms();
            benchmark::DoNotOptimize(rendered(harris));
            baseline_cpu.push_back(cpu_ms() - start);
        });
    note_times(state);
    state.counters["cpu_ms"] = bench::median(cpu);
    state.counters["cpu_times_harris"] = bench::median(cpu) / bench::median(baseline_cpu);
    state.counters["light_ms"] = bench::median(light);
    state.counters["draw_ms"] = bench::median(draw);
}
BENCHMARK(WholeRenderAgainstHarris)
    ->Arg(16)
    ->Arg(24)
    ->Arg(32)
    ->Arg(48)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7);

// The camera moves on, the light is kept; harris whole, as it always is.
void SecondCameraAgainstHarris(benchmark::State& state) {
    const Scene first = test::valid(shown("transport-32"));
    const View view = rendered(test::valid(shown("harris"))).survey.view;
    SceneDraft moved = shown("transport-32");
    moved.camera.automatic = false;
    moved.camera.eye = view.eye + 0.5 * view.right;
    moved.camera.target = moved.camera.eye + view.forward;
    const Scene second = test::valid(moved);
    const Scene harris = test::valid(shown("harris"));
    LightCache lights(std::size_t{1} << 30);
    (void)rendered(first, &lights);
    bool kept = true;
    std::vector<double> draw;
    bench::paired(
        state,
        [&] {
            const Rendered one = rendered(second, &lights);
            kept = kept && one.light_was_kept;
            draw.push_back(one.times.draw_ms);
        },
        [&] { benchmark::DoNotOptimize(rendered(harris)); });
    note_times(state);
    state.counters["light_was_kept"] = kept ? 1 : 0;
    state.counters["draw_ms"] = bench::median(draw);
}
BENCHMARK(SecondCameraAgainstHarris)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(7);

// Arguments: cells along the longest side, threads. us_per_cell: of the light pass from nothing, CPU time, all cells
// and sweeps.
void LightPassByCells(benchmark::State& state) {
    const Scene scene = test::valid(bench::table_draft("transport-32"));
    const Planned planned = *plan_scene(scene, kThreads, {});
    TransportSettings settings;
    settings.cells = static_cast<int>(state.range(0));
    const auto threads = static_cast<int>(state.range(1));
    TransportLight light;
    std::vector<double> wall, cpu;
    for (auto _ : state) {
        const double start = cpu_ms();
        wall.push_back(bench::milliseconds([&] {
            light =
                *transport_light(scene, planned.particles, planned.survey, settings, threads, {});
        }));
        cpu.push_back(cpu_ms() - start);
    }
    const double cells = static_cast<double>(light.cells.x) * light.cells.y * light.cells.z;
    state.counters["cells"] = cells;
    state.counters["wall_ms"] = bench::median(wall);
    state.counters["cpu_ms"] = bench::median(cpu);
    state.counters["us_per_cell"] = 1e3 * bench::median(cpu) / cells;
    state.counters["sweeps"] = light.sweeps;
    state.counters["ns_per_cell_sweep"] = 1e6 * bench::median(cpu) / cells / light.sweeps;
}
BENCHMARK(LightPassByCells)
    ->ArgsProduct({{16, 24, 32, 48, 64}, {1, kThreads}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

// Argument: cells along a side. One sweep on one thread against the plain one of the tests, and against its arithmetic:
// operations on sixteen floats that a cell needs, two a cycle, of which there are cycles_per_ns.
void SweepAgainstThePlainOne(benchmark::State& state) {
    const auto side = static_cast<int>(state.range(0));
    const test::Uneven scene = test::uneven({side, side, side}, 16);
    const Ordinates ordinates = make_ordinates();
    const SweepSource source{scene.source, scene.scale, scene.even};
    const Inflow dark = [](const glm::dvec3&) { return 0.0; };
    constexpr int kChain = 1'000'000;
    std::vector<float> moments(scene.source.size());
    SweepSpace space;
    std::vector<double> ours, plain, imul;
    for (auto _ : state) {
        double start = cpu_ms();
        sweep(scene.grid, ordinates, source, {}, 1, space, {moments});
        ours.push_back(cpu_ms() - start);
        start = cpu_ms();
        benchmark::DoNotOptimize(test::plain_sweep(scene, source, ordinates, dark));
        plain.push_back(cpu_ms() - start);
        // A chain of multiplications, three cycles each, tells the clock.
        start = cpu_ms();
        std::uint64_t product = 3;
        for (int i = 0; i < kChain; ++i) asm volatile("imul %0, %0" : "+r"(product));
        imul.push_back(cpu_ms() - start);
    }
    // Of a cell and each way along z: sources 16 products, 12 + 8 sums and 6 of scale and even light; what crossing
    // takes 26, and two divisions of sixteen cycles, or 64 operations; four octants of 19; moments 16 products, 8 + 15
    // sums, and 30 that move lanes.
    constexpr double kOperations = 2 * (16 + 12 + 8 + 6 + 26 + 64 + 4 * 19 + 16 + 8 + 15 + 30);
    const double cycles_per_ns = 3.0 * kChain / (1e6 * bench::median(imul));
    const double ns = 1e6 * bench::median(ours) / static_cast<double>(scene.grid.size());
    state.counters["times_plain"] = bench::median(plain) / bench::median(ours);
    state.counters["ns_per_cell"] = ns;
    state.counters["cycles_per_ns"] = cycles_per_ns;
    state.counters["share_of_floor"] = kOperations / (2 * cycles_per_ns) / ns;
}
BENCHMARK(SweepAgainstThePlainOne)
    ->Arg(16)
    ->Arg(32)
    ->Arg(64)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

// Table 4.4's cubes with `count` particles, as much of the space filled and as thick.
Scene cloud_of(std::uint64_t count) {
    SceneDraft draft = shown("transport-32");
    const double times = static_cast<double>(count) / 460, shrink = std::cbrt(0.09 / times);
    for (Cube& cube : draft.clouds[0].cubes) {
        cube.particles = static_cast<std::uint64_t>(static_cast<double>(cube.particles) * times);
        cube.radius *= shrink;
    }
    draft.density = 0.2 / (times * shrink * shrink * shrink);
    return test::valid(draft);
}

// Argument: how many. So many particles over ten thousand in the same volume: light pass, eye pass and all of it; cpu:
// of a processor's time.
void ManyParticlesAgainstTenThousand(benchmark::State& state) {
    const Scene many = cloud_of(static_cast<std::uint64_t>(state.range(0))), few = cloud_of(10'000);
    std::vector<double> light, draw, other, whole, cpu;
    StageTimes last;
    for (auto _ : state) {
        StageTimes times[2];
        double all[2], processor[2];
        for (int i = 0; i < 2; ++i) {
            const double start = cpu_ms();
            all[i] = bench::milliseconds([&] { times[i] = rendered(i == 0 ? many : few).times; });
            processor[i] = cpu_ms() - start;
        }
        cpu.push_back(processor[0] / processor[1]);
        light.push_back(times[0].light_ms / times[1].light_ms);
        draw.push_back(times[0].draw_ms / times[1].draw_ms);
        other.push_back((times[0].generate_ms + times[0].survey_ms) /
                        (times[1].generate_ms + times[1].survey_ms));
        whole.push_back(all[0] / all[1]);
        last = times[0];
    }
    state.counters["light_ratio"] = bench::median(light);
    state.counters["draw_ratio"] = bench::median(draw);
    state.counters["generate_survey_ratio"] = bench::median(other);
    state.counters["whole_ratio"] = bench::median(whole);
    state.counters["cpu_ratio"] = bench::median(cpu);
    state.counters["generate_ms"] = last.generate_ms;
    state.counters["survey_ms"] = last.survey_ms;
    state.counters["light_ms"] = last.light_ms;
    state.counters["draw_ms"] = last.draw_ms;
}
BENCHMARK(ManyParticlesAgainstTenThousand)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(4'000'000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

// CPU time of transport-32 at 800 x 600 over what the path tracer would need until its noise is transport-32's error.
// The error is against a small reference; the tracer's time and noise per sample are measured there too, and noise goes
// with 1 / sqrt(samples), time with samples and pixels.
void EqualErrorAgainstPaths(benchmark::State& state) {
    const Scene small = test::valid(bench::table_draft("transport-32", 80, 60));
    const Scene large = test::valid(bench::table_draft("transport-32"));
    const Planned planned = *plan_scene(small, kThreads, {});
    TruthOptions options;
    options.samples = static_cast<std::uint32_t>(state.range(0));
    options.threads = kThreads;
    double start = cpu_ms();
    const TruthImage truth =
        *trace_truth(small, planned.particles, planned.survey.view, options, {}, {});
    const double path_ms = (cpu_ms() - start) / (80.0 * 60 * options.samples);
    std::vector<double> cpu;
    for (auto _ : state) {
        start = cpu_ms();
        benchmark::DoNotOptimize(rendered(large));
        cpu.push_back(cpu_ms() - start);
    }
    const PictureError error = picture_error(rendered(small).image, truth);
    const double samples = options.samples * std::pow(error.truth_noise / error.nrmse, 2);
    state.counters["error"] = error.nrmse;
    state.counters["error_noise"] = error.nrmse_noise;
    state.counters["ours_cpu_ms"] = bench::median(cpu);
    state.counters["us_per_path"] = 1e3 * path_ms;
    state.counters["noise_of_one_path"] =
        error.truth_noise * std::sqrt(static_cast<double>(options.samples));
    state.counters["samples_needed"] = samples;
    state.counters["paths_cpu_s"] = 800e-3 * 600 * samples * path_ms;
    state.counters["times_less_cpu"] = 800 * 600 * samples * path_ms / bench::median(cpu);
}
BENCHMARK(EqualErrorAgainstPaths)->Arg(1024)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
