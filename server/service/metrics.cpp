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

void append_disk_cache(const DiskCache::Counts& disk, std::string& out) {
    const auto one = [&](const char* name, const char* type, const char* help,
                         std::uint64_t value) {
        const std::string whole = std::string("awan_cache_disk_") + name;
        append_head(out, whole, type, help);
        out += whole + " " + std::to_string(value) + "\n";
    };
    one("hits_total", "counter", "Renders answered from those kept on disk.", disk.hits);
    one("damaged_total", "counter", "Kept files that were not whole, or another's, and removed.",
        disk.damaged);
    one("evicted_total", "counter", "Kept files that gave way to others.", disk.evicted);
    one("failed_total", "counter", "Answers that could not be written.", disk.failed);
    one("skipped_total", "counter", "Answers that were not, since too many waited to be written.",
        disk.skipped);
    one("bytes", "gauge", "Of the files, as last counted.", disk.bytes);
    one("entries", "gauge", "Files, as last counted.", disk.entries);
}

void append_lanes(const Gauges& now, std::string& out) {
    append_head(out, "awan_lanes", "gauge",
                "Lanes, and how many are taken, by what computes in them.");
    const auto line = [&](const char* name, const char* labels, std::size_t value) {
        out += std::string(name) + "{" + labels + "} " + std::to_string(value) + "\n";
    };
    line("awan_lanes", "of=\"processor\"", now.lanes.lanes);
    line("awan_lanes", "of=\"renderer\"", now.device_lane.lanes);
    append_head(out, "awan_lanes_taken", "gauge", "Lanes that are taken.");
    line("awan_lanes_taken", "of=\"processor\"", now.lanes.running);
    line("awan_lanes_taken", "of=\"renderer\"", now.device_lane.running);
    append_head(out, "awan_waiting", "gauge", "Requests that wait for a lane, by forecast.");
    line("awan_waiting", "of=\"processor\",weight=\"short\"", now.lanes.waiting_short);
    line("awan_waiting", "of=\"processor\",weight=\"long\"", now.lanes.waiting_long);
    line("awan_waiting", "of=\"renderer\",weight=\"short\"", now.device_lane.waiting_short);
    line("awan_waiting", "of=\"renderer\",weight=\"long\"", now.device_lane.waiting_long);
}

}  // namespace

struct Metrics::State {
    mutable std::mutex mutex;
    // How many requests, by route and status.
    std::map<std::pair<std::string, int>, std::uint64_t> requests;
    // How long they took, by route; and how long stages took, by stage.
    std::map<std::string, Histogram, std::less<>> seconds;
    std::map<std::string, Histogram, std::less<>> stages;
    std::map<std::string, std::uint64_t, std::less<>> refused;
    std::uint64_t cache_hits = 0, cache_misses = 0;
};

Metrics::Metrics() : state_(std::make_unique<State>()) {}
Metrics::~Metrics() = default;

void Metrics::request_done(std::string_view route, int status, double seconds) {
    const std::lock_guard lock(state_->mutex);
    ++state_->requests[{std::string(route), status}];
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

void Metrics::cache_asked(bool hit) {
    const std::lock_guard lock(state_->mutex);
    ++(hit ? state_->cache_hits : state_->cache_misses);
}

std::string Metrics::text(const Gauges& now) const {
    std::string out;
    const auto one = [&](std::string_view name, std::string_view type, std::string_view help,
                         std::uint64_t value) {
        append_head(out, name, type, help);
        out.append(name).append(" ").append(std::to_string(value)).append("\n");
    };
    const std::lock_guard lock(state_->mutex);
    append_head(out, "awan_http_requests_total", "counter",
                "Answers by route and status; 499: the client had gone.");
    for (const auto& [key, count] : state_->requests)
        out += "awan_http_requests_total{route=\"" + key.first + "\",status=\"" +
               std::to_string(key.second) + "\"} " + std::to_string(count) + "\n";
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
    one("awan_in_progress", "gauge", "POSTs that are being answered or wait.", now.in_progress);
    append_lanes(now, out);
    one("awan_work_bytes", "gauge", "Memory that scenes at work have of their budget, estimated.",
        now.work_bytes);
    one("awan_work_bytes_limit", "gauge", "That budget.", now.work_bytes_most);
    one("awan_cache_hits_total", "counter", "Renders answered from those kept in memory.",
        state_->cache_hits);
    one("awan_cache_misses_total", "counter", "Renders that were not among those kept.",
        state_->cache_misses);
    one("awan_cache_bytes", "gauge", "Memory of the answers that are kept.", now.cache_bytes);
    one("awan_cache_entries", "gauge", "Answers that are kept.", now.cache_entries);
    append_disk_cache(now.disk, out);
    one("awan_jobs_waiting", "gauge", "Jobs that have not begun.", now.jobs_waiting);
    one("awan_jobs_running", "gauge", "Jobs that run.", now.jobs_running);
    one("awan_job_result_bytes", "gauge", "Results of jobs that are kept.", now.job_bytes);
    one("awan_ready", "gauge", "1 when /readyz says 200.", now.ready ? 1 : 0);
    one("awan_renderer", "gauge", "1 when the splat rungs can be drawn.", now.renderer ? 1 : 0);
    one("awan_renderer_reopened_total", "counter", "How often the renderer was opened again.",
        now.renderer_reopened);
    append_head(out, "awan_build_info", "gauge", "Always 1; the version is its label.");
    out += std::string("awan_build_info{version=\"") + engine_version() + "\"} 1\n";
    one("process_resident_memory_bytes", "gauge", "Resident memory size in bytes.",
        resident_bytes());
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
