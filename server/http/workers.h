// Threads that answer what may take long, behind a short queue.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace awan {

template <typename Job>
class Workers {
  public:
    // `make_worker` is called once a thread, and what it gave for every job that the thread takes; that must not throw.
    // Where the system has not so many threads there are fewer; throws std::system_error where it has none.
    Workers(std::size_t threads, std::size_t queue_length,
            const std::function<std::function<void(Job)>()>& make_worker)
        : queue_length_(queue_length) {
        try {
            threads_.reserve(threads);
            for (std::size_t i = 0; i < threads; ++i)
                threads_.emplace_back([this, worker = make_worker()] { run(worker); });
        } catch (const std::exception&) {
            if (threads_.empty()) throw;
        }
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

    // False when the queue is full, or there is no memory for it.
    bool push(Job job) noexcept {
        try {
            const std::lock_guard lock(mutex_);
            if (queue_.size() >= queue_length_) return false;
            queue_.push_back(job);
            changed_.notify_one();
            return true;
        } catch (const std::exception&) {
            return false;
        }
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
