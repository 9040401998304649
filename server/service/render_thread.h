// One thread owns the GL context; requests reach it through a bounded queue.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/pipeline.h"

namespace awan {

// What came of a render, and how long it waited in the queue.
struct RenderJobResult {
    Result<Rendered> rendered;
    double queue_ms = 0;
};

// What the render thread opens, uses and closes: a device and the two passes over it.
struct Renderer {
    DeviceInfo info;
    std::function<Result<Rendered>(const Scene&, Planned, const Deadline&)> render;
};
using OpenRenderer = std::function<Result<Renderer>()>;

// Lights that are kept while cameras move: about ten of the largest rungs', hundreds of the common.
inline constexpr std::size_t kLightCacheBytes = 256u << 20;

// Opens the device and draws once, so that the first request finds it warm. One render runs at a time; the rungs that
// need no device use `threads`.
OpenRenderer device_renderer(DeviceChoice choice, int threads);

// The thread and its queue. Thread-safe.
class RenderThread {
    struct State;

  public:
    // Starts the thread, which opens the renderer; everything in it happens on that thread. Never
    // blocks; info() says how it went. `queue_length`: renders that may wait beside the one that
    // runs.
    RenderThread(OpenRenderer open, std::size_t queue_length);
    RenderThread(DeviceChoice choice, int threads, std::size_t queue_length);
    // Stops; what is queued fails with kCancelled.
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    struct Info {
        enum class State { kStarting, kReady, kNoRenderer } state = State::kStarting;
        // Set when kReady.
        DeviceInfo device;
        // Set when kNoRenderer.
        std::string reason;
    };
    // How the renderer stands. Never waits for a render.
    Info info() const;
    // How many places are taken: by renders that are planned, queued or running.
    std::size_t waiting() const;
    // Waits until the renderer is open or could not be opened; for the command line and tests.
    void wait_until_started() const;
    // The same for a request: the error when `deadline` is over before.
    Status wait_until_started(const Deadline& deadline) const;

    // A place in the queue. It is taken before a scene is planned, so that a full queue refuses a
    // request before it has cost anything. Must not outlive the RenderThread.
    class Place {
      public:
        Place() = default;
        Place(Place&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}
        Place& operator=(Place&& other) noexcept {
            std::swap(state_, other.state_);
            return *this;
        }
        ~Place();
        explicit operator bool() const { return state_ != nullptr; }

      private:
        friend class RenderThread;
        explicit Place(State* state) : state_(state) {}
        State* state_ = nullptr;
    };
    // False when the queue is full.
    Place take_place();

    // Runs the two passes on the render thread and waits for them. A job whose deadline passes or
    // whose client goes while it waits is answered then and never started.
    // Precondition: `place` was taken here.
    RenderJobResult render(const Place& place, const Scene& scene, Planned planned,
                           const Deadline& deadline);

    // A fair guess of when the queue has room, seconds >= 1, for Retry-After.
    int retry_after_seconds() const;

  private:
    std::unique_ptr<State> state_;
};

}  // namespace awan
