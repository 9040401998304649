// What pictures and light are kept in and how finely light is solved: chosen from these figures (table 4.4, g = .85,
// transport-32; "change": nRMSE of the picture; lit / backlit).
//   Transmittance and radiance: float32. Optical depth 1 in 1e5 layers, blended: float32 is off by 6e-6; half by 3% at
//   1e3
//     layers and does not fall at all from 1e4 on, 8 bit not at all from 1e3 on. double (1e-13) buys nothing that is
//     seen.
//   Light grid and sun's depth: float32, though half would do: it changes the picture by 7e-5 / 3e-5, a five-hundredth
//   of
//     transport-32's own error. 2.3 + 2.8 MB would become half of that; while lights are so small, the conversions are
//     not worth their code. Where memory counts (many kept lights of transport-64), half is the first thing to try.
//   SunDepth: 3 cells to one of the grid (96): 0.1% / 0.5% from 192. 64 cells: 0.2% / 1.5%; 32: 1.0% / 6.0%. It is a
//   small
//     part of the light pass's time at any of these.
//   Tolerance of the solve: 1e-3 (22 sweeps): 0.25% / 0.05%. 1e-2 (15 sweeps): 1.1% / 0.1%; 3e-4 (27): 0.04% / <.01%.
//   All are
//     below the grid's own 2-5%.
//   Steps of the march: step_error 0.01: 0.09% / 0.04%; 0.0025: 0.02% / 0.01%, for half as much time again.
//   build/release/tests/precision_bench
#include <benchmark/benchmark.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "core/draw/march.h"
#include "core/light/transport.h"
#include "tests/bench/cloud_of_bench.h"
#include "tests/bench/paired.h"

namespace awan {
namespace {

// --- blending
// ------------------------------------------------------------------------------------------------------------

float as_float(double x) {
    return static_cast<float>(x);
}
float as_half(float x) {
    return glm::unpackHalf1x16(glm::packHalf1x16(x));
}
double in_bytes(double x) {
    return std::round(x * 255) / 255;
}
double in_half(double x) {
    return static_cast<double>(as_half(as_float(x)));
}
double in_float(double x) {
    return static_cast<double>(as_float(x));
}
double in_double(double x) {
    return x;
}

struct Blended {
    double left = 1, light = 0;
};
double source_at(double depth) {  // of a typical ray: lit in front, darker in depth, not monotone
    return 0.3 + 0.5 * std::exp(-depth) + 0.1 * std::sin(5 * depth);
}
template <typename Store>
Blended blended(int layers, const Store& store) {
    Blended pixel;
    const double tau = 1.0 / layers, alpha = -std::expm1(-tau);
    for (int i = 0; i < layers; ++i) {
        pixel.light = store(pixel.light + pixel.left * alpha * source_at((i + 0.5) * tau));
        pixel.left = store(pixel.left * (1 - alpha));
    }
    return pixel;
}

// Layers of optical depth 1 in all, front to back. Counters: relative errors of transmittance and of radiance.
void ThinLayers(benchmark::State& state) {
    const auto layers = static_cast<int>(state.range(0));
    const Blended exact{std::exp(-1.0), blended(1'000'000, in_double).light};
    for (auto _ : state) benchmark::DoNotOptimize(blended(layers, in_float));
    const auto note = [&](const char* name, const Blended& pixel) {
        state.counters[std::string("left_") + name] = pixel.left / exact.left - 1;
        state.counters[std::string("light_") + name] = pixel.light / exact.light - 1;
    };
    note("8bit", blended(layers, in_bytes));
    note("half", blended(layers, in_half));
    note("float", blended(layers, in_float));
    note("double", blended(layers, in_double));
}
BENCHMARK(ThinLayers)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

// --- what the light is kept in
// -------------------------------------------------------------------------------------------

struct Stage {
    Scene scene;
    Planned planned;
};
Stage stage_of(bool backlit) {
    SceneDraft draft = bench::table_draft("transport-32", 400, 300);
    if (backlit) {  // the sun behind the cloud, a little above
        const Scene lit = test::valid(draft);
        const auto planned = plan_scene(lit, 2, {});
        draft.sun.direction = glm::normalize(planned->survey.view.forward + glm::dvec3(0, 0.3, 0));
    }
    Scene scene = test::valid(draft);
    Planned planned = *plan_scene(scene, 2, {});
    return {std::move(scene), std::move(planned)};
}
TransportLight light_of(const Stage& stage, const TransportSettings& settings) {
    return *transport_light(stage.scene, stage.planned.particles, stage.planned.survey, settings, 2,
                            {});
}
Image picture_of(const Stage& stage, const TransportLight& light, MarchSettings settings = {}) {
    return *march(stage.scene, stage.planned.particles, stage.planned.survey.view, light, settings,
                  2, {});
}

TransportLight halved(TransportLight light, bool moments, bool sun) {
    if (moments)
        for (LightBand& band : light.bands)
            for (auto& cell : band.moments)
                for (float& value : cell) value = as_half(value);
    if (sun)
        for (float& value : light.sun.depth) value = as_half(value);
    return light;
}

// Argument: sun in front, or behind. Counters: change of the picture by float16 moments, sun's depth, both; MB in
// float32.
void HalfPrecisionLight(benchmark::State& state) {
    const Stage stage = stage_of(state.range(0) != 0);
    const TransportLight light = light_of(stage, stage.planned.plan.transport);
    Image whole;
    for (auto _ : state) whole = picture_of(stage, light);
    const auto change = [&](bool moments, bool sun) {
        return bench::difference(picture_of(stage, halved(light, moments, sun)), whole);
    };
    state.counters["moments"] = change(true, false);
    state.counters["sun"] = change(false, true);
    state.counters["both"] = change(true, true);
    double floats = 0;
    for (const LightBand& band : light.bands)
        floats += static_cast<double>(band.moments.size()) * kHarmonics;
    state.counters["moments_MB"] = floats * 4e-6;
    state.counters["sun_MB"] = static_cast<double>(light.sun.depth.size()) * 4e-6;
}
BENCHMARK(HalfPrecisionLight)
    ->ArgName("backlit")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// --- how finely it is solved
// ---------------------------------------------------------------------------------------------

// Light with `settings` against light with `finest`: change of the picture, ms of the light pass.
void change_of(benchmark::State& state, TransportSettings settings, TransportSettings finest) {
    const Stage stage = stage_of(state.range(1) != 0);
    TransportLight light;
    std::vector<double> times;
    for (auto _ : state)
        times.push_back(bench::milliseconds([&] { light = light_of(stage, settings); }));
    state.counters["light_ms"] = bench::median(times);
    state.counters["sweeps"] = light.sweeps;
    state.counters["change"] =
        bench::difference(picture_of(stage, light), picture_of(stage, light_of(stage, finest)));
}

void SunDepthCells(benchmark::State& state) {
    TransportSettings settings, finest;
    settings.sun_cells = static_cast<int>(state.range(0));
    finest.sun_cells = 192;
    change_of(state, settings, finest);
}
BENCHMARK(SunDepthCells)
    ->ArgNames({"cells", "backlit"})
    ->ArgsProduct({{32, 48, 64, 96, 128}, {0, 1}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// Tolerance 1 / argument.
void Tolerance(benchmark::State& state) {
    TransportSettings settings, finest;
    settings.tolerance = 1.0 / static_cast<double>(state.range(0));
    finest.tolerance = 1e-5;
    finest.max_sweeps = 100;
    change_of(state, settings, finest);
}
BENCHMARK(Tolerance)
    ->ArgNames({"per", "backlit"})
    ->ArgsProduct({{100, 300, 1000, 3000, 10000}, {0, 1}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// The march's step error 1 / argument, against 1 / 10000: change of the picture.
void StepError(benchmark::State& state) {
    const Stage stage = stage_of(state.range(1) != 0);
    const TransportLight light = light_of(stage, stage.planned.plan.transport);
    Image image;
    for (auto _ : state)
        image = picture_of(stage, light, {1.0 / static_cast<double>(state.range(0))});
    state.counters["change"] = bench::difference(image, picture_of(stage, light, {1e-4}));
}
BENCHMARK(StepError)
    ->ArgNames({"per", "backlit"})
    ->ArgsProduct({{25, 100, 400, 1600}, {0, 1}})
    ->Iterations(3)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
