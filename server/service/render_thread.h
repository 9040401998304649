// One thread owns the GL context; pictures of the splat rungs reach it one by one.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/pipeline.h"

namespace awan {

// What came of a render, and how long it waited for the thread.
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

// Renders a rung that needs no device, on so many threads; thread-safe.
using RenderOnProcessor = std::function<Result<Rendered>(const Scene&, Planned, int threads,
                                                         const Progress&, const Deadline&)>;

// Lights that are kept while cameras move: about ten of the largest rungs', hundreds of the common.
inline constexpr std::size_t kLightCacheBytes = 256u << 20;

// Opens the device and draws once, so that the first request finds it warm. What of a render needs no device runs on
// `threads` threads, with lights that `lights` keeps (null: none).
OpenRenderer device_renderer(DeviceChoice choice, int threads,
                             std::shared_ptr<LightCache> lights = nullptr);

// With lights that `lights` keeps (null: none).
RenderOnProcessor processor_renderer(std::shared_ptr<LightCache> lights = nullptr);

// Whether a plan can be carried out without a device.
bool needs_device(const Plan& plan);

// The thread. Thread-safe. A render that fails by the renderer's fault (it threw, ran out of memory, lost its context)
// closes the renderer, and it is opened anew for the next one.
class RenderThread {
    struct State;

  public:
    // Starts the thread, which opens the renderer; everything in it happens on that thread. Never
    // blocks; info() says how it went.
    explicit RenderThread(OpenRenderer open);
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
    // How often it has been opened again after a failure.
    std::size_t reopened() const;
    // Waits until the renderer is open or could not be opened; for the command line and tests.
    void wait_until_started() const;
    // The same for a request: the error when `deadline` is over before.
    Status wait_until_started(const Deadline& deadline) const;

    // Runs the two passes on the render thread and waits for them. A job whose deadline passes or
    // whose client goes while it waits is answered then and never started. Errors: kNoRenderer where there is none,
    // those of render_planned, kInternal and kOutOfMemory for what was thrown.
    RenderJobResult render(const Scene& scene, Planned planned, const Deadline& deadline);

  private:
    std::unique_ptr<State> state_;
};

}  // namespace awan
