// Gardner's look at 800 x 600 and his ellipsoids as matter. Gardner 1985 gives a figure in words only ("image
// generation can be performed by small computers in a reasonable amount of time"); it has no table to set ours beside.
//   build/release/tests/ellipsoids_bench
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/generate/ellipsoids/lattice.h"
#include "core/generate/generate.h"
#include "core/looks/looks.h"
#include "tests/ellipsoids_scenes.h"

namespace awan {
namespace {

using ellipsoids::texture_at;
using ellipsoids::texture_function;
using ellipsoids::TextureFunction;

constexpr const char* kSource = "source: \"a reasonable amount of time\", no figure";

// One formation; the camera holds all of it.
SceneDraft formation_of(std::uint64_t count) {
    SceneDraft draft = test::scene_of(test::with_formation(FormationKind::kCombined, count));
    draft.look = Look::kGardner;
    draft.image.width = 800;
    draft.image.height = 600;
    return draft;
}

void draw(benchmark::State& state, const SceneDraft& draft, int threads) {
    const Scene scene = test::valid(draft);
    const Bounds bounds = bounds_of(*generate(scene, 1, {}, true));
    const View view = resolve_view(draft.camera, draft.image, bounds);
    for (auto _ : state) benchmark::DoNotOptimize(draw_look(scene, view, threads, {}));
    state.counters["estimate_ms"] = look_time_ms(scene, view, threads);
    state.SetLabel(kSource);
}

void GardnerLook(benchmark::State& state) {
    draw(state, formation_of(static_cast<std::uint64_t>(state.range(0))),
         static_cast<int>(state.range(1)));
}
BENCHMARK(GardnerLook)
    ->ArgNames({"ellipsoids", "threads"})
    ->ArgsProduct({{10, 100, 1000}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// A sky plane from the horizon to far above.
void GardnerSky(benchmark::State& state) {
    EllipsoidsCloud model;
    model.plane.emplace();
    SceneDraft draft = test::scene_of(model);
    draft.look = Look::kGardner;
    draft.image.width = 800;
    draft.image.height = 600;
    draft.camera.automatic = false;
    draft.camera.target = {0, 4, -10};
    draw(state, draft, static_cast<int>(state.range(0)));
}
BENCHMARK(GardnerSky)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void TextureInSpace(benchmark::State& state) {
    SineTexture texture;
    texture.terms = static_cast<std::uint64_t>(state.range(0));
    const TextureFunction function = texture_function(texture, true);
    glm::dvec3 p(0);
    for (auto _ : state) {
        p += glm::dvec3(0.01, 0.02, 0.03);
        benchmark::DoNotOptimize(texture_at(function, p));
    }
}
BENCHMARK(TextureInSpace)->ArgName("terms")->Arg(4)->Arg(7);

// The search for k.
void TextureScale(benchmark::State& state) {
    SineTexture texture;
    texture.terms = static_cast<std::uint64_t>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(texture_function(texture, true));
}
BENCHMARK(TextureScale)->ArgName("terms")->Arg(4)->Arg(7)->Unit(benchmark::kMicrosecond);

void EllipsoidsAsMatter(benchmark::State& state) {
    EllipsoidsCloud model = test::with_formation(FormationKind::kCombined, 40);
    model.resolution = static_cast<std::uint64_t>(state.range(0));
    const Scene scene = test::valid(test::scene_of(model));
    const auto threads = static_cast<int>(state.range(1));
    ParticleSet set;
    for (auto _ : state) set = *generate(scene, threads, {});
    state.counters["particles"] = static_cast<double>(set.size());
    state.counters["error"] = set.error;
}
BENCHMARK(EllipsoidsAsMatter)
    ->ArgNames({"resolution", "threads"})
    ->ArgsProduct({{32, 64, 128, 160}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace awan

BENCHMARK_MAIN();
