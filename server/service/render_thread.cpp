#include "server/service/render_thread.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/thrown.h"
#include "core/scene/validate.h"
#include "server/service/lanes.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

// How often a waiting request looks whether its client has gone.
constexpr std::chrono::milliseconds kLookForClient{20};

struct Job {
    const Scene* scene = nullptr;
    std::optional<Planned> planned;
    const Deadline* deadline = nullptr;
    Clock::time_point queued_at;
    double queue_ms = 0;
    std::optional<Result<Rendered>> result;
};

// A first picture compiles the shaders and fills the driver's caches: 60 to 110 ms that no client
// should wait for.
Status draw_once(Device& device) {
    SceneDraft draft;
    Cloud cloud;
    Cube cube;
    cube.particles = 64;
    cube.size = {2, 1, 2};
    cube.radius = 0.5;
    cloud.cubes.push_back(cube);
    draft.clouds.push_back(cloud);
    draft.image.width = draft.image.height = 64;
    draft.accuracy.rung = "harris";
    auto scene = validate(std::move(draft));
    if (!scene) return scene.error();
    auto rendered = render_scene(*scene, {&device, 1, nullptr, {}, {}}, Deadline{});
    if (!rendered) return rendered.error();
    return std::nullopt;
}

}  // namespace

OpenRenderer device_renderer(DeviceChoice choice, int threads, std::shared_ptr<LightCache> lights) {
    return [choice, threads, lights = std::move(lights)]() -> Result<Renderer> {
        auto opened = Device::open(choice);
        if (!opened) return opened.error();
        auto device = std::make_shared<Device>(std::move(opened).value());
        if (const Status failed = draw_once(*device))
            return Error{ErrorCode::kNoRenderer, "",
                         "the first picture failed: " + failed->message};
        Renderer renderer;
        renderer.info = device->info();
        renderer.render = [device, lights, threads](const Scene& scene, Planned planned,
                                                    const Deadline& deadline) {
            return render_planned(scene, std::move(planned),
                                  {device.get(), threads, lights.get(), {}, {}}, deadline);
        };
        return renderer;
    };
}

RenderOnProcessor processor_renderer(std::shared_ptr<LightCache> lights) {
    return [lights = std::move(lights)](const Scene& scene, Planned planned, int threads,
                                        const Progress& progress, const Deadline& deadline) {
        return render_planned(scene, std::move(planned),
                              {nullptr, threads, lights.get(), progress, {}}, deadline);
    };
}

bool needs_device(const Plan& plan) {
    return plan.predicted.rung != nullptr && needs_renderer(plan.predicted.rung->method);
}

struct RenderThread::State {
    mutable std::mutex mutex;
    // Notified when the queue, a result or `info` changes.
    mutable std::condition_variable changed;
    std::deque<Job*> queue;
    Info info;
    std::size_t opened = 0;
    bool stopping = false;
    std::thread thread;

    void run(const OpenRenderer& open);
    std::optional<Renderer> open_again(const OpenRenderer& open);
    Result<Rendered> render(const std::optional<Renderer>& renderer, Job& job);
};

std::optional<Renderer> RenderThread::State::open_again(const OpenRenderer& open) {
    std::optional<Renderer> renderer;
    Info outcome;
    outcome.state = Info::State::kNoRenderer;
    try {
        auto result = open();
        if (result) {
            renderer = std::move(result).value();
            outcome.state = Info::State::kReady;
            outcome.device = renderer->info;
        } else {
            outcome.reason = result.error().message;
        }
    } catch (const std::exception& e) {
        outcome.reason = e.what();
    }
    const std::lock_guard lock(mutex);
    info = std::move(outcome);
    ++opened;
    changed.notify_all();
    return renderer;
}

Result<Rendered> RenderThread::State::render(const std::optional<Renderer>& renderer, Job& job) {
    if (const auto over = job.deadline->over()) return *over;
    try {
        if (!renderer) return Error{ErrorCode::kNoRenderer, "", "no renderer: " + info.reason};
        return renderer->render(*job.scene, std::move(*job.planned), *job.deadline);
    } catch (const std::exception& e) {
        return error_of_thrown(e);
    }
}

void RenderThread::State::run(const OpenRenderer& open) {
    std::optional<Renderer> renderer = open_again(open);
    // Where there never was one, none will be found.
    const bool worth_it = renderer.has_value();
    std::unique_lock lock(mutex);
    for (;;) {
        changed.wait(lock, [&] { return stopping || !queue.empty(); });
        if (stopping) break;
        Job* job = queue.front();
        queue.pop_front();
        job->queue_ms = ms_since(job->queued_at);

        lock.unlock();
        if (!renderer && worth_it) renderer = open_again(open);
        std::optional<Result<Rendered>> result;
        try {
            result.emplace(render(renderer, *job));
        } catch (const std::exception&) {
            // Not even for the words of an error.
            result.emplace(Error{ErrorCode::kOutOfMemory, {}, {}});
        }
        // A bug, no memory, a context that was lost: what is opened anew knows nothing of it.
        const bool at_fault = !result->ok() && (result->error().code == ErrorCode::kInternal ||
                                                result->error().code == ErrorCode::kOutOfMemory ||
                                                result->error().code == ErrorCode::kNoRenderer);
        if (at_fault) renderer.reset();

        lock.lock();
        job->result = std::move(result);
        changed.notify_all();
    }
    for (Job* job : queue) job->result = Error{ErrorCode::kCancelled, "", "the server stops"};
    queue.clear();
    changed.notify_all();
}

RenderThread::RenderThread(OpenRenderer open) : state_(std::make_unique<State>()) {
    state_->thread =
        std::thread([state = state_.get(), open = std::move(open)] { state->run(open); });
}

RenderThread::~RenderThread() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
        state_->changed.notify_all();
    }
    state_->thread.join();
}

RenderThread::Info RenderThread::info() const {
    const std::lock_guard lock(state_->mutex);
    return state_->info;
}

std::size_t RenderThread::reopened() const {
    const std::lock_guard lock(state_->mutex);
    return state_->opened > 1 ? state_->opened - 1 : 0;
}

void RenderThread::wait_until_started() const {
    (void)wait_until_started(Deadline{});
}

Status RenderThread::wait_until_started(const Deadline& deadline) const {
    std::unique_lock lock(state_->mutex);
    while (state_->info.state == Info::State::kStarting) {
        if (auto over = deadline.over()) return over;
        state_->changed.wait_for(lock, kLookForClient);
    }
    return std::nullopt;
}

RenderJobResult RenderThread::render(const Scene& scene, Planned planned,
                                     const Deadline& deadline) {
    Job job;
    job.scene = &scene;
    job.planned = std::move(planned);
    job.deadline = &deadline;
    job.queued_at = Clock::now();

    std::unique_lock lock(state_->mutex);
    if (state_->stopping) return {Error{ErrorCode::kCancelled, "", "the server stops"}, 0};
    state_->queue.push_back(&job);
    state_->changed.notify_all();
    while (!job.result) {
        state_->changed.wait_for(lock, kLookForClient);
        const auto waiting = std::find(state_->queue.begin(), state_->queue.end(), &job);
        // The job is done, or running.
        if (job.result || waiting == state_->queue.end()) continue;
        if (has_passed(deadline)) {
            state_->queue.erase(waiting);
            return {*deadline.over(), ms_since(job.queued_at)};
        }
    }
    return {std::move(*job.result), job.queue_ms};
}

}  // namespace awan
