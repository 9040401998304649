// What effects cost: thin clouds beside thick ones as planned, and each effect on and off.
//   build/release/tests/effects_bench
#include <fstream>
#include <sstream>

#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/bench/paired.h"
#include "tests/scenes.h"

namespace awan {
namespace {

SceneDraft preset(const std::string& name) {
    std::ifstream in(std::string(AWAN_SOURCE_DIR "/web/presets/") + name + ".json");
    std::stringstream text;
    text << in.rdbuf();
    SceneDraft draft = *parse_scene(text.str());
    draft.image.width = 800;
    draft.image.height = 500;
    draft.accuracy = {};
    return draft;
}

std::uint64_t particles_of(const SceneDraft& draft) {
    std::uint64_t sum = 0;
    for (const Cloud& cloud : draft.clouds)
        for (const Cube& cube : cloud.cubes) sum += cube.particles;
    return sum;
}

// Its particles as many, of as much matter in all.
void scale_to(std::uint64_t wanted, SceneDraft& draft) {
    const double times = static_cast<double>(wanted) / static_cast<double>(particles_of(draft));
    for (Cloud& cloud : draft.clouds)
        for (Cube& cube : cloud.cubes) {
            const double more = static_cast<double>(cube.particles) * times;
            cube.density /= times;
            cube.particles = static_cast<std::uint64_t>(more + 0.5);
        }
}

auto pictures(const Scene& scene, int threads) {
    return [&scene, threads] {
        Tools tools;
        tools.device = &test::device();
        tools.threads = threads;
        benchmark::DoNotOptimize(render_scene(scene, tools, {}));
    };
}

constexpr int kThreads = 2;

// As planned when nothing is asked for: the thin cloud should be the cheaper.
void ThinBesideThick(benchmark::State& state) {
    SceneDraft thin = preset("cirrus");
    if (state.range(0) ==
        1) {  // so thin that the sun is seen through it undimmed, under a sky of two colours
        thin.density = 0.02;
        thin.detail.reset();
        thin.sky = {};
        thin.sun.auto_color = false;
    }
    SceneDraft thick = preset("cumulus-detailed");
    scale_to(particles_of(thin), thick);
    const Scene cirrus = test::valid(thin), cumulus = test::valid(thick);
    bench::paired(state, pictures(cirrus, kThreads), pictures(cumulus, kThreads));
}
BENCHMARK(ThinBesideThick)
    ->Arg(0)
    ->Arg(1)
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// fog-shafts has them all; times_faster: how much longer it takes with the effect on.
void WithoutEffect(benchmark::State& state) {
    const auto effect = static_cast<Effect>(state.range(0));
    SceneDraft draft = preset("fog-shafts");
    draft.image.width = 320;
    draft.image.height = 200;
    draft.accuracy.rung = "transport-24";
    const Scene with = test::valid(draft);
    draft.effects[state.range(0)] = Switch::kOff;
    const Scene without = test::valid(draft);
    state.SetLabel(effect_name(effect));
    bench::paired(state, pictures(without, kThreads), pictures(with, kThreads));
}
BENCHMARK(WithoutEffect)
    ->Arg(static_cast<int>(Effect::kSkyLight))
    ->Arg(static_cast<int>(Effect::kGroundLight))
    ->Arg(static_cast<int>(Effect::kGroundShadow))
    ->Arg(static_cast<int>(Effect::kSunColor))
    ->Arg(static_cast<int>(Effect::kAerialPerspective))
    ->Arg(static_cast<int>(Effect::kLightShafts))
    ->Arg(static_cast<int>(Effect::kDetail))
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
