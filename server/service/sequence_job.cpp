// The frames of a sequence as one animation. What is settled for all frames is settled once; then each frame has a
// lane for itself, so that others compute between two of them.
#include <chrono>
#include <thread>
#include <utility>

#include "core/formats/animation.h"
#include "core/formats/image_file.h"
#include "core/sequence.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

// That an animation shows.
constexpr double kFramesPerSecond = 12;

// One frame, drawn; or what is to be said instead.
Drawn frame_of(Service::State& state, const Request& request, const Settled& settled, double time,
               Scene& scene) {
    Lanes::Pass pass(state.lanes);
    const LaneWork work{Weight::kLong, 2 * kShort_ms, request.client};
    if (auto refused =
            not_let_in(pass.enter(work, request.deadline), state.lanes, Weight::kLong, request))
        return {std::move(refused), Error{}};
    Frame frame = frame_at(settled, time);
    auto planned = with_detail_made(
        frame.scene,
        plan_frame(frame, threads_of_one(state), request.deadline, state.options.speed),
        threads_of_one(state), &state.tiles);
    if (!planned) return {std::nullopt, planned.error()};
    scene = std::move(frame.scene);
    Request inner = request;
    // A frame's own progress is not that of the whole.
    inner.progress = {};
    return draw_in_lanes(state, inner, scene, *std::move(planned), 0, pass);
}

}  // namespace

Response answer_sequence(Service::State& state, const Request& request, const std::string& format) {
    auto scene = read_request_scene(request);
    if (!scene) return fail(scene.error(), request);
    const Sequence& sequence = *(*scene)->sequence;
    const WorkBudget::Lease lease = state.budget.take(work_bytes(**scene, true));
    if (!lease) return no_memory(state, request);
    const auto settled = [&]() -> Result<Settled> {
        Lanes::Pass pass(state.lanes);
        const LaneWork work{Weight::kLong, 2 * kShort_ms, request.client};
        while (pass.enter(work, request.deadline) != Lanes::Entry::kIn)
            if (const auto over = request.deadline.over()) return *over;
        return settle(*scene, Settling::kMeasured, {&state.settling_lights, threads_of_one(state)},
                      request.deadline);
    }();
    if (!settled) return fail(settled.error(), request);
    auto animation =
        Animation::begin(format == "apng" ? AnimationFormat::kApng : AnimationFormat::kWebp,
                         kFramesPerSecond, sequence.frames);
    if (!animation) return fail(animation.error(), request);
    for (std::uint64_t i = 0; i < sequence.frames;) {
        Scene still = *scene;
        Drawn drawn = frame_of(state, request, *settled, frame_time(sequence, i), still);
        // The lines are full at the moment. What has been drawn is not lost for that.
        if (drawn.refused && drawn.refused->status == 429 && !request.deadline.over()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            continue;
        }
        if (drawn.refused) return std::move(*drawn.refused);
        if (!drawn.rendered) return fail(drawn.rendered.error(), request);
        const double exposure = still->image.exposure.value_or(auto_exposure(still));
        if (const Status failed = animation->add(drawn.rendered->image, exposure))
            return fail(*failed, request);
        ++i;
        if (request.progress)
            request.progress(static_cast<double>(i) / static_cast<double>(sequence.frames));
    }
    auto bytes = animation->end();
    if (!bytes) return fail(bytes.error(), request);
    Response response;
    response.headers = {{"Content-Type", format == "apng" ? "image/apng" : "image/webp"},
                        {"Cache-Control", "no-store"}};
    response.body = *std::move(bytes);
    return response;
}

}  // namespace awan
