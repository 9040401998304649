#include "server/http/access_log.h"

#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>

#include "server/document/json_text.h"

namespace awan {
namespace {

// Lines that wait. At a thousand requests a second, those of four seconds.
constexpr std::size_t kLines = 4096;

// Bytes of a line. A pipe that says it takes some takes so many at once (POSIX: PIPE_BUF).
constexpr std::size_t kLongestLine = 4096;

// How long a line waits for whoever should take it.
constexpr int kLogPatience_ms = 1000;

// Of what a client sent, as much as says what it was.
std::string_view beginning(std::string_view text, std::size_t most) {
    return text.substr(0, most);
}

std::string time_text(double seconds) {
    const auto whole = static_cast<std::time_t>(seconds);
    std::tm utc{};
    gmtime_r(&whole, &utc);
    char date[32];
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &utc);
    char text[48];
    std::snprintf(text, sizeof text, "%s.%03dZ", date,
                  static_cast<int>(1000 * (seconds - std::floor(seconds))));
    return text;
}

// Thousandths are enough of milliseconds and seconds.
double rounded(double value) {
    return std::round(1000 * value) / 1000;
}

// A client must not begin a line of its own, nor write to a terminal.
std::string printable(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c <= ' ' || c == '"' || c > '~') c = '?';
    return out;
}

}  // namespace

std::string access_text(const AccessRecord& r) {
    std::string line = time_text(r.time) + " " + printable(beginning(r.client, 64)) + " " +
                       printable(beginning(r.id, 128)) + " " + printable(r.method) + " " +
                       printable(beginning(r.target, 256)) + " " + std::to_string(r.status) + " " +
                       std::to_string(r.bytes_in) + " " + std::to_string(r.bytes_out);
    char text[64];
    std::snprintf(text, sizeof text, " %.3fs", r.seconds);
    line += text;
    if (r.stages)
        for (const auto& [name, ms] : *r.stages) {
            std::snprintf(text, sizeof text, " %s=%.1fms", name, ms);
            line += text;
        }
    if (!r.reason.empty()) line.append(" (").append(r.reason).append(")");
    return line;
}

std::string access_json(const AccessRecord& r) {
    using namespace json_text;
    std::string line = "{";
    member("time", time_text(r.time), line);
    member("client", beginning(r.client, 64), line);
    member("id", beginning(r.id, 128), line);
    member("method", r.method, line);
    member("target", beginning(r.target, 256), line);
    member("route", r.route, line);
    member("status", r.status, line);
    member("bytes_in", static_cast<std::uint64_t>(r.bytes_in), line);
    member("bytes_out", static_cast<std::uint64_t>(r.bytes_out), line);
    member("seconds", rounded(r.seconds), line);
    name("stages", line);
    line += "{";
    if (r.stages)
        for (const auto& [stage, ms] : *r.stages) member(stage, rounded(ms), line);
    line += "}";
    member("reason", r.reason, line);
    return line + "}";
}

AccessLog::AccessLog(int fd, LogFormat format) : fd_(fd), format_(format) {
    if (format_ != LogFormat::kNone) thread_ = std::thread([this] { run(); });
}

AccessLog::~AccessLog() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

void AccessLog::add(const AccessRecord& record) noexcept {
    if (format_ == LogFormat::kNone) return;
    try {
        std::string line = format_ == LogFormat::kJson ? access_json(record) : access_text(record);
        const std::lock_guard lock(mutex_);
        if (lines_.size() < kLines && line.size() < kLongestLine) {
            lines_.push_back(std::move(line += "\n"));
            changed_.notify_one();
            return;
        }
        ++lost_;
    } catch (const std::exception&) {
        // Without memory for a line, it is one of those that are lost.
        const std::lock_guard lock(mutex_);
        ++lost_;
    }
}

bool AccessLog::write_whole(std::string_view line) {
    pollfd ready{fd_, POLLOUT, 0};
    if (poll(&ready, 1, kLogPatience_ms) <= 0 || !(ready.revents & POLLOUT)) return false;
    return ::write(fd_, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

void AccessLog::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return stopping_ || !lines_.empty(); });
        if (lines_.empty()) return;
        std::string line = std::move(lines_.front());
        lines_.pop_front();
        char lost[80] = "";
        if (lost_ > 0)
            std::snprintf(lost, sizeof lost,
                          format_ == LogFormat::kText ? "awan: %zu lines of the log were lost\n"
                                                      : "{\"lost_lines\":%zu}\n",
                          lost_);
        const std::size_t told = lost_;
        lock.unlock();
        const bool written = (!*lost || write_whole(lost)) && write_whole(line);
        lock.lock();
        if (written)
            lost_ -= told;
        else
            ++lost_;
        // Nobody reads it: the end must not wait for each line.
        if (!written && stopping_) return;
    }
}

}  // namespace awan
