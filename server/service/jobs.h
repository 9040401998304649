// Work that is asked for now and fetched later: what runs, how far it has come, what came of it. Bounded: in number, in
// bytes, and in time.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/flight_path.h"
#include "core/impostor.h"
#include "core/plan/impostor_runs.h"
#include "server/service/service.h"

namespace awan {

enum class JobState { kQueued, kRunning, kDone, kFailed, kCancelled };
std::string_view name_of(JobState state);

// What a job is to do. Never changes.
struct JobWork {
    std::string id, kind;
    // The result's, of a sequence or a flight.
    std::string format;
    // Of the answer that is its result: its path, headers and body; deadline and progress are the job's.
    Request request;
    // The client's, with a digest of what came with it; "": none.
    std::string idempotency_key, digest;
    // Of a flight.
    FlightWish flight{};
    FlightImpostorWish flight_impostors{};
    ImpostorWish impostor{};
};

struct JobView {
    JobState state = JobState::kQueued;
    double progress = 0;
    double age_seconds = 0;
    // Rises with every change.
    std::uint64_t version = 0;
    // Once it has finished.
    std::shared_ptr<const Response> result;

    bool finished() const { return state != JobState::kQueued && state != JobState::kRunning; }
};

struct JobsOptions {
    // Jobs that run at once; each takes lanes as any request.
    std::size_t runners = 2;
    // That have not finished.
    std::size_t most_waiting = limits::kWaitingJobs;
    // Bytes of results that are kept, the oldest are dropped; and of the scenes of those that have not finished.
    std::size_t bytes = limits::kJobBytes;
    // That are kept, finished ones among them.
    std::size_t most = limits::kMostJobs;
    // Of one job, from when it begins.
    std::chrono::milliseconds deadline = limits::kJobDeadline;
};

// Thread-safe.
class Jobs {
    struct Job;

  public:
    using Run = std::function<Response(const JobWork& work, const Request& request)>;

    // `run` answers a job's request on a thread of its own; what it throws is the end of that job only.
    Jobs(JobsOptions options, Run run);
    // Cancels all, and waits until they have ended.
    ~Jobs();
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    // False: so many, or so much, waits already.
    bool submit(JobWork work);
    std::optional<JobView> view(std::string_view id) const;
    std::optional<JobWork> work(std::string_view id) const;
    // The id of the job that came with this key, and its digest.
    std::optional<std::pair<std::string, std::string>> with_key(std::string_view key) const;
    // Waits until its version differs, or so long. Nothing: there is none.
    std::optional<JobView> wait(std::string_view id, std::uint64_t version,
                                std::chrono::milliseconds time) const;
    // Cancels what has not finished, and drops what has. False: there is none.
    bool remove(std::string_view id);

    struct Load {
        std::size_t waiting = 0, running = 0, kept = 0, bytes = 0;
    };
    Load load() const;

  private:
    void serve();
    Response run(const Job& job, Request& request);
    void finish(Job& job, Response response);
    void drop_old();
    std::list<std::shared_ptr<Job>>::const_iterator at(std::string_view id) const;
    JobView view_of(const Job& job) const;

    const JobsOptions options_;
    const Run run_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    // In the order in which they came.
    std::list<std::shared_ptr<Job>> jobs_;
    std::size_t bytes_ = 0;
    bool stopping_ = false;
    std::vector<std::thread> runners_;
};

}  // namespace awan
