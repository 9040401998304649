#include "core/climb.h"

#include <algorithm>
#include <cmath>

#include "core/draw/picture_difference.h"
#include "core/light/transport.h"
#include "core/plan/island_settings.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// Error over the difference to the next coarser grid (tests/calibration/RESULTS.md).
constexpr double kErrorOfDifference = 1.6;
// The same, of pictures without a grid to one with it.
constexpr double kErrorOfPicture = 1.1;
// What differences of grids do not show, of thick matter. The march's steps, its light between looked up rays and the
// sun's lattice:
constexpr double kEyeError = 0.016;
// what 128 directions leave of the angles of forward scattered light, times g squared;
constexpr double kAngularError = 0.035;
// what lumps of detail that are smaller than steps and cells leave, times the detail's amount, and more of it where the
// sun shines through their edges, times the cosine squared between it and the view.
constexpr double kDetailError = 0.06, kBacklitDetailError = 0.15;
// Of what is far below a pixel, times its share of the matter (Survey::sub_pixel).
constexpr double kSubPixelError = 0.01;
// With which power of its cells along a side a grid's time grows: the third, and deep light takes more sweeps.
constexpr double kTimePower = 3.3;

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
    Scene small;
    TransportSettings settings;  // of the finest grid that may be reached
    Clock::time_point begun = Clock::now();
};

Result<Climb> climb_to(int cells, const Scene& scene, const Planned& planned,
                       const ClimbTools& tools, const Deadline& deadline) {
    auto small = in_small(scene);
    if (!small.ok()) return small.error();
    TransportSettings settings = planned.plan.transport;
    const Rung* const rung = rung_with(cells);
    if (settings.cells != cells && rung != nullptr) {
        const TransportSettings own = transport_settings(*rung);
        settings.cells = own.cells;
        settings.sun_cells = own.sun_cells;
        settings.last = own.last;
        settings.islands = island_cells(settings, planned.survey);
    }
    return Climb{scene, planned, tools, deadline, *std::move(small), std::move(settings)};
}

// The light of these settings: kept from an earlier picture, or solved, going on from the one that was reached.
Result<SharedLight> light_of_step(const Climb& climb, const TransportSettings& settings,
                                  Climbed& reached) {
    const ParticleSet& particles = climb.planned.particles;
    LightCache* const kept = climb.tools.lights;
    const std::string key =
        kept ? light_key(climb.scene, settings, particles.variant, particles.detail.get())
             : std::string();
    if (kept)
        if (SharedLight light = kept->find(key)) return light;
    reached.was_kept = false;
    auto solved = transport_light(climb.scene, particles, climb.planned.survey, settings,
                                  climb.tools.threads, climb.deadline, reached.light);
    if (!solved.ok()) return solved.error();
    reached.took.add(solved->took);
    SharedLight light = std::make_shared<const TransportLight>(*std::move(solved));
    if (kept) kept->keep(key, light);
    return light;
}

// One grid more; what it took, ms.
Result<double> step(const Climb& climb, int cells, Climbed& reached) {
    const auto start = Clock::now();
    auto light = light_of_step(
        climb, settings_on_the_way(climb.settings, cells, climb.planned.survey), reached);
    if (!light.ok()) return light.error();
    reached.light = *std::move(light);
    reached.rung = rung_with(cells);
    const double ms = ms_since(start);
    reached.light_ms += ms;
    return ms;
}

Result<Image> picture_of(const Climb& climb, const Scene& scene, const TransportLight& light) {
    MarchSettings settings;
    settings.eye_effects = climb.planned.plan.eye_effects();
    return march(scene, climb.planned.particles, climb.planned.survey.view, light, settings,
                 climb.tools.threads, climb.deadline);
}

// difference: of a transport rung's small picture to the next coarser grid's.
double stated_error(double difference, const Climb& climb) {
    const Survey& survey = climb.planned.survey;
    const double g = climb.scene->medium.g, depth = survey.optical_depth_eye;
    double floor = std::hypot(kEyeError, kAngularError * g * g) * depth / (1 + depth);
    if (climb.planned.particles.detail != nullptr) {
        const double into_sun = std::max(survey.sun_cosine, 0.0);
        floor = std::hypot(floor, climb.scene->detail->amount *
                                      (kDetailError + kBacklitDetailError * into_sun * into_sun));
    }
    return std::hypot(kErrorOfDifference * difference,
                      std::hypot(floor, kSubPixelError * survey.sub_pixel), survey.model_error);
}

// States the error of the light that was reached. picture: the small one of the next coarser light, or empty; becomes
// that of this one.
Status measure(const Climb& climb, Image& picture, Climbed& reached) {
    const auto start = Clock::now();
    const TransportLight& light = *reached.light;
    if (light.coarser && picture.pixels.empty()) {
        auto coarser = picture_of(climb, climb.small, *light.coarser);
        if (!coarser.ok()) return coarser.error();
        picture = *std::move(coarser);
    }
    auto own = picture_of(climb, climb.small, light);
    if (!own.ok()) return own.error();
    reached.stated = stated_error(light.coarser ? picture_difference(picture, *own) : 0, climb);
    picture = *std::move(own);
    reached.measure_ms += ms_since(start);
    return std::nullopt;
}

// Whether the light that was reached will do. last_ms: what its grid took, of `cells`.
bool enough(const Climb& climb, const Climbed& reached, double last_ms, int cells, int next_cells) {
    const Accuracy& asked = climb.scene->accuracy;
    if (!asked.time_ms) return reached.stated <= asked.error.value_or(kDefaultError);
    const StageTimes& times = climb.planned.times;
    const double next_ms = last_ms * std::pow(static_cast<double>(next_cells) / cells, kTimePower);
    return times.generate_ms + times.survey_ms + ms_since(climb.begun) + next_ms +
               climb.planned.plan.predicted.draw_ms >
           *asked.time_ms;
}

// `small` plus what the pixels of `picture` that are nearest to its own have more than `with_behind`, a picture of its
// size.
Image moved_by(const Image& small, const Image& with_behind, const Image& picture) {
    Image moved = small;
    const auto nearest = [](int at, int of, int from) {
        return static_cast<std::size_t>(
            std::min(static_cast<int>((at + 0.5) * from / of), from - 1));
    };
    std::size_t to = 0;
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x, ++to) {
            const std::size_t from =
                nearest(y, small.height, picture.height) * static_cast<std::size_t>(picture.width) +
                nearest(x, small.width, picture.width);
            for (std::size_t c = 0; c < 3; ++c)
                moved.pixels[4 * to + c] +=
                    picture.pixels[4 * from + c] - with_behind.pixels[4 * to + c];
        }
    return moved;
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
    if (scene->accuracy.error.value_or(kDefaultError) >= kDefaultError || wants_splats(scene))
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
    auto begun = climb_to(most, scene, planned, tools, deadline);
    if (!begun.ok()) return begun.error();
    Climbed reached;
    Image picture;
    const std::vector<int> steps = nested_cells(most);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool last = i + 1 == steps.size();
        const auto took_ms = step(*begun, steps[i], reached);
        if (!took_ms.ok()) return took_ms.error();
        // Grids that are only on the way are too coarse to show.
        if (reached.rung == nullptr || (by_name && !last)) continue;
        if (Status failed = measure(*begun, picture, reached)) return *failed;
        if (last || enough(*begun, reached, *took_ms, steps[i], steps[i + 1])) break;
    }
    return reached;
}

Result<double> error_of_picture(const Scene& scene, const Planned& planned, const Image& picture,
                                const ClimbTools& tools, const Deadline& deadline) {
    const int cells = grids_of_ladder().coarsest;
    auto begun = climb_to(cells, scene, planned, tools, deadline);
    if (!begun.ok()) return begun.error();
    auto aligned = in_small_aligned(scene);
    if (!aligned.ok()) return aligned.error();
    begun->small = *std::move(aligned);
    Climbed reached;
    for (const int step_cells : nested_cells(cells)) {
        const auto took_ms = step(*begun, step_cells, reached);
        if (!took_ms.ok()) return took_ms.error();
    }
    Image small;
    if (Status failed = measure(*begun, small, reached)) return *failed;
    // What stands behind is the same in both: with it, they differ by the cloud alone.
    Image with_behind = small;
    if (scene->image.background != Background::kTransparent) {
        SceneDraft draft = *begun->small;
        draft.image.background = scene->image.background;
        const auto over_it = validate(std::move(draft));
        if (!over_it.ok()) return over_it.error();
        auto drawn = picture_of(*begun, *over_it, *reached.light);
        if (!drawn.ok()) return drawn.error();
        with_behind = *std::move(drawn);
    }
    const Image other = moved_by(small, with_behind, picture);
    return kErrorOfPicture * std::hypot(picture_difference(other, small), reached.stated);
}

}  // namespace awan
