// Paths that the path tracer walks a second of one core. "primary" is the time a picture of two paths a pixel takes,
// most of which goes to where its rays meet the cloud.
//   build/release/tests/truth_bench
#include <benchmark/benchmark.h>

#include "core/planning.h"
#include "core/truth/path_tracer.h"
#include "server/document/json.h"
#include "server/document/presets.h"
#include "tests/scenes.h"

namespace awan {
namespace {

struct Case {
    const char* name;
    const char* preset;
    int width, height;
    std::uint32_t samples;
};
// Smooth and thin, smooth and deep, lumpy and deep, against the sun, between lumps of fog.
constexpr Case kCases[] = {{"implicit-cirrus", "implicit-cirrus", 80, 60, 128},
                           {"ellipsoids-stratus", "ellipsoids-stratus", 80, 60, 64},
                           {"cumulus", "cumulus", 80, 60, 32},
                           {"noon-cumulus", "noon-cumulus", 48, 30, 16},
                           {"noon-cumulus", "noon-cumulus", 48, 30, 2},
                           {"silver-lining", "silver-lining", 48, 30, 16}};

SceneDraft draft_of(const std::string& preset) {
    const auto document = with_preset("{\"preset\": \"" + preset + "\"}");
    return parse_scene(document.value()).value();
}

void Paths(benchmark::State& state) {
    const Case& one = kCases[state.range(0)];
    SceneDraft draft = draft_of(one.preset);
    draft.image.width = one.width;
    draft.image.height = one.height;
    draft.accuracy.rung = "truth";
    draft.accuracy.error.reset();
    const Scene scene = test::valid(draft);
    auto planned = plan_scene(scene, 1, {});
    TruthOptions options;
    options.samples = one.samples;
    options.whole_pixels = true;
    options.eye_effects = planned->plan.eye_effects();
    double scatterings = 0;
    for (auto _ : state) {
        const auto truth =
            trace_truth(scene, planned->particles, planned->survey.view, options, {}, {});
        scatterings = truth->scatterings;
        benchmark::DoNotOptimize(truth);
    }
    state.counters["paths_per_s"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * one.width * one.height * one.samples,
        benchmark::Counter::kIsRate);
    state.counters["scatterings"] = scatterings;
    state.SetLabel(std::string(one.name) + ", paths a pixel: " + std::to_string(one.samples));
}
BENCHMARK(Paths)
    ->DenseRange(0, static_cast<int>(std::size(kCases)) - 1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
