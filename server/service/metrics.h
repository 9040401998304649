// Counters and histograms in Prometheus' text format. Thread-safe; bounded: label values come from
// fixed sets.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/service/disk_cache.h"
#include "server/service/lanes.h"

namespace awan {

// What stands at this moment.
struct Gauges {
    bool ready = false;
    // The splat rungs can be drawn.
    bool renderer = false;
    std::size_t renderer_reopened = 0;
    std::size_t in_progress = 0;
    Lanes::Load lanes{};
    Lanes::Load device_lane{};
    std::size_t work_bytes = 0, work_bytes_most = 0;
    std::size_t cache_bytes = 0, cache_entries = 0;
    DiskCache::Counts disk{};
    std::size_t jobs_waiting = 0, jobs_running = 0, job_bytes = 0;
};

// What /metrics shows.
class Metrics {
  public:
    Metrics();
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    // `route` is a route's pattern ("/v1/presets/{name}"), or "other"; never the client's text.
    void request_done(std::string_view route, int status, double seconds);
    void stage_done(std::string_view stage,
                    // stage: "generate", "survey", "light", "draw", "encode" or "queue".
                    double milliseconds);
    // A connection or request that never reached a route: "framing", "access", "timeout",
    // "connections", "requests", "memory".
    void connection_refused(std::string_view reason);

    // An answer was looked for among those that are kept: it was there, or it was rendered. Hits on disk are the disk
    // cache's own to count.
    void cache_asked(bool hit);

    std::string text(const Gauges& now) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Resident memory of this process, bytes; 0 when the kernel does not say.
std::size_t resident_bytes();

}  // namespace awan
