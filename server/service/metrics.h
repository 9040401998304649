// Counters and histograms in Prometheus' text format. Thread-safe; bounded: label values come from
// fixed sets.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace awan {

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

    std::string text(std::size_t renders_waiting, bool ready) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Resident memory of this process, bytes; 0 when the kernel does not say.
std::size_t resident_bytes();

}  // namespace awan
