// Threads that take many short steps of one work together, each its share, and wait for each other between them.
#pragma once

#include <atomic>
#include <barrier>
#include <cstddef>
#include <exception>

#include "core/base/parallel.h"

namespace awan {

class Team {
  public:
    explicit Team(std::size_t members)
        : size_(members), barrier_(static_cast<std::ptrdiff_t>(members)) {}

    std::size_t size() const { return size_; }
    // Until all members are here. Throws where one of them has left: without its share, nobody can go on.
    void wait() {
        if (size_ <= 1) return;
        barrier_.arrive_and_wait();
        if (one_left_.load(std::memory_order_relaxed)) throw MemberLeft();
    }
    // By a member that takes no further step: the others shall not wait for it.
    void leave() {
        one_left_.store(true, std::memory_order_relaxed);
        barrier_.arrive_and_drop();
    }
    struct Share {
        std::size_t begin, end;
    };
    // Of `count` items, one member's.
    Share share_of(std::size_t member, std::size_t count) const {
        return {count * member / size_, count * (member + 1) / size_};
    }

  private:
    struct MemberLeft : std::exception {};

    std::size_t size_;
    std::barrier<> barrier_;
    std::atomic<bool> one_left_{false};
};

// Calls work(what, member) once for each member, all at the same time: as many threads as the team has members. What
// the first member throws is thrown here, after all threads have ended; the others leave at their next step.
// Throws std::system_error or std::bad_alloc before anything has begun where the system has no such many threads.
void run_members(Team& team, void (*work)(const void* what, std::size_t member), const void* what);

// The same of anything that can be called as work(member).
template <typename Work>
void run_team(Team& team, const Work& work) {
    const auto call = [](const void* what, std::size_t member) {
        (*static_cast<const Work*>(what))(member);
    };
    run_members(team, call, &work);
}

// Of a member of two teams, its part in `inner`: where it throws, the others of that team shall not wait for it either.
template <typename Work>
void as_member(Team& inner, const Work& work) {
    try {
        work();
    } catch (...) {
        inner.leave();
        throw;
    }
}

}  // namespace awan
