#include "server/cli/source_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/flight_path.h"
#include "core/generate/automaton/run.h"
#include "core/generate/automaton/smooth.h"
#include "core/generate/generate.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/implicit.h"
#include "core/scene/spheres.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "server/cli/support.h"

namespace awan {
namespace {

// Of a figure; more where one is short.
constexpr int kRuns = 5;
// A figure that takes longer is not run again, ms.
constexpr double kLong_ms = 4000;

struct Bench {
    const BenchWish& wish;
    const std::function<void(const std::string&)>& begin;
    const std::function<void(BenchFigure)>& take;
    const Deadline& deadline;
    std::optional<Device> device;
    MachineSpeed speed = measure_speed();
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// What `run` takes, ms: the median of several, the first of them not counted. An error ends it.
template <typename Run>
Result<double> median_ms(const Run& run) {
    std::vector<double> times;
    for (int i = 0; i <= kRuns; ++i) {
        const auto start = Deadline::Clock::now();
        if (Status failed = run()) return *failed;
        const double took = ms_since(start);
        if (i > 0 || took > kLong_ms) times.push_back(took);
        if (took > kLong_ms) break;
    }
    return median(std::move(times));
}

// "9,765,625"
std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
    return text;
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

// --- cubes: filling, and frames a second

// The layout of its table 4.2 with so many particles in all, half of them in the first cube.
SceneDraft table_4_2(std::uint64_t particles, Fill fill) {
    SceneDraft draft;
    draft.fill = fill;
    draft.clouds.push_back({});
    const std::uint64_t second = particles * 3 / 10, third = particles / 5;
    draft.clouds[0].cubes = {{particles - second - third, {8, 3, 7}, {0, 0, 0}, 2.5, 1, {}},
                             {second, {5, 3, 3}, {5, 2, -4}, 2.9, 1, {}},
                             {third, {6, 2, 4}, {-5, -1, 3}, 3, 1, {}}};
    return draft;
}

Status filling(Bench& bench) {
    struct Fill {
        std::uint64_t particles;
        std::optional<double> theirs;
    };
    for (const auto& [particles, theirs] :
         {Fill{1000, 1.0}, Fill{10000, std::nullopt}, Fill{50000, 90.0}}) {
        const std::string what = "filling " + grouped(particles) + " particles";
        bench.begin(what);
        SceneDraft draft = table_4_2(particles, awan::Fill::kPrinted);
        // How deep the cloud is to be is not looked for, as it is not there.
        draft.density = 1;
        const auto scene = validate(std::move(draft));
        if (!scene.ok()) return scene.error();
        const auto ms = median_ms([&]() -> Status {
            const auto made = generate(*scene, 1, bench.deadline);
            if (!made.ok()) return made.error();
            return std::nullopt;
        });
        if (!ms.ok()) return ms.error();
        bench.take(
            {BenchSource::kCubes, "figure 5.1", what, BenchUnit::kMilliseconds, theirs, *ms});
    }
    return std::nullopt;
}

// Frames a second of an orbit: drawing alone, as there; the light is made before.
Result<double> frames_a_second(Bench& bench, const SceneDraft& draft, const char* rung,
                               std::optional<Thickness> thickness) {
    constexpr std::uint64_t kFrames = kRuns + 1;
    FlightWish wish;
    wish.path = FlightPath::kOrbit;
    wish.thickness = thickness;
    wish.frames = kFrames;
    wish.rung = rung;
    auto flight = flight_of(draft, wish, bench.wish.threads, bench.deadline);
    if (!flight.ok()) return flight.error();
    LightCache lights(kLightCacheBytes);
    auto settled =
        settle(*flight, Settling::kForecast, {&lights, bench.wish.threads}, bench.deadline);
    if (!settled.ok()) return settled.error();
    settled->is_unmeasured = true;
    std::vector<double> times;
    const auto start = Deadline::Clock::now();
    for (std::uint64_t i = 0; i < kFrames && (times.empty() || ms_since(start) < 2 * kLong_ms);
         ++i) {
        const Frame frame = frame_at(*settled, frame_time(settled->sequence, i));
        auto planned = with_detail_made(
            frame.scene, plan_frame(frame, bench.wish.threads, bench.deadline, bench.speed),
            bench.wish.threads);
        if (!planned.ok()) return planned.error();
        if (const Status failed = open_for(planned->plan, bench.wish.device, bench.device))
            return *failed;
        const auto rendered = render_planned(
            frame.scene, *std::move(planned),
            {bench.device ? &*bench.device : nullptr, bench.wish.threads, &lights, {}, bench.speed},
            bench.deadline);
        if (!rendered.ok()) return rendered.error();
        if (i > 0) times.push_back(rendered->times.draw_ms);
    }
    return 1000 / std::max(median(std::move(times)), 1e-3);
}

// Of particles as they are: the source has no detail.
SceneDraft bare(std::uint64_t particles, int width, int height) {
    SceneDraft draft = table_4_2(particles, Fill::kPrinted);
    draft.detail.reset();
    draft.image.width = width;
    draft.image.height = height;
    return draft;
}

Status frames(Bench& bench) {
    struct Row {
        std::uint64_t particles;
        int width, height;
        const char* place;
        std::optional<double> theirs;
    };
    const std::optional<double> none;
    const Row rows[] = {
        {500, 800, 600, "figure 5.4", 120.0},   {10000, 800, 600, "", none},
        {50000, 800, 600, "figure 5.4", 20.0},  {500, 1024, 768, "figure 5.7", 120.0},
        {50000, 1024, 768, "figure 5.7", 20.0}, {500, 1152, 864, "figure 5.8", 120.0},
        {50000, 1152, 864, "figure 5.8", 10.0}};
    const auto measure = [&](const Row& row, const char* rung, const std::string& how,
                             std::optional<Thickness> thickness) -> Status {
        const std::string what =
            grouped(row.particles) + " particles, " + size_text(row.width, row.height) + ", " + how;
        bench.begin(what);
        const auto rate =
            frames_a_second(bench, bare(row.particles, row.width, row.height), rung, thickness);
        if (!rate.ok()) return rate.error();
        bench.take(
            {BenchSource::kCubes, row.place, what, BenchUnit::kFramesASecond, row.theirs, *rate});
        return std::nullopt;
    };
    for (const Row& row : rows)
        if (Status failed = measure(row, "harris", "splats", std::nullopt)) return failed;
    const Row many{50000, 800, 600, "", none};
    for (const Thickness thickness : {Thickness::kThin, Thickness::kMedium, Thickness::kThick})
        if (Status failed = measure(
                many, "harris",
                std::string("splats, ") + kThicknessWords[static_cast<int>(thickness)], thickness))
            return failed;
    // By the light of the transport solve, every ray exact.
    return measure(many, kFlightRung, kFlightRung, std::nullopt);
}

// Of its texture system (appendix A) it prints no figures; Pakawan's report had them. The same matter, in two cubes for
// each of the table's, painted with one texture, with three, with all six.
Status textures(Bench& bench) {
    constexpr std::uint64_t kBillboards = 10000;
    for (const std::size_t count : {1, 3, 6}) {
        const std::string what = grouped(kBillboards) + " billboards, " + size_text(800, 600) +
                                 ", " + std::to_string(count) +
                                 (count == 1 ? " texture" : " textures");
        bench.begin(what);
        SceneDraft draft = bare(kBillboards / 2, 800, 600);
        std::vector<Cube>& cubes = draft.clouds[0].cubes;
        const std::vector<Cube> again = cubes;
        cubes.insert(cubes.end(), again.begin(), again.end());
        for (std::size_t i = 0; i < cubes.size(); ++i)
            cubes[i].texture = kOwnTextures[i % count].name;
        const auto rate = frames_a_second(bench, draft, "harris", std::nullopt);
        if (!rate.ok()) return rate.error();
        bench.take({BenchSource::kCubes, "", what, BenchUnit::kFramesASecond, std::nullopt, *rate});
    }
    return std::nullopt;
}

// --- the automaton

AutomatonCloud automaton_of(double side, std::uint64_t ellipsoids) {
    AutomatonCloud cloud;
    cloud.cells = {side, 20, side};
    RandomEllipsoids random;
    random.count = ellipsoids;
    random.smallest = {8, 4, 8};
    random.largest = {30, 8, 30};
    cloud.random = random;
    return cloud;
}

// A step and the density of all cells after it.
Status step_and_smooth(const AutomatonCloud& cloud, int threads, const Deadline& deadline,
                       automaton::AutomatonScratch& scratch, AutomatonState& state) {
    if (Status late = automaton::step_automaton(cloud, threads, deadline, scratch, state))
        return late;
    const automaton::AutomatonGrid grid(cloud.cells);
    automaton::PlaneSmoother smoother(grid, {&state.cld}, {1, 1, 1});
    for (std::size_t k = 0; k < grid.nz; ++k) smoother.plane(k);
    return std::nullopt;
}

// Frames a second of the automaton in Upchurch's look, cells and all, painted with the textures of these names.
Result<double> painted_rate(Bench& bench, SceneDraft draft, AutomatonCloud cloud,
                            const char* names) {
    bench.begin(std::string("in his look, ") + names);
    cloud.drawing.mode = AutomatonMode::kTextures;
    cloud.drawing.textures = names;
    draft.look = Look::kUpchurch;
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(std::move(cloud));
    const auto scene = validate(std::move(draft));
    if (!scene.ok()) return scene.error();
    std::vector<double> times;
    for (int i = 0; i <= kRuns; ++i) {
        const auto rendered = render_scene(
            *scene, {nullptr, bench.wish.threads, nullptr, {}, bench.speed}, bench.deadline);
        if (!rendered.ok()) return rendered.error();
        if (i > 0) times.push_back(rendered->times.draw_ms);
    }
    return 1000 / std::max(median(std::move(times)), 1e-3);
}

Status automata(Bench& bench) {
    struct Row {
        double side;
        std::uint64_t ellipsoids;
        double frames;
    };
    // Enough steps for clouds to have grown.
    constexpr std::uint64_t kGrown = 40;
    for (const Row& row : {Row{64, 25, 70}, Row{128, 50, 35}, Row{256, 100, 15}}) {
        const AutomatonCloud cloud = automaton_of(row.side, row.ellipsoids);
        const std::string size = grouped(static_cast<std::uint64_t>(row.side)) + " x 20 x " +
                                 grouped(static_cast<std::uint64_t>(row.side)) + " cells, " +
                                 grouped(row.ellipsoids) + " ellipsoids";
        bench.begin(size + ", a step");
        automaton::AutomatonScratch scratch;
        auto state =
            automaton::run_automaton(cloud, 1, kGrown, bench.wish.threads, bench.deadline, scratch);
        if (!state.ok()) return state.error();
        const auto step = median_ms([&] {
            return step_and_smooth(cloud, bench.wish.threads, bench.deadline, scratch, *state);
        });
        if (!step.ok()) return step.error();
        const bool printed = row.side == 256;
        bench.take({BenchSource::kAutomaton, printed ? "chapter V" : "",
                    size + ", a step with its smoothing", BenchUnit::kMilliseconds,
                    printed ? std::optional(300.0) : std::nullopt, *step});
        bench.begin(size + ", frames");
        SceneDraft draft;
        draft.top_level_cubes = false;
        Cloud& one = draft.clouds.emplace_back();
        one.model = CloudModel::kAutomaton;
        AutomatonCloud standing = cloud;
        standing.warm_up = kGrown;
        one.automaton = std::make_shared<const AutomatonCloud>(standing);
        draft.detail.reset();
        draft.image.width = 800;
        draft.image.height = 600;
        const auto rate = frames_a_second(bench, draft, kFlightRung, std::nullopt);
        if (!rate.ok()) return rate.error();
        bench.take({BenchSource::kAutomaton, "table 1", size + ", drawn at 800 x 600",
                    BenchUnit::kFramesASecond, row.frames, *rate});
        if (!printed) continue;
        // As he drew it; figure 15 has it with one texture and with nine.
        for (const char* const names : {"puff", "soft,puff,cauliflower,torn,wisp,hard"}) {
            const auto drawn = painted_rate(bench, draft, standing, names);
            if (!drawn.ok()) return drawn.error();
            bench.take({BenchSource::kAutomaton, "",
                        "... in his look, painted with " +
                            std::string(names == std::string("puff") ? "1 texture" : "6 textures"),
                        BenchUnit::kFramesASecond, std::nullopt, *drawn});
        }
    }
    return std::nullopt;
}

// --- spheres

Status spheres(Bench& bench) {
    struct Row {
        std::uint64_t levels, spheres;
        double theirs;
    };
    for (const Row& row : {Row{6, 15625, 4750}, Row{8, 390625, 9203}, Row{10, 9765625, 22116}}) {
        const std::string what = grouped(row.spheres) + " spheres, 800 x 600, one core";
        bench.begin(what);
        SpheresCloud cloud;
        cloud.levels = row.levels;
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.look = Look::kOstroushko;
        Cloud& one = draft.clouds.emplace_back();
        one.model = CloudModel::kSpheres;
        one.spheres = std::make_shared<SpheresCloud>(cloud);
        // It fills the picture's width.
        draft.camera.automatic = false;
        draft.camera.eye = {330, -40, 450};
        draft.camera.target = {0, 80, 0};
        draft.camera.fov = 45;
        draft.image.width = 800;
        draft.image.height = 600;
        const auto scene = validate(std::move(draft));
        if (!scene.ok()) return scene.error();
        const auto ms = median_ms([&]() -> Status {
            const auto rendered =
                render_scene(*scene, {nullptr, 1, nullptr, {}, bench.speed}, bench.deadline);
            if (!rendered.ok()) return rendered.error();
            return std::nullopt;
        });
        if (!ms.ok()) return ms.error();
        bench.take(
            {BenchSource::kSpheres, "table 1", what, BenchUnit::kMilliseconds, row.theirs, *ms});
    }
    return std::nullopt;
}

// --- implicit clouds: particles, and a whole frame with its light and its stated error

Status implicit_clouds(Bench& bench) {
    struct Row {
        ImplicitPreset preset;
        const char* name;
    };
    for (const Row& row :
         {Row{ImplicitPreset::kCumulus, "a cumulus"}, Row{ImplicitPreset::kCreature, "a creature"},
          Row{ImplicitPreset::kCirrus, "cirrus"}}) {
        SceneDraft draft;
        draft.top_level_cubes = false;
        Cloud& one = draft.clouds.emplace_back();
        one.model = CloudModel::kImplicit;
        auto cloud = std::make_shared<ImplicitCloud>();
        cloud->preset = row.preset;
        one.implicit = std::move(cloud);
        draft.accuracy.rung = kFlightRung;
        draft.image.width = 640;
        draft.image.height = 480;
        const auto scene = validate(std::move(draft));
        if (!scene.ok()) return scene.error();
        const auto take = [&](const std::string& what, const auto& run) -> Status {
            bench.begin(what);
            const auto ms = median_ms([&]() -> Status {
                const auto made = run();
                if (!made.ok()) return made.error();
                return std::nullopt;
            });
            if (!ms.ok()) return ms.error();
            bench.take(
                {BenchSource::kImplicit, "", what, BenchUnit::kMilliseconds, std::nullopt, *ms});
            return std::nullopt;
        };
        const std::string name = row.name;
        if (Status failed = take(name + ", its particles", [&] {
                return generate(*scene, bench.wish.threads, bench.deadline);
            }))
            return failed;
        if (Status failed = take(name + ", 640 x 480, " + kFlightRung, [&] {
                return render_scene(*scene, {nullptr, bench.wish.threads, nullptr, {}, bench.speed},
                                    bench.deadline);
            }))
            return failed;
    }
    return std::nullopt;
}

}  // namespace

const BenchDocument& document_of(BenchSource source) {
    static constexpr BenchDocument kDocuments[] = {
        {"Cubes filled with particles, two passes of splats (the thesis of Rekawan and Pakawan)",
         "Pentium 4 3.2 GHz, GeForce FX 5950 Ultra; 1024 x 768 Pentium 4 2.8 GHz, GeForce FX 5200; "
         "1152 x 864 Athlon 1.4 GHz, GeForce MX"},
        {"Cellular automaton, texture splatting (Upchurch 2009)",
         "Core 2 Duo 2.4 GHz, GeForce GTX 260"},
        {"Hierarchy of spheres, ray traced (Ostroushko et al. 2010)", "Core 2 Duo E6600, one core"},
        {"Implicit functions and noise (Ebert et al. 2003, chapter 9)",
         "the chapter prints no times"}};
    return kDocuments[static_cast<std::size_t>(source)];
}

Status measure_figures(const BenchWish& wish, const std::function<void(const std::string&)>& begin,
                       const std::function<void(BenchFigure)>& take, std::string& renderer,
                       const Deadline& deadline) {
    Bench bench{wish, begin, take, deadline, std::nullopt};
    for (const BenchSource source : wish.sources) {
        Status failed;
        switch (source) {
            case BenchSource::kCubes:
                failed = filling(bench);
                if (!failed) failed = frames(bench);
                if (!failed) failed = textures(bench);
                break;
            case BenchSource::kAutomaton:
                failed = automata(bench);
                break;
            case BenchSource::kSpheres:
                failed = spheres(bench);
                break;
            case BenchSource::kImplicit:
                failed = implicit_clouds(bench);
                break;
        }
        if (failed) return failed;
    }
    if (bench.device) renderer = bench.device->info().renderer;
    return std::nullopt;
}

}  // namespace awan
