// A renderer without GL whose renders can be held back, so that tests of queues and cancelling do
// not depend on time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "core/plan/plan.h"
#include "server/service/render_thread.h"
#include "tests/patience.h"

namespace awan::test {

class FakeRenderer {
  public:
    // To be given to RenderThread; shares its state with this object.
    OpenRenderer opener() const {
        return [state = state_]() -> Result<Renderer> {
            Renderer renderer;
            renderer.info.renderer = "fake";
            renderer.render = [state](const Scene& scene, Planned planned,
                                      const Deadline& deadline) {
                return render(*state, scene, std::move(planned), deadline);
            };
            return renderer;
        };
    }

    // What renders the rungs that need no device.
    RenderOnProcessor on_processor() const {
        return [state = state_](const Scene& scene, Planned planned, int, const Progress&,
                                const Deadline& deadline) {
            return render(*state, scene, std::move(planned), deadline);
        };
    }

    void hold() { set_held(true); }
    void release() { set_held(false); }
    int begun() const { return state_->begun; }
    int cancelled() const { return state_->cancelled; }

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        bool held = false;
        std::atomic<int> begun{0};
        std::atomic<int> cancelled{0};
    };

    void set_held(bool held) {
        const std::lock_guard lock(state_->mutex);
        state_->held = held;
        state_->changed.notify_all();
    }

    static Result<Rendered> render(State& state, const Scene& scene, Planned planned,
                                   const Deadline& deadline) {
        ++state.begun;
        std::unique_lock lock(state.mutex);
        while (state.held) {
            if (const auto over = deadline.over()) {
                ++state.cancelled;
                return *over;
            }
            state.changed.wait_for(lock, std::chrono::milliseconds(5));
        }
        Rendered rendered{std::move(planned.survey), std::move(planned.plan), {}, planned.times};
        rendered.stated_error = 0.5 * rendered.plan.predicted.error;
        Image& image = rendered.image;
        image.width = scene->image.width;
        image.height = scene->image.height;
        image.opaque = true;
        image.pixels.assign(4 * image.pixel_count(), 1.0f);
        return rendered;
    }

    std::shared_ptr<State> state_ = std::make_shared<State>();
};

// Waits until `condition` holds, at most so long.
template <typename Condition>
bool eventually(Condition condition) {
    const auto until = std::chrono::steady_clock::now() + patience(20);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

}  // namespace awan::test
