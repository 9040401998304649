// What the rooms of the service share (service.cpp, service_scene.cpp); nobody else includes it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>

#include "server/pages.h"
#include "server/service.h"
#include "server/work_budget.h"

namespace awan {

// Lets so many threads compute at once: more would only share the processors and hold memory
// longer.
class WorkGate {
  public:
    explicit WorkGate(std::size_t places) : free_(std::max<std::size_t>(places, 1)) {}

    // One thread's pass through the gate; leave() may come before the end of the scope.
    class Pass {
      public:
        explicit Pass(WorkGate& gate) : gate_(gate) {}
        ~Pass() { leave(); }
        Pass(const Pass&) = delete;
        Pass& operator=(const Pass&) = delete;

        Status enter(const Deadline& deadline) {
            std::unique_lock lock(gate_.mutex_);
            while (gate_.free_ == 0) {
                if (auto over = deadline.over()) return over;
                gate_.freed_.wait_for(lock, std::chrono::milliseconds(20));
            }
            --gate_.free_;
            inside_ = true;
            return std::nullopt;
        }
        void leave() {
            if (!std::exchange(inside_, false)) return;
            const std::lock_guard lock(gate_.mutex_);
            ++gate_.free_;
            gate_.freed_.notify_one();
        }

      private:
        WorkGate& gate_;
        bool inside_ = false;
    };

  private:
    std::mutex mutex_;
    std::condition_variable freed_;
    std::size_t free_;
};

struct Service::State {
    State(RenderThread& r, Metrics& m, ServiceOptions o)
        : renderer(r), metrics(m), options(o), budget(o.work_bytes), gate(o.working) {}

    RenderThread& renderer;
    Metrics& metrics;
    const ServiceOptions options;
    std::atomic<bool> draining{false};
    WorkBudget budget;
    WorkGate gate;
    const std::vector<Page> pages = make_pages();
    const std::vector<Preset> presets = make_presets();
    std::string presets_json;
    std::string presets_etag;
};

// All values of a header that may be repeated, as one list.
std::string joined_header(const Request& request, std::string_view name);

// 304 without a body, with what a cache keeps.
Response not_modified(std::string_view etag, bool varies);

// The POST routes. `check_scene_request` says what is wrong before the body is looked at.
std::optional<Response> check_scene_request(const Request& request);
Response answer_scene_request(Service::State& state, const Request& request);

}  // namespace awan
