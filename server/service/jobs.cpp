#include "server/service/jobs.h"

#include <algorithm>
#include <atomic>

#include "core/base/thrown.h"
#include "server/service/problem.h"

namespace awan {
namespace {

// After a job's request was told to come again.
constexpr std::chrono::milliseconds kComeAgain{250};

}  // namespace

std::string_view name_of(JobState state) {
    switch (state) {
        case JobState::kQueued:
            return "queued";
        case JobState::kRunning:
            return "running";
        case JobState::kDone:
            return "done";
        case JobState::kFailed:
            return "failed";
        case JobState::kCancelled:
            return "cancelled";
    }
    return "failed";
}

// All but `work` is guarded by the mutex of the Jobs.
struct Jobs::Job {
    JobWork work;
    Deadline::Clock::time_point came = Deadline::Clock::now();
    std::shared_ptr<std::atomic<bool>> cancelled = std::make_shared<std::atomic<bool>>(false);
    JobState state = JobState::kQueued;
    double progress = 0;
    std::uint64_t version = 0;
    std::shared_ptr<const Response> result;
};

Jobs::Jobs(JobsOptions options, Run run) : options_(options), run_(std::move(run)) {
    for (std::size_t i = 0; i < options_.runners; ++i) runners_.emplace_back([this] { serve(); });
}

Jobs::~Jobs() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        for (const auto& job : jobs_) *job->cancelled = true;
        changed_.notify_all();
    }
    for (std::thread& runner : runners_) runner.join();
}

std::list<std::shared_ptr<Jobs::Job>>::const_iterator Jobs::at(std::string_view id) const {
    return std::find_if(jobs_.begin(), jobs_.end(),
                        [&](const auto& job) { return job->work.id == id; });
}

JobView Jobs::view_of(const Job& job) const {
    return {job.state, job.progress, ms_since(job.came) / 1000, job.version, job.result};
}

bool Jobs::submit(JobWork work) {
    auto job = std::make_shared<Job>();
    job->work = std::move(work);
    const std::lock_guard lock(mutex_);
    std::size_t waiting = 0;
    std::size_t bytes = job->work.request.body.size();
    for (const auto& other : jobs_) {
        if (!view_of(*other).finished()) ++waiting;
        bytes += other->work.request.body.size();
    }
    if (waiting >= options_.most_waiting || (waiting > 0 && bytes > options_.bytes) || stopping_)
        return false;
    jobs_.push_back(std::move(job));
    drop_old();
    changed_.notify_all();
    return true;
}

std::optional<JobView> Jobs::view(std::string_view id) const {
    const std::lock_guard lock(mutex_);
    const auto found = at(id);
    if (found == jobs_.end()) return std::nullopt;
    return view_of(**found);
}

std::optional<JobWork> Jobs::work(std::string_view id) const {
    const std::lock_guard lock(mutex_);
    const auto found = at(id);
    if (found == jobs_.end()) return std::nullopt;
    // Without the scene, which may be long.
    const JobWork& work = (*found)->work;
    return JobWork{work.id, work.kind, work.format, {}, work.idempotency_key, work.digest};
}

std::optional<std::pair<std::string, std::string>> Jobs::with_key(std::string_view key) const {
    const std::lock_guard lock(mutex_);
    for (const auto& job : jobs_)
        if (job->work.idempotency_key == key) return std::pair(job->work.id, job->work.digest);
    return std::nullopt;
}

std::optional<JobView> Jobs::wait(std::string_view id, std::uint64_t version,
                                  std::chrono::milliseconds time) const {
    std::unique_lock lock(mutex_);
    const auto until = Deadline::Clock::now() + time;
    for (;;) {
        const auto found = at(id);
        if (found == jobs_.end()) return std::nullopt;
        if ((*found)->version != version || stopping_ || Deadline::Clock::now() >= until)
            return view_of(**found);
        changed_.wait_until(lock, until);
    }
}

bool Jobs::remove(std::string_view id) {
    const std::lock_guard lock(mutex_);
    const auto found = at(id);
    if (found == jobs_.end()) return false;
    Job& job = **found;
    if (view_of(job).finished()) {
        if (job.result) bytes_ -= job.result->bytes().size();
        jobs_.erase(found);
    } else {
        *job.cancelled = true;
        // What runs ends at its next look.
        if (job.state == JobState::kQueued) job.state = JobState::kCancelled;
        ++job.version;
    }
    changed_.notify_all();
    return true;
}

Jobs::Load Jobs::load() const {
    const std::lock_guard lock(mutex_);
    Load load;
    load.bytes = bytes_;
    load.kept = jobs_.size();
    for (const auto& job : jobs_) {
        if (job->state == JobState::kQueued) ++load.waiting;
        if (job->state == JobState::kRunning) ++load.running;
    }
    return load;
}

// The oldest that have finished, until the rest is within bounds.
void Jobs::drop_old() {
    for (auto job = jobs_.begin();
         job != jobs_.end() && (bytes_ > options_.bytes || jobs_.size() > options_.most);) {
        if (!view_of(**job).finished()) {
            ++job;
            continue;
        }
        if ((*job)->result) bytes_ -= (*job)->result->bytes().size();
        job = jobs_.erase(job);
    }
}

void Jobs::finish(Job& job, Response response) {
    // Errors are small, and written anew for whoever asks.
    if (response.status == 200) response.share();
    auto result = std::make_shared<const Response>(std::move(response));
    const std::lock_guard lock(mutex_);
    job.state = *job.cancelled          ? JobState::kCancelled
                : result->status == 200 ? JobState::kDone
                                        : JobState::kFailed;
    // The scene is of no more use.
    job.work.request.body = {};
    if (job.state == JobState::kDone) job.progress = 1;
    if (job.state != JobState::kCancelled) {
        bytes_ += result->bytes().size();
        job.result = std::move(result);
    }
    ++job.version;
    drop_old();
    changed_.notify_all();
}

Response Jobs::run(const Job& job, Request& request) {
    for (;;) {
        Response response;
        try {
            response = run_(job.work, request);
        } catch (const std::exception& e) {
            response = problem(error_of_thrown(e), request.id);
        }
        // The lines are full at the moment; a job has time.
        if (response.status != 429 || has_passed(request.deadline)) return response;
        std::this_thread::sleep_for(kComeAgain);
    }
}

void Jobs::serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
        std::shared_ptr<Job> job;
        for (const auto& other : jobs_)
            if (!job && other->state == JobState::kQueued) job = other;
        if (stopping_) return;
        if (!job) {
            changed_.wait(lock);
            continue;
        }
        job->state = JobState::kRunning;
        ++job->version;
        changed_.notify_all();
        lock.unlock();

        try {
            Request request = job->work.request;
            request.deadline = {Deadline::Clock::now() + options_.deadline, job->cancelled};
            request.admitted = true;
            request.progress = [&](double done) {
                const std::lock_guard in(mutex_);
                // A thousand changes are enough for whoever watches.
                if (!(done >= job->progress + 0.001)) return;
                job->progress = std::min(done, 1.0);
                ++job->version;
                changed_.notify_all();
            };
            finish(*job, run(*job, request));
        } catch (const std::exception&) {
            // No memory for what came of it, nor for the words of an error.
            const std::lock_guard in(mutex_);
            job->state = JobState::kFailed;
            ++job->version;
            changed_.notify_all();
        }
        lock.lock();
    }
}

}  // namespace awan
