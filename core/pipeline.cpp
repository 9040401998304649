#include "core/pipeline.h"

#include <utility>

#include "core/draw/draw.h"
#include "core/draw/march.h"
#include "core/light/light.h"
#include "core/light/transport.h"
#include "core/looks/looks.h"
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

using SharedLight = std::shared_ptr<const TransportLight>;

Result<SharedLight> kept_or_solved(const Scene& scene, const Planned& planned, const Tools& tools,
                                   const Deadline& deadline, bool& was_kept) {
    const TransportSettings& settings = planned.plan.transport;
    const std::string key = tools.lights ? light_key(scene, settings, planned.particles.variant,
                                                     planned.particles.detail.get())
                                         : std::string();
    if (tools.lights)
        if (SharedLight light = tools.lights->find(key)) {
            was_kept = true;
            return light;
        }
    auto solved = transport_light(scene, planned.particles, planned.survey, settings, tools.threads,
                                  deadline);
    if (!solved.ok()) return solved.error();
    SharedLight light = std::make_shared<const TransportLight>(*std::move(solved));
    if (tools.lights) tools.lights->keep(key, light);
    return light;
}

// Transport on a grid, then the march.
Status render_march(const Scene& scene, const Planned& planned, const Tools& tools,
                    const Deadline& deadline, Rendered& rendered) {
    auto light = timed(rendered.times.light_ms, [&] {
        return kept_or_solved(scene, planned, tools, deadline, rendered.light_was_kept);
    });
    if (!light.ok()) return light.error();
    if (!rendered.light_was_kept) rendered.times.effects.add((*light)->took);
    auto image = timed(rendered.times.draw_ms, [&] {
        MarchSettings settings;
        settings.eye_effects = planned.plan.eye_effects();
        return march(scene, planned.particles, planned.survey.view, **light, settings,
                     tools.threads, deadline, &rendered.times.effects);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    return std::nullopt;
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
    Status failed;
    switch (planned.plan.predicted.rung->method) {
        case Method::kSplats:
            failed = render_splats(scene, planned, tools, deadline, rendered);
            break;
        case Method::kMarch:
            failed = render_march(scene, planned, tools, deadline, rendered);
            break;
        case Method::kPaths:
            failed = render_paths(scene, planned, tools, deadline, rendered);
            break;
        case Method::kLook:
            failed = render_look(scene, planned, tools, deadline, rendered);
            break;
    }
    if (failed) return *failed;
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

const char* engine_version() {
    return AWAN_VERSION;
}

}  // namespace awan
