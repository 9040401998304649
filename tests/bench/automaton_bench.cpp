// Cellular automata against the figures of their source: Upchurch 2009, on a 2.4 GHz Core 2 Duo, gives .3 s for a step
// of 256 x 20 x 256 cells with its smoothing and .3 s for the tables of probability of 100 ellipsoids; Dobashi et al.
// 2000 .5 s a step.
//   build/release/tests/automaton_bench
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdio>

#include "core/base/parallel.h"
#include "core/generate/automaton/cells_to_particles.h"
#include "core/generate/automaton/kept_states.h"
#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/run.h"
#include "core/generate/models.h"
#include "tests/bench/cloud_of_bench.h"

namespace awan {
namespace {

using automaton::AutomatonGrid;
using automaton::AutomatonScratch;
using automaton::FallOff;
using automaton::first_ellipsoids;
using automaton::make_fall_off;
using automaton::PlaneSmoother;
using automaton::run_automaton;
using automaton::step_automaton;

constexpr double kSourceMs = 300;

AutomatonCloud cloud_of(double nx, double ny, double nz, std::uint64_t ellipsoids) {
    AutomatonCloud cloud;
    cloud.cells = {nx, ny, nz};
    RandomEllipsoids random;
    random.count = ellipsoids;
    random.smallest = {8, 4, 8};
    random.largest = {30, 8, 30};
    cloud.random = random;
    return cloud;
}

void name_it(benchmark::State& state, const AutomatonCloud& cloud, const char* what) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    state.SetLabel(what);
    state.counters["ns_per_cell"] = benchmark::Counter(
        cells / 1e9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["per_source_step"] =
        benchmark::Counter(kSourceMs / 1e3, benchmark::Counter::kIsIterationInvariantRate);
}

struct Grown {
    AutomatonScratch scratch;
    AutomatonState state;
};

Grown grown(const AutomatonCloud& cloud, int threads) {
    Grown it;
    it.state = *run_automaton(cloud, 1, 40, threads, {}, it.scratch);
    return it;
}

// All of a sky's densities, as counts.
void smooth_all(const AutomatonCloud& cloud, const AutomatonState& state, int threads,
                std::vector<std::uint16_t>& counts) {
    const AutomatonGrid grid(cloud.cells);
    const std::size_t planes = 16, plane = grid.ny * grid.words * 64;
    counts.resize(grid.nz * plane);
    parallel_for(threads, (grid.nz + planes - 1) / planes, [&](std::size_t n) {
        PlaneSmoother smoother(grid, {&state.cld}, {1, 1, 1});
        for (std::size_t k = n * planes; k < std::min((n + 1) * planes, grid.nz); ++k) {
            const PlaneSmoother::Plane p = smoother.plane(k);
            for (std::size_t j = 0; j < grid.ny; ++j) {
                std::uint16_t* const to = &counts[k * plane + j * p.stride];
                if (p.rows[j] != 0)
                    std::copy_n(p.counts + j * p.stride, p.stride, to);
                else
                    std::fill_n(to, p.stride, std::uint16_t{0});
            }
        }
    });
}

// Arguments: threads; 1: steps, 2: smoothing, 3: both.
void SourceStep(benchmark::State& state) {
    const AutomatonCloud cloud = cloud_of(256, 20, 256, 100);
    const auto threads = static_cast<int>(state.range(0));
    Grown it = grown(cloud, threads);
    std::vector<std::uint16_t> counts;
    const auto what = state.range(1);
    for (auto _ : state) {
        if ((what & 1) != 0) {
            const Status late = step_automaton(cloud, threads, {}, it.scratch, it.state);
            benchmark::DoNotOptimize(late.has_value());
        }
        if ((what & 2) != 0) smooth_all(cloud, it.state, threads, counts);
        benchmark::DoNotOptimize(counts.data());
    }
    name_it(state, cloud,
            what == 1   ? "256x20x256, the step; source .3 s with smoothing"
            : what == 2 ? "256x20x256, the smoothing; source .3 s with the step"
                        : "256x20x256, step and smoothing; source .3 s");
}
BENCHMARK(SourceStep)
    ->ArgsProduct({{1, 2}, {1, 2, 3}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void Probabilities(benchmark::State& state) {
    const AutomatonCloud cloud = cloud_of(256, 20, 256, 100);
    const AutomatonGrid grid(cloud.cells);
    const auto ellipsoids = first_ellipsoids(cloud, 1);
    FallOff fall_off;
    for (auto _ : state) {
        const Status late = make_fall_off(grid, ellipsoids, cloud.overlap, cloud.base,
                                          static_cast<int>(state.range(0)), {}, fall_off);
        benchmark::DoNotOptimize(late.has_value());
    }
    name_it(state, cloud, "tables of 100 ellipsoids; source .3 s");
}
BENCHMARK(Probabilities)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// A frame of a sequence of the source's automaton, 640 x 400: from the step before to the picture. Upchurch 2009 drew
// 15 a second on a GTX 260, without light. Arguments: 0: what previews show, by light (rung single); 1: billboards of
// the look upchurch, 2: its points by density, 3: by presence.
void Played(benchmark::State& state) {
    AutomatonCloud cloud = cloud_of(256, 20, 256, 100);
    cloud.kept = std::make_shared<automaton::KeptStates>(std::size_t{64} << 20);
    const auto what = state.range(0);
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.push_back({});
    draft.clouds[0].model = CloudModel::kAutomaton;
    draft.image.width = 640;
    draft.image.height = 400;
    draft.camera.automatic = false;
    draft.camera.eye = {0, 250, 1500};
    if (what == 0)
        draft.accuracy.rung = "single";
    else
        draft.look = Look::kUpchurch;
    cloud.drawing.mode = what == 1   ? AutomatonMode::kGenerated
                         : what == 2 ? AutomatonMode::kDensity
                                     : AutomatonMode::kPresence;
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(cloud);
    const auto frame = [&] {
        const Scene scene = what == 0 ? for_preview(test::valid(draft)) : test::valid(draft);
        auto planned = plan_scene(scene, 2, {});
        if (what == 0) planned = as_preview(scene, *std::move(planned));
        return render_planned(scene, *std::move(planned), {nullptr, 2, nullptr, {}, {}}, {})
            ->image.pixels.size();
    };
    frame();
    for (auto _ : state) {
        draft.time += 1;
        benchmark::DoNotOptimize(frame());
    }
    state.counters["frames"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Played)->DenseRange(0, 3)->UseRealTime()->Unit(benchmark::kMillisecond);

// Forty steps to a cloud, all of it.
void DefaultCloud(benchmark::State& state) {
    const AutomatonCloud cloud;
    ModelRequest request;
    request.threads = static_cast<int>(state.range(0));
    double particles = 0;
    for (auto _ : state)
        particles = static_cast<double>(
            automaton::make_particles(cloud, request, {})->particles.positions.size());
    state.counters["particles"] = particles;
}
BENCHMARK(DefaultCloud)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// What blocks of cells cost a picture: rms over rms of cloud pixels, beside one Gaussian a cell. Arguments: side of a
// block; 0: all of the field in the picture, 1: one cloud from near by; the metaballs' radius, tenths of a cell.
void Blocks(benchmark::State& state) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.push_back({});
    draft.clouds[0].model = CloudModel::kAutomaton;
    draft.density = 0.6;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = "transport-32";
    if (state.range(1) == 1) {
        draft.camera.automatic = false;
        draft.camera.eye = {0, 20, 330};
        draft.camera.target = {0, 50, 0};
    }
    const auto render = [&](std::uint64_t most) {
        AutomatonCloud cloud;
        cloud.metaball_radius = static_cast<double>(state.range(2)) / 10;
        cloud.most_particles = most;
        draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(cloud);
        return *render_scene(test::valid(draft), {nullptr, 2, nullptr, {}, {}}, {});
    };
    const Image cells = render(1u << 20).image;
    const double block = static_cast<double>(state.range(0));
    // As many blocks as cells over their volume, and those that are partly full.
    const auto most = static_cast<std::uint64_t>(43063 / (block * block * block) * 2.2 + 50);
    for (auto _ : state) {
        const auto coarse = render(most);
        state.counters["error"] = bench::difference(coarse.image, cells);
        state.counters["blocks"] = static_cast<double>(coarse.survey.particles);
    }
}
BENCHMARK(Blocks)
    ->ArgsProduct({{2, 4, 8}, {0, 1}, {15, 20, 30}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// The largest grid there may be, and the memory it takes.
void LargestGrid(benchmark::State& state) {
    AutomatonCloud cloud = cloud_of(1024, 64, 1024, 1000);
    cloud.warm_up = static_cast<std::uint64_t>(state.range(0));
    cloud.steps_per_second = 0.5;  // and one between two steps
    ModelRequest request;
    request.threads = 2;
    request.time = 1;
    double particles = 0, error = 0;
    for (auto _ : state) {
        const auto made = automaton::make_particles(cloud, request, {});
        particles = static_cast<double>(made->particles.positions.size());
        error = made->error;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024;
    state.counters["particles"] = particles;
    state.counters["error"] = error;
    name_it(state, cloud, "1024x64x1024: all steps and the particles");
}
BENCHMARK(LargestGrid)->Arg(20)->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
