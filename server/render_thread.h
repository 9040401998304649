// One thread owns the GL context; requests reach it through a bounded queue.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "core/pipeline.h"

namespace awan {

struct RenderJobResult {
    Result<Rendered> rendered;
    double queue_ms = 0;
};

class RenderThread {
  public:
    // Starts the thread, which opens the device and draws once so that the first request finds it
    // warm. Never blocks; info() says how it went.
    RenderThread(DeviceChoice choice, std::size_t queue_length);
    ~RenderThread();  // stops; what is queued fails with kCancelled
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    struct Info {
        enum class State { kStarting, kReady, kNoRenderer } state = State::kStarting;
        DeviceInfo device;   // when kReady
        std::string reason;  // when kNoRenderer
    };
    Info info() const;                // never waits for a render
    std::size_t waiting() const;      // renders queued or running
    void wait_until_started() const;  // for the command line and tests

    // Runs the two passes on the render thread and waits for them. nullopt: the queue is full
    // (nothing was queued). A job whose deadline passes while it waits is answered then and never
    // started.
    std::optional<RenderJobResult> render(const Scene& scene, Planned planned,
                                          const Deadline& deadline);

    // A fair guess of when the queue has room, seconds >= 1, for Retry-After.
    int retry_after_seconds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace awan
