#include "core/sequence.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/generate/generate.h"
#include "core/plan/island_settings.h"
#include "core/planning.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// `draft` is a valid one but for values that were taken from valid frames.
Scene valid(SceneDraft draft) {
    return validate(std::move(draft)).value();
}

Bounds joined(const Bounds& a, const Bounds& b) {
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

// Of a sequence with camera keys.
Camera moved_camera(const SceneDraft& draft, const Sequence& sequence, double time) {
    const glm::dvec3 up = draft.camera.automatic ? Camera{}.up : draft.camera.up;
    return camera_at(sequence.camera, sequence.linear_camera, up, time);
}

// So many tell what all frames see: a turn in steps of 6 degrees.
constexpr std::uint64_t kMostViews = 60;

View view_at(const SceneDraft& draft, const Sequence& sequence, std::uint64_t frame) {
    const Camera camera = moved_camera(draft, sequence, frame_time(sequence, frame));
    return resolve_view(camera, draft.image, {});
}

std::vector<View> views_of(const SceneDraft& draft, const Sequence& sequence) {
    std::vector<View> views;
    const std::uint64_t count = std::min(sequence.frames, kMostViews);
    for (std::uint64_t k = 0; k < count; ++k) {
        const std::uint64_t frame = count < 2 ? 0 : k * (sequence.frames - 1) / (count - 1);
        views.push_back(view_at(draft, sequence, frame));
    }
    return views;
}

// The first, the middle and the last.
using Times = std::array<double, 3>;
Times three_times(const Sequence& sequence) {
    return {sequence.from, 0.5 * (sequence.from + sequence.to), sequence.to};
}

// Where the automatic camera stands to hold the clouds at all of the times.
Result<Camera> hold_all(const SceneDraft& draft, const Sequence& sequence, int threads,
                        const Deadline& deadline) {
    const auto bounds = bounds_of_sequence(draft, sequence, threads, deadline);
    if (!bounds.ok()) return bounds.error();
    const View view = resolve_view(draft.camera, draft.image, *bounds);
    Camera camera;
    camera.automatic = false;
    camera.eye = view.eye;
    // Far enough for the direction to keep its digits.
    const double far = std::max(1e-3 * glm::length(view.eye), 1.0);
    camera.target = view.eye + far * view.forward;
    camera.fov = kAutomaticFov;
    return camera;
}

// Of one of the three frames.
struct FramePlan {
    double time = 0;
    Plan plan;
    DetailFigures detail;
    bool empty = false;
};

// As every machine plans it. time: in the sequence. error: that paths would have to keep to, if any.
Result<FramePlan> plan_frame_for_all(const Scene& scene, double time,
                                     const std::optional<double>& error, int threads,
                                     const Deadline& deadline) {
    auto planned = plan_still(scene, threads, deadline, {}, {});
    if (!planned.ok()) return planned.error();
    const Survey& survey = planned->survey;
    FramePlan frame{time, plan(scene, survey, kCalibratedThreads, {}), survey.detail,
                    planned->particles.size() == 0 || !(survey.total_mass > 0)};
    if (error)
        plan_samples(frame.plan, samples_for(*error, scene, survey), scene, survey,
                     kCalibratedThreads, {});
    return frame;
}

void settle_effects_and_detail(const Plan& plan, const DetailFigures& detail, SceneDraft& effects,
                               std::optional<DetailFigures>& settled) {
    for (const EffectDecision& decision : plan.effects) {
        Switch& asked = effects.effects[static_cast<int>(decision.effect)];
        if (decision.on && asked == Switch::kAuto) asked = Switch::kOn;
    }
    if (!settled) {
        settled = detail;
    } else {
        settled->extinction = std::max(settled->extinction, detail.extinction);
        settled->radius = std::max(settled->radius, detail.radius);
    }
}

void name_rung(const Rung& rung, Settled& settled) {
    settled.draft.accuracy = {{}, {}, std::string(rung.name)};
}

// The finest rung that a frame calls for, or where a time is asked for, the cheapest.
void settle_by_forecast(const Accuracy& accuracy, const std::vector<FramePlan>& plans,
                        Settled& settled) {
    const Rung* chosen = nullptr;
    for (const FramePlan& frame : plans) {
        const Rung* const own = frame.plan.predicted.rung;
        if (chosen == nullptr || (accuracy.time_ms ? own->id < chosen->id : own->id > chosen->id))
            chosen = own;
    }
    name_rung(*chosen, settled);
    for (const FramePlan& frame : plans)
        if (chosen->method == Method::kPaths)
            settled.samples =
                std::min(settled.samples.value_or(frame.plan.samples), frame.plan.samples);
    settled.reason =
        "settled for the whole sequence by what its first, middle and last frame call for";
}

const RungForecast& of_rung(const Plan& plan, RungId id) {
    return *std::find_if(plan.forecasts.begin(), plan.forecasts.end(),
                         [&](const RungForecast& forecast) { return forecast.rung->id == id; });
}

// A transport rung and the error of the hardest frame with it.
struct RungError {
    const Rung* rung = nullptr;
    double error = 0;
};

// The coarsest that is forecast to hold, or the finest.
RungError expected_grid(const Scene& scene, const Plan& plan) {
    RungError expected;
    for (const RungForecast& forecast : plan.forecasts) {
        if (forecast.rung->cells == 0) continue;
        expected = {forecast.rung, forecast.error};
        if (holds(expected.error, scene)) break;
    }
    return expected;
}

// The coarsest whose stated error holds, or the finest. settled: all but the rung.
Result<RungError> measured_grid(const Scene& scene, Settled settled, double time,
                                const ClimbTools& tools, const Deadline& deadline) {
    settled.draft.accuracy = scene->accuracy;
    const Frame frame = frame_at(settled, time);
    auto planned = plan_frame(frame, tools.threads, deadline, {});
    if (!planned.ok()) return planned.error();
    const Planned grids = planned_for_grids(frame.scene, *std::move(planned), tools.threads);
    const auto climbed = climb(frame.scene, grids, tools, deadline);
    if (!climbed.ok()) return climbed.error();
    return RungError{climbed->rung, climbed->stated};
}

// By the frame that is forecast to be the hardest; of equals the first.
Result<Settled> settle_by_error(const Scene& scene, Settled settled,
                                const std::vector<FramePlan>& plans, Settling how,
                                const ClimbTools& tools, const Deadline& deadline) {
    const FramePlan& hardest =
        *std::max_element(plans.begin(), plans.end(), [](const FramePlan& a, const FramePlan& b) {
            return of_rung(a.plan, RungId::kTransport32).error <
                   of_rung(b.plan, RungId::kTransport32).error;
        });
    RungError grid = expected_grid(scene, hardest.plan);
    const bool measured = how == Settling::kMeasured && !hardest.empty;
    if (measured) {
        const auto climbed = measured_grid(scene, settled, hardest.time, tools, deadline);
        if (!climbed.ok()) return climbed.error();
        grid = *climbed;
    }
    settled.reason = std::string("settled for the whole sequence by the error that is ") +
                     (measured ? "measured" : "expected") +
                     " of the hardest of its first, middle "
                     "and last frame";
    if (holds(grid.error, scene) || !paths_may_hold(scene, hardest.plan)) {
        name_rung(*grid.rung, settled);
        return settled;
    }
    name_rung(rung_of(RungId::kTruth), settled);
    for (const FramePlan& frame : plans)
        settled.samples = std::max(settled.samples.value_or(0), frame.plan.samples);
    return settled;
}

}  // namespace

double frame_time(const Sequence& sequence, std::uint64_t i) {
    if (sequence.frames < 2) return sequence.from;
    const double share = static_cast<double>(i) / static_cast<double>(sequence.frames - 1);
    return sequence.from + share * (sequence.to - sequence.from);
}

SceneDraft still_of(const SceneDraft& draft, const Sequence& sequence, double time) {
    SceneDraft still = draft;
    still.sequence.reset();
    still.time = sequence.clouds_stand ? sequence.from : time;
    if (sequence.camera.empty()) return still;
    still.camera = moved_camera(draft, sequence, time);
    return still;
}

bool clouds_stand(const SceneDraft& scene) {
    if (scene.sequence->clouds_stand) return true;
    return std::all_of(scene.clouds.begin(), scene.clouds.end(), [](const Cloud& cloud) {
        return !is_procedural(cloud) && cloud.velocity == glm::dvec3(0);
    });
}

Result<Bounds> bounds_of_sequence(const SceneDraft& draft, const Sequence& sequence, int threads,
                                  const Deadline& deadline) {
    std::optional<Bounds> bounds;
    for (const double time : three_times(sequence)) {
        auto particles = generate(valid(still_of(draft, sequence, time)), threads, deadline, true);
        if (!particles.ok()) return particles.error();
        if (particles->size() == 0) continue;
        const Bounds own = bounds_of(*particles);
        bounds = bounds ? joined(*bounds, own) : own;
    }
    return bounds.value_or(Bounds{});
}

Result<Settled> settle(const Scene& scene, Settling how, const ClimbTools& tools,
                       const Deadline& deadline) {
    Settled settled;
    settled.draft = *scene;
    settled.sequence = *scene->sequence;
    if (!settled.sequence.camera.empty() && clouds_stand(*scene))
        settled.views = views_of(*scene, settled.sequence);
    SceneDraft& draft = settled.draft;
    draft.sequence.reset();
    if (draft.camera.automatic && settled.sequence.camera.empty()) {
        auto camera = hold_all(draft, settled.sequence, tools.threads, deadline);
        if (!camera.ok()) return camera.error();
        const Camera own = std::exchange(draft.camera, *camera);
        // It would stand beyond the limits.
        if (!validate(draft).ok()) draft.camera = own;
    }
    if (draft.look != Look::kPhysical || draft.display != Display::kLit) return settled;
    // Which effects there are must not hang on the rung that is expected of a frame.
    const bool for_error = !draft.accuracy.rung && !draft.accuracy.time_ms && !wants_splats(scene);
    std::optional<double> error;
    if (for_error) error = draft.accuracy.error.value_or(kDefaultError);
    std::vector<FramePlan> plans;
    SceneDraft with_effects = draft;
    for (const double time : three_times(settled.sequence)) {
        SceneDraft frame = still_of(draft, settled.sequence, time);
        if (error) frame.accuracy = {{}, {}, rung_of(RungId::kTransport16).name};
        auto planned =
            plan_frame_for_all(valid(std::move(frame)), time, error, tools.threads, deadline);
        if (!planned.ok()) return planned.error();
        settle_effects_and_detail(planned->plan, planned->detail, with_effects, settled.detail);
        plans.push_back(*std::move(planned));
    }
    draft = std::move(with_effects);
    if (draft.accuracy.rung) return settled;
    if (error) return settle_by_error(scene, std::move(settled), plans, how, tools, deadline);
    settle_by_forecast(scene->accuracy, plans, settled);
    return settled;
}

std::vector<View> views_of_frames(const Settled& settled) {
    std::vector<View> views;
    for (std::uint64_t i = 0; i < settled.sequence.frames; ++i)
        views.push_back(view_at(settled.draft, settled.sequence, i));
    return views;
}

Frame frame_at(const Settled& settled, double time) {
    Frame frame{valid(still_of(settled.draft, settled.sequence, time)), settled.detail,
                settled.samples, settled.views, settled.is_unmeasured};
    // The detail's bumps move with the first cloud.
    if (frame.detail && !settled.draft.clouds.empty())
        frame.detail->origin +=
            (frame.scene->time - settled.sequence.from) * settled.draft.clouds[0].velocity;
    return frame;
}

Result<Planned> plan_frame(const Frame& frame, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, StandingMatter* matter) {
    auto planned = matter != nullptr && matter->particles
                       ? plan_particles(frame.scene, *matter->particles, threads, deadline, speed,
                                        frame.detail)
                       : plan_still(frame.scene, threads, deadline, speed, frame.detail);
    if (!planned.ok()) return planned;
    if (matter != nullptr && planned->particles.variant == 0 && !matter->particles)
        matter->particles = planned->particles;
    planned->survey.seen_from = frame.views;
    planned->is_unmeasured = frame.is_unmeasured;
    TransportSettings& transport = planned->plan.transport;
    if (!transport.islands.empty()) transport.islands = island_cells(transport, planned->survey);
    if (frame.samples)
        plan_samples(planned->plan, *frame.samples, frame.scene, planned->survey, threads, speed);
    return planned;
}

}  // namespace awan
