#include "core/pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/exact_math.h"
#include "core/climb.h"
#include "core/draw/display.h"
#include "core/draw/draw.h"
#include "core/draw/march.h"
#include "core/draw/sun_disc.h"
#include "core/light/light.h"
#include "core/light/once_scattered.h"
#include "core/light/transport.h"
#include "core/looks/looks.h"
#include "core/plan/step_times.h"
#include "core/scene/layers.h"
#include "core/sequence.h"
#include "core/survey/merge.h"
#include "core/truth/path_tracer.h"

namespace awan {
namespace {

// Fewer are drawn in the time that it takes to find out what merging them would cost.
constexpr std::size_t kFewSplats = 1u << 17;
// What merging them may cost of a picture: small beside what the passes themselves leave out.
constexpr double kSplatMergingError = 0.1;

// Clouds that choose their particles themselves make as many as the march is quick with. Each is a splat of its own:
// they are merged where that is of use.
Result<std::optional<ParticleSet>> merged_for_splats(const Scene& scene, const Planned& planned,
                                                     int threads, const Deadline& deadline) {
    const ParticleSet& particles = planned.particles;
    if (particles.whole || planned.plan.on(Effect::kTexture) || particles.size() < kFewSplats)
        return std::optional<ParticleSet>();
    auto fewer =
        merged(particles, sun_direction(scene->sun), kSplatMergingError, threads, deadline);
    if (!fewer.ok()) return fewer.error();
    fewer->detail = particles.detail;
    return std::optional<ParticleSet>(*std::move(fewer));
}

// The two passes of splats on the renderer.
Status render_splats(const Scene& scene, const Planned& planned, const Tools& tools,
                     const Deadline& deadline, Rendered& rendered) {
    if (tools.device == nullptr)
        return Error{ErrorCode::kNoRenderer, "",
                     std::string("rung ") + planned.plan.rung + " needs a renderer"};
    auto fewer = timed(rendered.times.light_ms,
                       [&] { return merged_for_splats(scene, planned, tools.threads, deadline); });
    if (!fewer.ok()) return fewer.error();
    const ParticleSet& particles = *fewer ? **fewer : planned.particles;
    auto lighting = timed(rendered.times.light_ms, [&] {
        return light(scene, particles, planned.plan, *tools.device, deadline);
    });
    if (!lighting.ok()) return lighting.error();
    rendered.times.effects.add(lighting->took);
    auto image = timed(rendered.times.draw_ms, [&] {
        return draw(scene, particles, planned.survey.view, planned.plan, *lighting, *tools.device,
                    deadline, &rendered.times.effects, tools.threads, planned.is_preview);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    return std::nullopt;
}

// How bright the sun's disc is at most in pictures that are shown, exposed: so white that it is warm only when low.
constexpr double kBrightestDisc = 12;

// Of a render that keeps none otherwise: the few coarse grids of its own climb.
constexpr std::size_t kLightsOfOne = 64 << 20;

Status march_light(const Scene& scene, const Planned& planned, const TransportLight& light,
                   const Tools& tools, const Deadline& deadline, Rendered& rendered) {
    MarchSettings settings;
    settings.eye_effects = planned.plan.eye_effects();
    settings.one_ray = planned.is_preview;
    const Layers layers = read_layers(scene->image.layers).value_or(Layers{});
    MarchedBeside beside;
    std::optional<LightsOnce> once;
    if (layers.any_light()) {
        TransportSettings sky = planned.plan.transport;
        sky.cells = rendered.rung->cells;
        double light_ms = 0;
        auto of_sky = timed(light_ms, [&] {
            return sky_once(scene, planned.particles, planned.survey, sky, tools.threads, deadline);
        });
        if (!of_sky.ok()) return of_sky.error();
        rendered.times.light_ms += light_ms;
        once = LightsOnce{sun_once(light), *std::move(of_sky)};
    }
    double draw_ms = 0;
    if (planned.impostors != nullptr && !layers.any()) {
        auto frame = timed(draw_ms, [&] {
            return planned.impostors->draw(planned.flight_frame, scene, planned, light, settings,
                                           tools.threads, deadline, &rendered.times.effects,
                                           rendered.impostors);
        });
        if (!frame.ok()) return frame.error();
        rendered.times.draw_ms += draw_ms;
        if (*frame) {
            rendered.image = **std::move(frame);
            return std::nullopt;
        }
    }
    auto image = timed(draw_ms, [&] {
        return march(scene, planned.particles, planned.survey.view, light, settings, tools.threads,
                     deadline, &rendered.times.effects, layers.any() ? &beside : nullptr,
                     once ? &*once : nullptr);
    });
    if (!image.ok()) return image.error();
    rendered.times.draw_ms += draw_ms;
    rendered.image = *std::move(image);
    if (layers.any()) rendered.layers = layers_of(rendered.image, beside, layers);
    return std::nullopt;
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

// Not lit: what the clouds are made of.
Status render_display(const Scene& scene, const Planned& planned, const Tools& tools,
                      const Deadline& deadline, Rendered& rendered) {
    if (tools.device == nullptr)
        return Error{ErrorCode::kNoRenderer, "", "a scene that is displayed needs a renderer"};
    auto image = timed(rendered.times.draw_ms, [&] {
        return draw_display(scene, planned.particles, planned.survey.view, *tools.device, deadline);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    return std::nullopt;
}

// The coarsest grid that keeps to the error that the scene asks for; paths where none does; else the finest grid.
// planned: for the transport rungs.
Status render_grid_or_paths(const Scene& scene, Planned& planned, const Tools& tools,
                            const Deadline& deadline, Rendered& rendered) {
    const auto light = climbed_light(scene, planned, tools, deadline, rendered);
    if (!light.ok()) return light.error();
    if (!holds(rendered.stated_error, scene) && paths_may_hold(scene, planned.plan)) {
        rendered.rung = &rung_of(RungId::kTruth);
        return render_paths(scene, planned, tools, deadline, rendered);
    }
    return march_light(scene, planned, **light, tools, deadline, rendered);
}

// Whether measuring fits into the time that the scene asks for, if it asks for one.
bool is_time_to_measure(const Scene& scene, const Planned& planned, const StageTimes& times) {
    if (planned.rung_is_settled || !scene->accuracy.time_ms) return true;
    const TimeSpent time{*scene->accuracy.time_ms,
                         times.generate_ms + times.survey_ms + times.light_ms + times.draw_ms, 0,
                         planned.plan.predicted.measure_ms};
    return time.is_left_to_measure();
}

// A picture of a rung without a grid is measured against the coarsest grid. Where it is not what the scene asks for,
// one of a transport rung takes its place.
Status measure_or_climb(const Scene& scene, Planned& planned, const Tools& tools,
                        const Deadline& deadline, Rendered& rendered) {
    if (planned.plan.on(Effect::kTexture)) {
        rendered.stated_error = std::numeric_limits<double>::quiet_NaN();
        return std::nullopt;
    }
    if (planned.particles.size() == 0 || !(planned.survey.total_mass > 0)) return std::nullopt;
    const bool unwanted = planned.is_preview || (planned.rung_is_settled && planned.is_unmeasured);
    if (unwanted || !is_time_to_measure(scene, planned, rendered.times)) {
        rendered.stated_error = std::numeric_limits<double>::quiet_NaN();
        return std::nullopt;
    }
    // The grid that measures is the first of those that are climbed then.
    LightCache lights(kLightsOfOne);
    Tools keeping = tools;
    if (keeping.lights == nullptr) keeping.lights = &lights;
    Plan own = planned.plan;
    double measure_ms = 0;
    const auto error = timed(measure_ms, [&] {
        planned = planned_for_grids(scene, std::move(planned), tools.threads);
        return error_of_picture(scene, planned, rendered.image, {keeping.lights, tools.threads},
                                deadline);
    });
    if (!error.ok()) return error.error();
    rendered.times.measure_ms += measure_ms;
    rendered.stated_error = *error;
    if (!asks_for_error(scene, planned) || holds(*error, scene) || wants_splats(scene)) {
        planned.plan = std::move(own);
        return std::nullopt;
    }
    return render_grid_or_paths(scene, planned, keeping, deadline, rendered);
}

// Why the picture is of another rung than was planned.
std::string climbed_reason(const Plan& plan, const Rung& rung, double stated) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%s was expected to do; measured, the error of %s is %.3g%%", plan.rung.c_str(),
                  rung.name, 100 * stated);
    return text.data();
}

Result<Planned> plan_any(const Scene& scene, Settling how, int threads, const Deadline& deadline,
                         const MachineSpeed& speed, LightCache* lights) {
    if (!scene->sequence) return plan_still(scene, threads, deadline, speed, {});
    const auto start = Deadline::Clock::now();
    auto settled = settle(scene, how, {lights, threads}, deadline);
    if (!settled.ok()) return settled.error();
    const double settling_ms = ms_since(start);
    auto planned = plan_frame(frame_at(*settled, scene->time), threads, deadline, speed);
    if (!planned.ok()) return planned;
    // Settling is mostly surveys, and a client waits for it as for them.
    planned->times.survey_ms += settling_ms;
    add_to_predictions(planned->plan, settling_ms);
    if (!settled->reason.empty()) planned->plan.rung_reason = settled->reason;
    return planned;
}

}  // namespace

Result<Planned> plan_only(const Scene& scene, int threads, const Deadline& deadline,
                          const MachineSpeed& speed) {
    return plan_any(scene, Settling::kForecast, threads, deadline, speed, nullptr);
}

Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, DetailTiles* tiles, LightCache* lights) {
    auto planned = plan_any(scene, Settling::kMeasured, threads, deadline, speed, lights);
    return with_detail_made(scene, std::move(planned), threads, tiles);
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
            if (planned.plan.transport.cells > 0 && asks_for_error(scene, planned)) {
                failed = render_grid_or_paths(scene, planned, tools, deadline, rendered);
                break;
            }
            failed = render_march(scene, planned, tools, deadline, rendered);
            if (!failed && planned.plan.transport.cells == 0)
                failed = measure_or_climb(scene, planned, tools, deadline, rendered);
            break;
        case Method::kPaths:
            if (!asks_for_error(scene, planned)) {
                failed = render_paths(scene, planned, tools, deadline, rendered);
                break;
            }
            planned = planned_for_grids(scene, std::move(planned), tools.threads);
            failed = render_grid_or_paths(scene, planned, tools, deadline, rendered);
            break;
        case Method::kLook:
            rendered.stated_error = std::numeric_limits<double>::quiet_NaN();
            failed = render_look(scene, planned, tools, deadline, rendered);
            break;
        case Method::kDisplay:
            rendered.stated_error = std::numeric_limits<double>::quiet_NaN();
            failed = render_display(scene, planned, tools, deadline, rendered);
            break;
    }
    if (failed) return *failed;
    if (shows_sun_disc(*scene)) {
        const bool film = scene->image.format != ImageFormat::kExr;
        const double most = film ? kBrightestDisc * exact::exp2(-exposure_of(scene))
                                 : std::numeric_limits<double>::infinity();
        const auto start = Deadline::Clock::now();
        add_sun_disc(scene, planned.survey.view, planned.particles,
                     planned.plan.eye_effects().aerial_perspective, most, tools.threads,
                     rendered.image);
        rendered.times.draw_ms += ms_since(start);
    }
    if (planned.plan.rung != rendered.rung->name) {
        planned.plan.rung_reason =
            scene->accuracy.time_ms
                ? "the finest that there was time for; expected was " + planned.plan.rung
                : climbed_reason(planned.plan, *rendered.rung, rendered.stated_error);
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
