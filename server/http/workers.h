// Threads that answer what may take long, behind a short queue.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace awan {

template <typename Job>
class Workers {
  public:
    // Each thread calls `make_worker` once and then what it gave for every job it takes.
    Workers(std::size_t threads, std::size_t queue_length,
            const std::function<std::function<void(Job)>()>& make_worker)
        : queue_length_(queue_length) {
        for (std::size_t i = 0; i < threads; ++i)
            threads_.emplace_back([this, make_worker] { run(make_worker()); });
    }
    // Finishes what is queued, then ends the threads.
    ~Workers() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
            changed_.notify_all();
        }
        for (std::thread& thread : threads_) thread.join();
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // False when the queue is full.
    bool push(Job job) {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= queue_length_) return false;
        queue_.push_back(job);
        changed_.notify_one();
        return true;
    }

  private:
    void run(const std::function<void(Job)>& work) {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
            if (queue_.empty()) return;
            Job job = queue_.front();
            queue_.pop_front();
            lock.unlock();
            work(job);
            lock.lock();
        }
    }

    const std::size_t queue_length_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> queue_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace awan
