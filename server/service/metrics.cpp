#include "server/service/metrics.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <mutex>

#include "core/formats/particle_files.h"
#include "core/pipeline.h"

namespace awan {
namespace {

// Upper bounds, seconds: from a plan of a small cloud to the longest render a deadline allows.
constexpr std::array<double, 14> kBounds = {.0005, .001, .0025, .005, .01, .025, .05,
                                            .1,    .25,  .5,    1,    2.5, 10,   30};

struct Histogram {
    // Of each bound: how many took at most that long.
    std::array<std::uint64_t, kBounds.size()> below{};
    std::uint64_t count = 0;
    double sum = 0;

    void add(double value) {
        for (std::size_t i = 0; i < kBounds.size(); ++i)
            if (value <= kBounds[i]) ++below[i];
        ++count;
        sum += value;
    }
};

void append_head(std::string& out, std::string_view name, std::string_view type,
                 std::string_view help) {
    out.append("# HELP ").append(name).append(" ").append(help);
    out.append("\n# TYPE ").append(name).append(" ").append(type).append("\n");
}

void append_histogram(std::string& out, const std::string& name, const std::string& label,
                      const Histogram& histogram) {
    for (std::size_t i = 0; i < kBounds.size(); ++i) {
        out += name + "_bucket{" + label + ",le=\"";
        append_number(kBounds[i], out);
        out += "\"} " + std::to_string(histogram.below[i]) + "\n";
    }
    const std::string count = std::to_string(histogram.count);
    out += name + "_bucket{" + label + ",le=\"+Inf\"} " + count + "\n";
    out += name + "_sum{" + label + "} ";
    append_number(histogram.sum, out);
    out += "\n" + name + "_count{" + label + "} " + count + "\n";
}

}  // namespace

struct Metrics::State {
    mutable std::mutex mutex;
    // How many requests, by route and hundreds of the status.
    std::map<std::pair<std::string, int>, std::uint64_t> requests;
    // How long they took, by route; and how long stages took, by stage.
    std::map<std::string, Histogram, std::less<>> seconds;
    std::map<std::string, Histogram, std::less<>> stages;
    std::map<std::string, std::uint64_t, std::less<>> refused;
};

Metrics::Metrics() : state_(std::make_unique<State>()) {}
Metrics::~Metrics() = default;

void Metrics::request_done(std::string_view route, int status, double seconds) {
    const std::lock_guard lock(state_->mutex);
    ++state_->requests[{std::string(route), status / 100}];
    state_->seconds[std::string(route)].add(seconds);
}

void Metrics::stage_done(std::string_view stage, double milliseconds) {
    const std::lock_guard lock(state_->mutex);
    state_->stages[std::string(stage)].add(milliseconds / 1000);
}

void Metrics::connection_refused(std::string_view reason) {
    const std::lock_guard lock(state_->mutex);
    ++state_->refused[std::string(reason)];
}

std::string Metrics::text(std::size_t renders_waiting, bool ready) const {
    std::string out;
    const std::lock_guard lock(state_->mutex);
    append_head(out, "awan_http_requests_total", "counter", "Answers by route and status class.");
    for (const auto& [key, count] : state_->requests)
        out += "awan_http_requests_total{route=\"" + key.first + "\",status=\"" +
               std::to_string(key.second) + "xx\"} " + std::to_string(count) + "\n";
    append_head(out, "awan_http_request_duration_seconds", "histogram",
                "From the end of the body to the answer being ready.");
    for (const auto& [route, histogram] : state_->seconds)
        append_histogram(out, "awan_http_request_duration_seconds", "route=\"" + route + "\"",
                         histogram);
    append_head(out, "awan_stage_duration_seconds", "histogram", "Stages of the pipeline.");
    for (const auto& [stage, histogram] : state_->stages)
        append_histogram(out, "awan_stage_duration_seconds", "stage=\"" + stage + "\"", histogram);
    append_head(out, "awan_connections_refused_total", "counter",
                "Connections and requests that never reached a route.");
    for (const auto& [reason, count] : state_->refused)
        out += "awan_connections_refused_total{reason=\"" + reason + "\"} " +
               std::to_string(count) + "\n";
    append_head(out, "awan_render_queue_length", "gauge", "Renders planned, queued or running.");
    out += "awan_render_queue_length " + std::to_string(renders_waiting) + "\n";
    append_head(out, "awan_ready", "gauge", "1 when /readyz says 200.");
    out += ready ? "awan_ready 1\n" : "awan_ready 0\n";
    append_head(out, "awan_build_info", "gauge", "Always 1; the version is its label.");
    out += std::string("awan_build_info{version=\"") + engine_version() + "\"} 1\n";
    append_head(out, "process_resident_memory_bytes", "gauge", "Resident memory size in bytes.");
    out += "process_resident_memory_bytes " + std::to_string(resident_bytes()) + "\n";
    return out;
}

std::size_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t total_pages = 0;
    std::size_t resident_pages = 0;
    statm >> total_pages >> resident_pages;
    return statm ? resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace awan
