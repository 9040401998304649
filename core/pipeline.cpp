#include "core/pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "core/climb.h"
#include "core/draw/draw.h"
#include "core/draw/march.h"
#include "core/light/light.h"
#include "core/light/transport.h"
#include "core/looks/looks.h"
#include "core/plan/island_settings.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "core/survey/detail_of.h"
#include "core/truth/path_tracer.h"

namespace awan {
namespace {

// The two passes of splats on the renderer.
Status render_splats(const Scene& scene, const Planned& planned, const Tools& tools,
                     const Deadline& deadline, Rendered& rendered) {
    if (tools.device == nullptr)
        return Error{ErrorCode::kNoRenderer, "",
                     std::string("rung ") + planned.plan.rung + " needs a renderer"};
    auto lighting = timed(rendered.times.light_ms, [&] {
        return light(scene, planned.particles, planned.plan, *tools.device, deadline);
    });
    if (!lighting.ok()) return lighting.error();
    rendered.times.effects.add(lighting->took);
    auto image = timed(rendered.times.draw_ms, [&] {
        return draw(scene, planned.particles, planned.survey.view, planned.plan, *lighting,
                    *tools.device, deadline, &rendered.times.effects);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    return std::nullopt;
}

Status march_light(const Scene& scene, const Planned& planned, const TransportLight& light,
                   const Tools& tools, const Deadline& deadline, Rendered& rendered) {
    MarchSettings settings;
    settings.eye_effects = planned.plan.eye_effects();
    double draw_ms = 0;
    auto image = timed(draw_ms, [&] {
        return march(scene, planned.particles, planned.survey.view, light, settings, tools.threads,
                     deadline, &rendered.times.effects);
    });
    if (!image.ok()) return image.error();
    rendered.times.draw_ms += draw_ms;
    rendered.image = *std::move(image);
    return std::nullopt;
}

bool holds(double error, const Scene& scene) {
    return error <= scene->accuracy.error.value_or(kDefaultError);
}

// Whether the scene asks for an error, if only by asking for nothing.
bool asks_for_error(const Scene& scene) {
    return !scene->accuracy.rung && !scene->accuracy.time_ms;
}

// Transport on a grid, as fine as the scene's wish needs; not drawn yet.
Result<SharedLight> climbed_light(const Scene& scene, const Planned& planned, const Tools& tools,
                                  const Deadline& deadline, Rendered& rendered) {
    auto climbed = climb(scene, planned, {tools.lights, tools.threads}, deadline);
    if (!climbed.ok()) return climbed.error();
    rendered.light_was_kept = climbed->was_kept;
    rendered.times.light_ms += climbed->light_ms;
    rendered.times.measure_ms += climbed->measure_ms;
    rendered.times.effects.add(climbed->took);
    if (climbed->rung != nullptr) {
        rendered.rung = climbed->rung;
        rendered.stated_error = climbed->stated;
    }
    return std::move(climbed->light);
}

// The light's grid or, of rung `single`, the sun's depth alone, then the march.
Status render_march(const Scene& scene, const Planned& planned, const Tools& tools,
                    const Deadline& deadline, Rendered& rendered) {
    const auto light = climbed_light(scene, planned, tools, deadline, rendered);
    if (!light.ok()) return light.error();
    return march_light(scene, planned, **light, tools, deadline, rendered);
}

// Every path of light.
Status render_paths(const Scene& scene, const Planned& planned, const Tools& tools,
                    const Deadline& deadline, Rendered& rendered) {
    TruthOptions options;
    options.whole_pixels = true;
    options.samples = planned.plan.samples;
    options.eye_effects = planned.plan.eye_effects();
    options.threads = tools.threads;
    auto truth = timed(rendered.times.draw_ms, [&] {
        return trace_truth(scene, planned.particles, planned.survey.view, options, tools.progress,
                           deadline);
    });
    if (!truth.ok()) return truth.error();
    rendered.image = mean_of(*truth);
    rendered.stated_error = truth->noise();
    return std::nullopt;
}

// By the rules of another system.
Status render_look(const Scene& scene, const Planned& planned, const Tools& tools,
                   const Deadline& deadline, Rendered& rendered) {
    auto image = timed(rendered.times.draw_ms, [&] {
        return draw_look(scene, planned.survey.view, tools.threads, deadline);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    return std::nullopt;
}

// The same plan for the transport rungs.
Planned for_grids(const Scene& scene, Planned planned, const Tools& tools) {
    SceneDraft draft = *scene;
    draft.accuracy = {{}, {}, rung_of(RungId::kTransport16).name};
    const auto named = validate(std::move(draft));
    if (!named.ok()) return planned;  // it was valid before
    const RungForecast forecast = planned.plan.predicted;
    planned.plan = plan(*named, planned.survey, tools.threads, tools.speed);
    planned.plan.predicted = forecast;
    planned.plan.transport.islands = island_cells(planned.plan.transport, planned.survey);
    return *with_detail_made(scene, std::move(planned), tools.threads);
}

// Whether paths of tolerable length are expected to keep to what the scene asks for.
bool paths_may_hold(const Scene& scene, const Plan& plan) {
    // Paths are for what is finer than the default: a scene that asks for nothing is not made to wait for them.
    if (scene->accuracy.error.value_or(kDefaultError) >= kDefaultError || wants_splats(scene))
        return false;
    for (const RungForecast& forecast : plan.forecasts)
        if (forecast.rung->method == Method::kPaths) return forecast.time_ms <= kPatience_ms;
    return false;
}

// The coarsest grid that keeps to the error that the scene asks for; paths where none does; else the finest grid.
Status render_grid_or_paths(const Scene& scene, Planned& planned, const Tools& tools,
                            const Deadline& deadline, Rendered& rendered) {
    // A plan for a grid is that already: its particles need not be copied, nor its detail be made again.
    const bool is_for_grids = planned.plan.predicted.rung->cells > 0;
    std::optional<Planned> made;
    if (!is_for_grids) made = for_grids(scene, planned, tools);
    const Planned& grids = made ? *made : planned;
    const auto light = climbed_light(scene, grids, tools, deadline, rendered);
    if (!light.ok()) return light.error();
    if (!holds(rendered.stated_error, scene) && paths_may_hold(scene, planned.plan)) {
        rendered.rung = &rung_of(RungId::kTruth);
        return render_paths(scene, planned, tools, deadline, rendered);
    }
    if (made) planned = *std::move(made);
    return march_light(scene, planned, **light, tools, deadline, rendered);
}

// A picture of a rung without a grid is measured against the coarsest grid. Where it is not what the scene asks for,
// one of a transport rung takes its place.
Status measure_or_climb(const Scene& scene, Planned& planned, const Tools& tools,
                        const Deadline& deadline, Rendered& rendered) {
    if (planned.particles.size() == 0 || !(planned.survey.total_mass > 0)) return std::nullopt;
    double measure_ms = 0;
    const auto error = timed(measure_ms, [&] {
        return error_of_picture(scene, planned, rendered.image, {tools.lights, tools.threads},
                                deadline);
    });
    if (!error.ok()) return error.error();
    rendered.times.measure_ms += measure_ms;
    rendered.stated_error = *error;
    if (!asks_for_error(scene) || holds(*error, scene) || wants_splats(scene)) return std::nullopt;
    return render_grid_or_paths(scene, planned, tools, deadline, rendered);
}

// Why the picture is of another rung than was planned.
std::string climbed_reason(const Plan& plan, const Rung& rung, double stated) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%s was expected to do; measured, the error of %s is %.3g%%", plan.rung.c_str(),
                  rung.name, 100 * stated);
    return text.data();
}

}  // namespace

Result<Planned> plan_only(const Scene& scene, int threads, const Deadline& deadline,
                          const MachineSpeed& speed) {
    if (!scene->sequence) return plan_still(scene, threads, deadline, speed, {});
    const auto start = Deadline::Clock::now();
    auto settled = settle(scene, threads, deadline, speed);
    if (!settled.ok()) return settled.error();
    const double settling_ms = ms_since(start);
    const Frame frame = frame_at(*settled, scene->time);
    auto planned = plan_still(frame.scene, threads, deadline, speed, frame.detail);
    if (!planned.ok()) return planned;
    // Settling is mostly surveys, and a client waits for it as for them.
    planned->times.survey_ms += settling_ms;
    add_to_predictions(planned->plan, settling_ms);
    if (!scene->accuracy.rung && settled->draft.accuracy.rung)
        planned->plan.rung_reason =
            "settled for the whole sequence by its first, middle and last frame";
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

Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, DetailTiles* tiles) {
    return with_detail_made(scene, plan_only(scene, threads, deadline, speed), threads, tiles);
}

Result<Rendered> render_planned(const Scene& scene, Planned planned, const Tools& tools,
                                const Deadline& deadline) {
    Rendered rendered;
    rendered.times = planned.times;
    rendered.rung = planned.plan.predicted.rung;
    Status failed;
    switch (rendered.rung->method) {
        case Method::kSplats:
            failed = render_splats(scene, planned, tools, deadline, rendered);
            if (!failed) failed = measure_or_climb(scene, planned, tools, deadline, rendered);
            break;
        case Method::kMarch:
            if (planned.plan.transport.cells > 0 && asks_for_error(scene)) {
                failed = render_grid_or_paths(scene, planned, tools, deadline, rendered);
                break;
            }
            failed = render_march(scene, planned, tools, deadline, rendered);
            if (!failed && planned.plan.transport.cells == 0)
                failed = measure_or_climb(scene, planned, tools, deadline, rendered);
            break;
        case Method::kPaths:
            failed = asks_for_error(scene)
                         ? render_grid_or_paths(scene, planned, tools, deadline, rendered)
                         : render_paths(scene, planned, tools, deadline, rendered);
            break;
        case Method::kLook:
            rendered.stated_error = std::numeric_limits<double>::quiet_NaN();
            failed = render_look(scene, planned, tools, deadline, rendered);
            break;
    }
    if (failed) return *failed;
    if (planned.plan.rung != rendered.rung->name) {
        planned.plan.rung_reason =
            climbed_reason(planned.plan, *rendered.rung, rendered.stated_error);
        planned.plan.rung = rendered.rung->name;
    }
    for (const EffectDecision& decision : planned.plan.effects)
        if (!decision.on) rendered.times.effects.of(decision.effect) = 0;
    rendered.survey = std::move(planned.survey);
    rendered.survey.volume.extinction = {};
    rendered.plan = std::move(planned.plan);
    return rendered;
}

Result<Rendered> render_scene(const Scene& scene, const Tools& tools, const Deadline& deadline) {
    auto planned = plan_scene(scene, tools.threads, deadline, tools.speed);
    if (!planned.ok()) return planned.error();
    return render_planned(scene, *std::move(planned), tools, deadline);
}

PictureNotes notes_of(const Rendered& rendered) {
    return {rendered.plan.rung, rendered.stated_error, rendered.plan.predicted.error};
}

const char* engine_version() {
    return AWAN_VERSION;
}

}  // namespace awan
