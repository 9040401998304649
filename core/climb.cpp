#include "core/climb.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/exact_math.h"
#include "core/light/transport.h"
#include "core/measured_pictures.h"
#include "core/plan/island_settings.h"
#include "core/plan/known_error.h"
#include "core/plan/step_times.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// Error over the difference to the next coarser grid (tests/calibration/README.md).
constexpr double kErrorOfDifference = 1.25;
// The same, of pictures without a grid to one with it.
constexpr double kErrorOfPicture = 1.2;
// An error of at most this share of another adds 12% to it.
constexpr double kMuchLess = 0.5;
// Of what it is added to, an error that the plan expects need not be measured: were it off by a third, the sum would be
// by 12%.
constexpr double kForecastWillDo = 0.8;
// With which power of a cell's side errors fall, at least: from 1.3 to 1.6 was measured on smooth clouds.
constexpr double kOrder = 1.3;
using Clock = Deadline::Clock;

// The transport rung whose grid has so many cells; null: the grid is only on the way.
const Rung* rung_with(int cells) {
    for (const Rung& rung : ladder())
        if (rung.cells > 0 && rung.cells == cells) return &rung;
    return nullptr;
}

// The grids of the coarsest and the finest rung.
struct CellRange {
    int coarsest = 1 << 30, finest = 0;
};
CellRange grids_of_ladder() {
    CellRange range;
    for (const Rung& rung : ladder()) {
        if (rung.cells == 0) continue;
        range.coarsest = std::min(range.coarsest, rung.cells);
        range.finest = std::max(range.finest, rung.cells);
    }
    return range;
}

// What all steps share.
struct Climb {
    const Scene& scene;
    const Planned& planned;
    const ClimbTools& tools;
    const Deadline& deadline;
    TransportSettings settings;  // of the finest grid that may be reached
};

Climb climb_to(int cells, const Scene& scene, const Planned& planned, const ClimbTools& tools,
               const Deadline& deadline) {
    TransportSettings settings = planned.plan.transport;
    const Rung* const rung = rung_with(cells);
    if (settings.cells != cells && rung != nullptr) {
        const TransportSettings own = transport_settings(*rung);
        settings.cells = own.cells;
        settings.sun_cells = own.sun_cells;
        settings.last = own.last;
        settings.islands = island_cells(settings, planned.survey);
    }
    return {scene, planned, tools, deadline, std::move(settings)};
}

std::string key_of(const Climb& climb, const TransportSettings& settings) {
    const ParticleSet& particles = climb.planned.particles;
    return light_key(climb.scene, settings, particles.variant, particles.detail.get());
}
std::string key_of(const Climb& climb, int cells) {
    return key_of(climb, settings_on_the_way(climb.settings, cells, climb.planned.survey));
}
// Of a grid's light without the coarser ones beside it, which only measuring looks at.
std::string alone(const std::string& key) {
    return key + ":alone";
}

// The light of a grid with so many cells, if it is kept, with or without coarser ones; else null.
SharedLight kept_light(const Climb& climb, int cells) {
    LightCache* const kept = climb.tools.lights;
    if (kept == nullptr) return nullptr;
    const std::string key = key_of(climb, cells);
    if (SharedLight light = kept->find(key)) return light;
    return kept->find(alone(key));
}

// Keeps a light that is too large to be kept together with the coarser ones.
void keep_alone(const Climb& climb, int cells, const SharedLight& light) {
    LightCache* const kept = climb.tools.lights;
    if (kept == nullptr || light == nullptr || !light->coarser) return;
    const std::size_t all = light->bytes(), most = kept->most_of_one();
    if (all <= most || all - light->coarser->bytes() > most) return;
    auto without = std::make_shared<TransportLight>(*light);
    without->coarser = nullptr;
    kept->keep(alone(key_of(climb, cells)), std::move(without));
}

// The light of these settings: kept from an earlier picture, or solved, going on from the one that was reached.
Result<SharedLight> light_of_step(const Climb& climb, const TransportSettings& settings,
                                  const Deadline& deadline, Climbed& reached) {
    const ParticleSet& particles = climb.planned.particles;
    LightCache* const kept = climb.tools.lights;
    const std::string key = kept ? key_of(climb, settings) : std::string();
    if (kept)
        if (SharedLight light = kept->find(key)) return light;
    reached.was_kept = false;
    auto solved = transport_light(climb.scene, particles, climb.planned.survey, settings,
                                  climb.tools.threads, deadline, reached.light);
    if (!solved.ok()) return solved.error();
    reached.took.add(solved->took);
    SharedLight light = std::make_shared<const TransportLight>(*std::move(solved));
    if (kept) kept->keep(key, light);
    return light;
}

// One grid more.
Status step(const Climb& climb, int cells, const Deadline& deadline, Climbed& reached) {
    const auto start = Clock::now();
    auto light = light_of_step(
        climb, settings_on_the_way(climb.settings, cells, climb.planned.survey), deadline, reached);
    reached.light_ms += ms_since(start);
    if (!light.ok()) return light.error();
    reached.light = *std::move(light);
    reached.rung = rung_with(cells);
    return std::nullopt;
}

// difference: of a transport rung's picture to the next coarser grid's.
double stated_error(double difference, const Climb& climb, int cells) {
    const Planned& planned = climb.planned;
    return exact::hypot(
        kErrorOfDifference * difference,
        known_error(climb.scene, planned.survey, planned.particles.detail != nullptr, cells),
        planned.survey.model_error);
}

Result<MeasuredPictures> measured_pictures(const Climb& climb, int blocks) {
    return MeasuredPictures::of(climb.scene, climb.planned, blocks, climb.tools.threads,
                                climb.deadline);
}

// By how much grids differ, as far as it tells how far off the finest is: two can be near to each other by luck. Then
// what the two before differ by says more, as errors fall about with the cells' side; but not of grids that are only
// on the way to the coarsest rung, whose cells are too large for that. cells: of the finest.
Result<double> difference_of(const TransportLight& light, int cells, MeasuredPictures& pictures) {
    const std::vector<int> grids = nested_cells(cells);
    const TransportLight* finer = &light;
    double difference = 0, shrinks = 1;
    for (std::size_t i = grids.size(); i-- > 1 && i + 3 > grids.size() && finer->coarser;) {
        if (i + 1 < grids.size() && rung_with(grids[i]) == nullptr) break;
        const auto one = pictures.difference(*finer->coarser, *finer);
        if (!one.ok()) return one.error();
        difference = std::max(difference, shrinks * *one);
        shrinks *= exact::pow(static_cast<double>(grids[i - 1]) / grids[i], kOrder);
        finer = finer->coarser.get();
    }
    return difference;
}

// The light of the coarsest rung's grid on the way to `light`, of so many cells. Whatever is asked for goes by it, so
// pictures that are marched like it tell the same of a rung.
const TransportLight& of_coarsest_rung(const TransportLight& light, int cells) {
    const std::vector<int> grids = nested_cells(cells);
    const TransportLight* found = &light;
    for (std::size_t i = grids.size();
         i-- > 1 && rung_with(grids[i - 1]) != nullptr && found->coarser;)
        found = found->coarser.get();
    return *found;
}

// Whether an island in the picture has no finer grid than it had on the next coarser step: by how much these differ
// says nothing of it.
bool has_islands_as_before(const Climb& climb, int cells) {
    const std::vector<int> grids = nested_cells(cells);
    if (grids.size() < 2) return false;
    const Survey& survey = climb.planned.survey;
    const auto of = [&](int step) {
        return settings_on_the_way(climb.settings, step, survey).islands;
    };
    const std::vector<IslandCells> own = of(cells), before = of(grids[grids.size() - 2]);
    for (std::size_t i = 0; i < std::min(own.size(), before.size()); ++i)
        if (own[i].cells > 0 && own[i].cells == before[i].cells) return true;
    return false;
}

// What the plan expects of a rung.
const RungForecast* forecast_of(const Plan& plan, const Rung& rung) {
    for (const RungForecast& forecast : plan.forecasts)
        if (*forecast.rung == rung) return &forecast;
    return nullptr;
}

// States the error of the light that was reached, of a grid with so many cells.
Status measure(const Climb& climb, int cells, MeasuredPictures& pictures, Climbed& reached) {
    const auto start = Clock::now();
    pictures.march_like(of_coarsest_rung(*reached.light, cells));
    const auto difference = difference_of(*reached.light, cells, pictures);
    if (!difference.ok()) return difference.error();
    reached.stated = stated_error(*difference, climb, cells);
    const RungForecast* const expected =
        reached.rung != nullptr && has_islands_as_before(climb, cells)
            ? forecast_of(climb.planned.plan, *reached.rung)
            : nullptr;
    if (expected != nullptr) reached.stated = std::max(reached.stated, expected->error);
    reached.measure_ms += ms_since(start);
    return std::nullopt;
}

// How many times longer the march of the scene's picture is expected to take than that of one that measures.
double draw_ratio(const Climb& climb, const Rung& rung) {
    const RungForecast expected =
        forecast(rung, climb.scene, climb.planned.survey, 0, climb.tools.threads, {});
    return expected.draw_ms * kMeasuringPictures / std::max(expected.measure_ms, 1e-3);
}

// So many milliseconds from now, or the end of time.
Clock::time_point in_ms(double ms) {
    constexpr double kLong = 1e9;
    if (!(ms < kLong)) return Clock::time_point::max();
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double, std::milli>(ms));
}

// As many of the grids as there is time for; the coarsest rung in any case. The error is measured if that fits too.
Status climb_in_time(const Climb& climb, const std::vector<int>& grids, Climbed& reached) {
    const Plan& plan = climb.planned.plan;
    const auto begun = Clock::now();
    const double planned_ms = climb.planned.times.generate_ms + climb.planned.times.survey_ms;
    StepTimes steps(plan.forecasts);
    TimeSpent time{*climb.scene->accuracy.time_ms, 0, plan.predicted.draw_ms, 0};
    auto pictures = measured_pictures(climb, kMeasuredBlocks);
    if (!pictures.ok()) return pictures.error();
    SharedLight first;  // of the coarsest rung
    int reached_cells = 0;
    reached.stated = std::numeric_limits<double>::quiet_NaN();
    for (const int cells : grids) {
        Deadline own = climb.deadline;
        time.spent = planned_ms + ms_since(begun);
        if (first) {
            if (!time.is_left_for(steps.next_ms(cells))) break;
            own.until = std::min(own.until, in_ms(time.most_for_a_step()));
        }
        const auto start = Clock::now();
        const bool all_were_kept = std::exchange(reached.was_kept, true);
        const Status failed = step(climb, cells, own, reached);
        if (failed) {
            reached.was_kept = false;
            // The time is over, if not for the answer: what was reached before will do.
            if (first && !climb.deadline.over()) break;
            return failed;
        }
        reached_cells = cells;
        if (reached.was_kept) {
            steps.kept(cells);
        } else {
            steps.solved(cells, ms_since(start));
        }
        reached.was_kept = reached.was_kept && all_were_kept;
        if (first || reached.rung == nullptr) continue;
        first = reached.light;
        time.spent = planned_ms + ms_since(begun);
        const RungForecast* const expected = forecast_of(plan, *reached.rung);
        time.measure = expected != nullptr ? expected->measure_ms : 0;
        if (climb.planned.is_preview || !time.is_left_to_measure()) return std::nullopt;
        // Its pictures tell what drawing will take, and measuring again.
        const auto measuring = Clock::now();
        if (Status wrong = measure(climb, cells, *pictures, reached)) return wrong;
        time.measure = ms_since(measuring);
        time.draw =
            time.measure / static_cast<double>(pictures->made()) * draw_ratio(climb, *reached.rung);
    }
    if (reached.light == first) return std::nullopt;
    reached.stated = std::numeric_limits<double>::quiet_NaN();
    time.spent = planned_ms + ms_since(begun);
    if (!time.is_left_to_measure()) return std::nullopt;
    return measure(climb, reached_cells, *pictures, reached);
}

}  // namespace

bool asks_for_error(const Scene& scene, const Planned& planned) {
    return !planned.rung_is_settled && !scene->accuracy.time_ms;
}

bool holds(double error, const Scene& scene) {
    return error <= scene->accuracy.error.value_or(kDefaultError);
}

bool paths_may_hold(const Scene& scene, const Plan& plan) {
    // Paths are for what is finer than the default: a scene that asks for nothing is not made to wait for them.
    if (scene->accuracy.error.value_or(kDefaultError) >= kDefaultError || wants_splats(scene) ||
        wants_layers(scene))
        return false;
    for (const RungForecast& forecast : plan.forecasts)
        if (forecast.rung->method == Method::kPaths) return forecast.time_ms <= kPatience_ms;
    return false;
}

Planned planned_for_grids(const Scene& scene, Planned planned, int threads) {
    SceneDraft draft = *scene;
    draft.accuracy = {{}, {}, rung_of(RungId::kTransport16).name};
    const auto named = validate(std::move(draft));
    if (!named.ok()) return planned;  // it was valid before
    Plan plan_of_grids = plan(*named, planned.survey, threads, {});
    plan_of_grids.rung = std::move(planned.plan.rung);
    plan_of_grids.rung_reason = std::move(planned.plan.rung_reason);
    plan_of_grids.predicted = planned.plan.predicted;
    plan_of_grids.forecasts = std::move(planned.plan.forecasts);
    plan_of_grids.samples = planned.plan.samples;
    planned.plan = std::move(plan_of_grids);
    planned.plan.transport.islands = island_cells(planned.plan.transport, planned.survey);
    if (planned.particles.detail != nullptr) return planned;
    return *with_detail_made(scene, std::move(planned), threads);
}

Result<Climbed> climb(const Scene& scene, const Planned& planned, const ClimbTools& tools,
                      const Deadline& deadline) {
    const bool by_name = planned.rung_is_settled;
    const int planned_cells = planned.plan.transport.cells;
    const int most = by_name || planned_cells == 0 ? planned_cells : grids_of_ladder().finest;
    const Climb begun = climb_to(most, scene, planned, tools, deadline);
    Climbed reached;
    if (!by_name && scene->accuracy.time_ms && most > 0) {
        if (Status failed = climb_in_time(begun, nested_cells(most), reached)) return *failed;
        return reached;
    }
    auto pictures = measured_pictures(begun, kMeasuredBlocks);
    if (!pictures.ok()) return pictures.error();
    if (by_name && planned.is_unmeasured) {
        reached.stated = std::numeric_limits<double>::quiet_NaN();
        // What is kept needs none of the grids on the way, which may not all have had room beside it.
        if (SharedLight light = kept_light(begun, most)) {
            reached.light = std::move(light);
            reached.rung = rung_with(most);
            return reached;
        }
    }
    for (const int cells : nested_cells(most)) {
        if (Status failed = step(begun, cells, deadline, reached)) return *failed;
        // Grids that are only on the way are too coarse to show.
        if (reached.rung == nullptr || (by_name && (cells != most || planned.is_unmeasured)))
            continue;
        if (Status failed = measure(begun, cells, *pictures, reached)) return *failed;
        if (holds(reached.stated, scene)) break;
    }
    if (by_name && planned.is_unmeasured) keep_alone(begun, most, reached.light);
    return reached;
}

Result<double> error_of_picture(const Scene& scene, const Planned& planned, const Image& picture,
                                const ClimbTools& tools, const Deadline& deadline) {
    const int coarsest = grids_of_ladder().coarsest;
    const Climb begun = climb_to(coarsest, scene, planned, tools, deadline);
    const RungForecast* const forecast = forecast_of(planned.plan, *rung_with(coarsest));
    const double of_coarsest = forecast != nullptr && forecast->error > 0
                                   ? forecast->error
                                   : std::numeric_limits<double>::infinity();
    auto pictures = measured_pictures(begun, kMeasuredBlocksWithoutGrid);
    if (!pictures.ok()) return pictures.error();
    Climbed reached;
    for (const int cells : nested_cells(coarsest)) {
        if (Status failed = step(begun, cells, deadline, reached)) return *failed;
        const TransportLight& light = *reached.light;
        const bool is_last = cells == coarsest;
        const double expected =
            of_coarsest * exact::pow(static_cast<double>(coarsest) / cells, kOrder);
        // Where the picture is far off, how far off the grid is matters little.
        if (!is_last && expected > kMuchLess * planned.plan.predicted.error) continue;
        const auto difference = pictures->difference(picture, light);
        if (!difference.ok()) return difference.error();
        const auto stated = [&](double grid_and_model) {
            return kErrorOfPicture * exact::hypot(*difference, grid_and_model);
        };
        // The model's is in what is expected.
        if (expected < (is_last ? kForecastWillDo : kMuchLess) * *difference)
            return stated(expected);
        if (!is_last) continue;
        if (Status failed = measure(begun, cells, *pictures, reached)) return *failed;
        return stated(reached.stated);
    }
    return std::numeric_limits<double>::quiet_NaN();  // never: the coarsest rung is among the grids
}

}  // namespace awan
