// One line for every answer, as text or as JSON, written by a thread of its own: whoever reads them slowly, or not at
// all, holds up nobody.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace awan {

// What there is to say of an answer.
struct AccessRecord {
    // Wall clock, seconds since 1970.
    double time = 0;
    std::string_view client, id, method;
    // As the client sent it; the route's pattern.
    std::string_view target, route;
    int status = 0;
    std::size_t bytes_in = 0;
    // Without the head; 0 of a streamed answer.
    std::size_t bytes_out = 0;
    // From the request being whole to the answer being ready.
    double seconds = 0;
    // By name, ms.
    const std::vector<std::pair<const char*, double>>* stages = nullptr;
    // Why there is no other answer: "client gone", "deadline", "hopeless", "queue full", ... or "".
    std::string_view reason;
};

enum class LogFormat { kNone, kText, kJson };

std::string access_text(const AccessRecord& record);
// An object in one line, with these names: time, client, id, method, target, route, status, bytes_in, bytes_out,
// seconds, stages, reason.
std::string access_json(const AccessRecord& record);

// Thread-safe.
class AccessLog {
  public:
    // fd: where lines go; it stays open.
    AccessLog(int fd, LogFormat format);
    // Writes what can be written without waiting long.
    ~AccessLog();
    AccessLog(const AccessLog&) = delete;
    AccessLog& operator=(const AccessLog&) = delete;

    // Never waits; lines that nobody takes in time are lost, and their number is said later.
    void add(const AccessRecord& record) noexcept;

  private:
    void run();
    bool write_whole(std::string_view line);

    const int fd_;
    const LogFormat format_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> lines_;
    std::size_t lost_ = 0;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace awan
