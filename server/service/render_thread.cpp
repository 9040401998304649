#include "server/service/render_thread.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "core/scene/validate.h"

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

OpenRenderer device_renderer(DeviceChoice choice, int threads) {
    return [choice, threads]() -> Result<Renderer> {
        auto opened = Device::open(choice);
        if (!opened) return opened.error();
        auto device = std::make_shared<Device>(std::move(opened).value());
        if (const Status failed = draw_once(*device))
            return Error{ErrorCode::kNoRenderer, "",
                         "the first picture failed: " + failed->message};
        Renderer renderer;
        renderer.info = device->info();
        const auto lights = std::make_shared<LightCache>(kLightCacheBytes);
        renderer.render = [device, lights, threads](const Scene& scene, Planned planned,
                                                    const Deadline& deadline) {
            return render_planned(scene, std::move(planned),
                                  {device.get(), threads, lights.get(), {}, {}}, deadline);
        };
        return renderer;
    };
}

struct RenderThread::State {
    mutable std::mutex mutex;
    // Notified when the queue, a result or `info` changes.
    mutable std::condition_variable changed;
    // How many places there are, and how many are taken.
    std::size_t places = 0;
    std::size_t taken = 0;
    std::deque<Job*> queue;
    Info info;
    // The running mean of a render's time.
    double typical_ms = 50;
    bool stopping = false;
    std::thread thread;

    void run(const OpenRenderer& open);
    void serve(const Renderer& renderer);
};

void RenderThread::State::run(const OpenRenderer& open) {
    std::optional<Renderer> renderer;
    Info outcome;
    outcome.state = Info::State::kNoRenderer;
    try {
        auto opened = open();
        if (opened) {
            renderer = std::move(opened).value();
            outcome.state = Info::State::kReady;
            outcome.device = renderer->info;
        } else {
            outcome.reason = opened.error().message;
        }
    } catch (const std::exception& e) {
        outcome.reason = e.what();
    }
    {
        const std::lock_guard lock(mutex);
        info = outcome;
        changed.notify_all();
    }
    serve(renderer ? *renderer : Renderer{});
}

void RenderThread::State::serve(const Renderer& renderer) {
    std::unique_lock lock(mutex);
    for (;;) {
        changed.wait(lock, [&] { return stopping || !queue.empty(); });
        if (stopping) break;
        Job* job = queue.front();
        queue.pop_front();
        job->queue_ms = ms_since(job->queued_at);
        Planned planned = std::move(*job->planned);
        const std::string no_renderer = info.reason;

        lock.unlock();
        const auto start = Clock::now();
        std::optional<Result<Rendered>> result;
        if (const auto over = job->deadline->over()) {
            result = *over;
        } else if (!renderer.render) {
            result = Error{ErrorCode::kNoRenderer, "", "no renderer: " + no_renderer};
        } else {
            try {
                result = renderer.render(*job->scene, std::move(planned), *job->deadline);
            } catch (const std::exception&) {
                result = Error{ErrorCode::kInternal, "", "the render threw an exception"};
            }
        }
        const double took_ms = ms_since(start);

        lock.lock();
        if (result->ok()) typical_ms += 0.2 * (took_ms - typical_ms);
        job->result = std::move(result);
        changed.notify_all();
    }
    for (Job* job : queue) job->result = Error{ErrorCode::kCancelled, "", "the server stops"};
    queue.clear();
    changed.notify_all();
}

RenderThread::RenderThread(OpenRenderer open, std::size_t queue_length)
    : state_(std::make_unique<State>()) {
    state_->places = queue_length + 1;
    state_->thread =
        std::thread([state = state_.get(), open = std::move(open)] { state->run(open); });
}

RenderThread::RenderThread(DeviceChoice choice, int threads, std::size_t queue_length)
    : RenderThread(device_renderer(choice, threads), queue_length) {}

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

std::size_t RenderThread::waiting() const {
    const std::lock_guard lock(state_->mutex);
    return state_->taken;
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

RenderThread::Place RenderThread::take_place() {
    const std::lock_guard lock(state_->mutex);
    if (state_->taken == state_->places) return Place{};
    ++state_->taken;
    return Place(state_.get());
}

RenderThread::Place::~Place() {
    if (!state_) return;
    const std::lock_guard lock(state_->mutex);
    --state_->taken;
}

RenderJobResult RenderThread::render(const Place& place, const Scene& scene, Planned planned,
                                     const Deadline& deadline) {
    assert(place.state_ == state_.get());
    (void)place;
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
        if (auto over = deadline.over()) {
            state_->queue.erase(waiting);
            return {*over, ms_since(job.queued_at)};
        }
    }
    return {std::move(*job.result), job.queue_ms};
}

int RenderThread::retry_after_seconds() const {
    const std::lock_guard lock(state_->mutex);
    const double ms = state_->typical_ms * static_cast<double>(state_->taken);
    return static_cast<int>(std::clamp(std::ceil(ms / 1000), 1.0, 60.0));
}

}  // namespace awan
