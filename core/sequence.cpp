#include "core/sequence.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/generate/generate.h"
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

// Where the automatic camera stands to hold the clouds at all of the times.
Result<Camera> hold_all(const SceneDraft& draft, const std::array<double, 3>& times, int threads,
                        const Deadline& deadline) {
    std::optional<Bounds> bounds;
    for (const double time : times) {
        SceneDraft frame = draft;
        frame.time = time;
        auto particles = generate(valid(std::move(frame)), threads, deadline, true);
        if (!particles.ok()) return particles.error();
        if (particles->size() == 0) continue;
        const Bounds own = bounds_of(*particles);
        bounds = bounds ? joined(*bounds, own) : own;
    }
    const View view = resolve_view(draft.camera, draft.image, bounds.value_or(Bounds{}));
    Camera camera;
    camera.automatic = false;
    camera.eye = view.eye;
    // Far enough for the direction to keep its digits.
    const double far = std::max(1e-3 * glm::length(view.eye), 1.0);
    camera.target = view.eye + far * view.forward;
    camera.fov = kAutomaticFov;
    return camera;
}

}  // namespace

double frame_time(const Sequence& sequence, std::uint64_t i) {
    if (sequence.frames < 2) return sequence.from;
    const double share = static_cast<double>(i) / static_cast<double>(sequence.frames - 1);
    return sequence.from + share * (sequence.to - sequence.from);
}

Result<Settled> settle(const Scene& scene, int threads, const Deadline& deadline,
                       const MachineSpeed& speed) {
    Settled settled{*scene, {}, scene->sequence->from};
    SceneDraft& draft = settled.draft;
    draft.sequence.reset();
    const Sequence& sequence = *scene->sequence;
    const std::array<double, 3> times = {sequence.from, 0.5 * (sequence.from + sequence.to),
                                         sequence.to};
    if (draft.camera.automatic) {
        auto camera = hold_all(draft, times, threads, deadline);
        if (!camera.ok()) return camera.error();
        const Camera own = std::exchange(draft.camera, *camera);
        // It would stand beyond the limits.
        if (!validate(draft).ok()) draft.camera = own;
    }
    if (draft.look != Look::kPhysical) return settled;
    const Rung* chosen = nullptr;
    const Accuracy& accuracy = scene->accuracy;
    SceneDraft with_effects = draft;
    for (const double time : times) {
        SceneDraft frame = draft;
        frame.time = time;
        auto planned = plan_still(valid(std::move(frame)), threads, deadline, speed, {});
        if (!planned.ok()) return planned.error();
        const Rung* const own = planned->plan.predicted.rung;
        if (chosen == nullptr || (accuracy.time_ms ? own->id < chosen->id : own->id > chosen->id))
            chosen = own;
        for (const EffectDecision& decision : planned->plan.effects) {
            Switch& asked = with_effects.effects[static_cast<int>(decision.effect)];
            if (decision.on && asked == Switch::kAuto) asked = Switch::kOn;
        }
        const DetailFigures& own_detail = planned->survey.detail;
        if (!settled.detail) {
            settled.detail = own_detail;
        } else {
            settled.detail->extinction =
                std::max(settled.detail->extinction, own_detail.extinction);
            settled.detail->radius = std::max(settled.detail->radius, own_detail.radius);
        }
    }
    draft = std::move(with_effects);
    // Rung truth is not named: by name it would have a noise of its own choice instead of the one that the scene's
    // error or time asks for.
    if (chosen->method != Method::kPaths) draft.accuracy = {{}, {}, std::string(chosen->name)};
    return settled;
}

Frame frame_at(const Settled& settled, double time) {
    SceneDraft draft = settled.draft;
    draft.time = time;
    Frame frame{valid(std::move(draft)), settled.detail};
    // The detail's bumps move with the first cloud.
    if (frame.detail && !settled.draft.clouds.empty())
        frame.detail->origin += (time - settled.from) * settled.draft.clouds[0].velocity;
    return frame;
}

}  // namespace awan
