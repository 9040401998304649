// What the rooms of the service share (service.cpp, scene.cpp); nobody else includes it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>

#include "core/light/light_cache.h"
#include "server/limits.h"
#include "server/service/pages.h"
#include "server/service/service.h"
#include "server/service/work_budget.h"

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
        // Does not wait; false when there is no place.
        bool try_enter() {
            const std::lock_guard lock(gate_.mutex_);
            if (gate_.free_ == 0) return false;
            --gate_.free_;
            inside_ = true;
            return true;
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
    // At most one measurement of accuracy: two at once would measure each other.
    WorkGate sweeps{1};
    DetailTiles tiles;
    // Of the frames by which the rungs of sequences are settled: for the frames that are asked for next.
    LightCache settling_lights{limits::kSettlingLightBytes};
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

// POST /v1/accuracy: its query, and its answer as `type`.
inline constexpr std::string_view kAccuracyPath = "/v1/accuracy";
Status check_accuracy_query(const Request& request);
Response answer_accuracy(Service::State& state, const Request& request, const Scene& scene,
                         std::string_view type);

// An error as an answer; nobody waits for that of a cancelled request.
Response fail(const Error& error, const Request& request);
// 429: come again.
Response busy(Service::State& state, const Request& request, std::string_view detail);
// `queue;dur=0.100, draw;dur=12.500`, for Server-Timing.
std::string server_timing(std::span<const std::pair<const char*, double>> milliseconds);

}  // namespace awan
