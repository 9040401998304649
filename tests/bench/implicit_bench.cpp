// Implicit clouds. Ebert 2002 states no time for a density; for scale, his animator spends "less than one minute to
// generate and animate the implicit particles for 200 frames" (300 ms a frame), which GrowFrames is beside.
//   build/release/tests/implicit_bench
#include <benchmark/benchmark.h>

#include <memory>

#include "core/generate/implicit/growth.h"
#include "core/generate/implicit/sampling.h"
#include "core/generate/models.h"

namespace awan {
namespace {

using implicit::Box;
using implicit::box_of;
using implicit::grown;
using implicit::ImplicitField;
using implicit::prepare_field;
using implicit::row_densities;

ImplicitCloud of_preset(std::int64_t preset) {
    ImplicitCloud cloud;
    cloud.preset = static_cast<ImplicitPreset>(preset);
    return cloud;
}

const char* name_of(std::int64_t preset) {
    constexpr const char* kNames[] = {"cumulus", "cirrus", "stratus", "mackerel", "creature"};
    return kNames[preset];
}

// Every point with all of the cloud's elements, one thread.
void Densities(benchmark::State& state) {
    const ImplicitField field = prepare_field(of_preset(state.range(0)), 1, 0);
    const Box box = box_of(field);
    std::vector<std::uint32_t> list(field.elements.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = static_cast<std::uint32_t>(i);
    constexpr int kRow = 256;
    float out[kRow];
    double at = 0;
    for (auto _ : state) {
        at = at > 0.98 ? 0.02 : at + 0.0137;
        const glm::dvec3 first = box.min + glm::dvec3(0, at, 0.5) * (box.max - box.min);
        row_densities(field, list, {first, (box.max.x - box.min.x) / kRow, kRow}, out);
        benchmark::DoNotOptimize(out);
    }
    state.counters["densities_per_s"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * kRow, benchmark::Counter::kIsRate);
    state.SetLabel(name_of(state.range(0)));
}
BENCHMARK(Densities)->DenseRange(0, 4);

// From the description to particles, its error stated too; resolution, threads.
void CumulusParticles(benchmark::State& state) {
    ImplicitCloud cloud = of_preset(0);
    cloud.resolution = static_cast<std::uint64_t>(state.range(0));
    ModelRequest request;
    request.threads = static_cast<int>(state.range(1));
    double particles = 0, error = 0;
    for (auto _ : state) {
        const Result<ModelParticles> made = implicit::make_particles(cloud, request, {});
        particles = static_cast<double>(made->particles.positions.size());
        error = made->error;
    }
    state.counters["particles"] = particles;
    state.counters["stated_error"] = error;
}
BENCHMARK(CumulusParticles)
    ->ArgsProduct({{64, 128}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void GrowFrames(benchmark::State& state) {
    const ImplicitGrowth growth;
    double time = 0;
    for (auto _ : state) {
        time = time > 59 ? 0 : time + 0.3;
        benchmark::DoNotOptimize(grown(growth, 1, time));
    }
    state.SetLabel("Ebert 2002: up to 300 ms a frame");
}
BENCHMARK(GrowFrames)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
