// Splits independent work over threads. Which thread does which item never shows in the result.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>

namespace awan {

// Of what several threads throw, the first: carried to the one that waits for them.
class FirstThrow {
  public:
    // Whether something has been thrown.
    bool any() const { return any_.load(std::memory_order_relaxed); }

    // Calls work(), and keeps what it throws.
    template <typename Work>
    bool completes(const Work& work) noexcept {
        try {
            work();
            return true;
        } catch (...) {
            if (!any_.exchange(true)) what_ = std::current_exception();
            return false;
        }
    }

    // Throws it on, if there is any. Precondition: the threads have been joined.
    void throw_on() const {
        if (what_) std::rethrow_exception(what_);
    }

  private:
    std::atomic<bool> any_{false};
    std::exception_ptr what_;
};

// Calls work(what, i) once for every i in 0..count-1, on at most `threads` threads (the caller's is one of them); on
// fewer where the system has no more. Items must not touch each other's data. What work throws (memory may run out
// anywhere) is thrown here, the first of it, after all threads have ended; items that had not begun by then are left.
void run_in_parallel(int threads, std::size_t count, void (*work)(const void* what, std::size_t i),
                     const void* what);

// The same of anything that can be called as work(i).
template <typename Work>
void parallel_for(int threads, std::size_t count, const Work& work) {
    const auto call = [](const void* what, std::size_t i) { (*static_cast<const Work*>(what))(i); };
    run_in_parallel(threads, count, call, &work);
}

}  // namespace awan
