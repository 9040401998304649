#include "core/planning.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/generate/generate.h"
#include "core/looks/looks.h"
#include "core/plan/island_settings.h"
#include "core/scene/automaton.h"
#include "core/scene/validate.h"
#include "core/survey/detail_of.h"
#include "core/survey/merge.h"

namespace awan {
namespace {

// The most that merging many particles may cost of a picture, and its share of the error that the scene asks for.
constexpr double kMergingError = 0.05, kMergingShare = 0.5;

bool is_look(const Scene& scene) {
    return scene->look != Look::kPhysical;
}

// The particles that light and eye work on, from those of the scene. Procedural clouds choose by themselves how many
// they are made of.
Result<ParticleSet> to_work_on(const Scene& scene, ParticleSet made, int threads,
                               const Deadline& deadline) {
    if (is_look(scene) || scene->display != Display::kLit ||
        std::any_of(scene->clouds.begin(), scene->clouds.end(), is_procedural))
        return made;
    const double wanted = scene->accuracy.error.value_or(kDefaultError);
    return merged(std::move(made), sun_direction(scene->sun),
                  std::min(kMergingError, kMergingShare * wanted), threads, deadline);
}

}  // namespace

Result<Planned> plan_still(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, const std::optional<DetailFigures>& detail) {
    double generate_ms = 0;
    auto made =
        timed(generate_ms, [&] { return generate(scene, threads, deadline, is_look(scene)); });
    if (!made.ok()) return made.error();
    auto planned = plan_generated(scene, *std::move(made), threads, deadline, speed, detail);
    if (!planned.ok()) return planned;
    planned->times.generate_ms += generate_ms;
    // How long procedural clouds take to make is known only by making them.
    if (std::any_of(scene->clouds.begin(), scene->clouds.end(), is_procedural))
        add_to_predictions(planned->plan, planned->times.generate_ms);
    return planned;
}

Result<Planned> plan_generated(const Scene& scene, ParticleSet made, int threads,
                               const Deadline& deadline, const MachineSpeed& speed,
                               const std::optional<DetailFigures>& detail) {
    double merge_ms = 0;
    auto particles =
        timed(merge_ms, [&] { return to_work_on(scene, std::move(made), threads, deadline); });
    if (!particles.ok()) return particles.error();
    auto planned = plan_particles(scene, *std::move(particles), threads, deadline, speed, detail);
    if (planned.ok()) planned->times.generate_ms = merge_ms;
    return planned;
}

Result<Planned> plan_particles(const Scene& scene, ParticleSet particles, int threads,
                               const Deadline& deadline, const MachineSpeed& speed,
                               const std::optional<DetailFigures>& detail) {
    Planned planned;
    planned.particles = std::move(particles);
    auto surveyed = timed(planned.times.survey_ms,
                          [&] { return survey(scene, planned.particles, threads, deadline); });
    if (!surveyed.ok()) return surveyed.error();
    planned.survey = *std::move(surveyed);
    if (detail) planned.survey.detail = *detail;
    planned.plan = plan(scene, planned.survey, threads, speed);
    planned.rung_is_settled = scene->accuracy.rung.has_value();
    if (is_look(scene) && scene->display == Display::kLit)
        add_to_predictions(planned.plan, look_time_ms(scene, planned.survey.view, threads));
    if (planned.plan.predicted.rung->method == Method::kMarch)
        planned.plan.transport.islands = island_cells(planned.plan.transport, planned.survey);
    return planned;
}

Result<Planned> with_detail_made(const Scene& scene, Result<Planned> planned, int threads,
                                 DetailTiles* tiles) {
    if (planned.ok() && planned->plan.on(Effect::kDetail)) {
        EffectTimes& effects = planned->times.effects;
        planned->particles.detail = timed_for(effects, Effect::kDetail, [&] {
            return detail_of(scene, planned->survey, threads, tiles);
        });
        planned->times.survey_ms += effects.of(Effect::kDetail);
    }
    return planned;
}

Scene for_preview(const Scene& scene) {
    // So that a picture of 640 x 400 takes less than 200 ms of two cores (tests/bench/automaton_bench.cpp).
    constexpr std::uint64_t kPreviewParticles = 1u << 16;
    // Splats cost more, each by itself; detail gives them the shape that blocks of cells have not.
    constexpr std::uint64_t kPreviewSplats = 1u << 14;
    const bool splats = scene->accuracy.rung == rung_of(RungId::kHarris).name;
    const std::uint64_t most = splats ? kPreviewSplats : kPreviewParticles;
    SceneDraft draft = *scene;
    bool changed = false;
    for (Cloud& cloud : draft.clouds) {
        if (!cloud.automaton || cloud.automaton->most_particles <= most) continue;
        auto fewer = std::make_shared<AutomatonCloud>(*cloud.automaton);
        fewer->most_particles = most;
        cloud.automaton = std::move(fewer);
        changed = true;
    }
    // It has become smaller.
    return changed ? validate(std::move(draft)).value() : scene;
}

Planned as_preview(const Scene& scene, Planned planned) {
    planned.is_preview = planned.is_unmeasured = true;
    planned.rung_is_settled = planned.rung_is_settled || !scene->accuracy.time_ms;
    planned.plan.predicted.error = std::numeric_limits<double>::quiet_NaN();
    return planned;
}

void add_to_predictions(Plan& plan, double ms) {
    plan.predicted.time_ms += ms;
    for (RungForecast& forecast : plan.forecasts) forecast.time_ms += ms;
}

}  // namespace awan
