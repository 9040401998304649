// Who computes when. So many pieces of work compute at once, the others wait in line; a lane is kept for short work,
// and clients take turns.
//
// Short work (by forecast) may take any lane, long work all but those that are kept for short work: a preview never
// waits for a picture of half a minute. Short work that turns out to be long gives up its claim to such a lane and runs
// on beside it. Among those that wait in one line the order is that of start-time fair queueing (Goyal et al. 1996):
// each client has a clock that its work moves on by what it is expected to take, and the one whose clock is furthest
// back comes next. So a client with a hundred requests does not stand before one with one.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/deadline.h"

namespace awan {

enum class Weight { kShort, kLong };
inline constexpr std::size_t kWeights = 2;

// What is expected to take at most this is short: a preview.
inline constexpr double kShort_ms = 1000;
// Of how long a piece of work takes before anything is known of it.
inline constexpr double kTypical_ms = 50;

// Whether a deadline is over, said without memory, which may have run out: a word of it may not be had then.
inline bool has_passed(const Deadline& deadline) noexcept {
    return (deadline.cancelled && deadline.cancelled->load(std::memory_order_relaxed)) ||
           (deadline.until != Deadline::Clock::time_point::max() &&
            Deadline::Clock::now() >= deadline.until);
}

inline Weight weight_of(double expected_ms) {
    return expected_ms <= kShort_ms ? Weight::kShort : Weight::kLong;
}

struct LanesOptions {
    // That compute at once, >= 1.
    std::size_t lanes = 2;
    // Of these, kept for short work; < lanes.
    std::size_t for_short = 1;
    // That wait, of each weight.
    std::size_t line = 16;
    // Short work that has taken so long stands in no other's way any more.
    std::chrono::milliseconds patience{2 * static_cast<int>(kShort_ms)};
};

// A piece of work, as far as it is known when it comes.
struct LaneWork {
    Weight weight = Weight::kShort;
    double expected_ms = kTypical_ms;
    // Whose it is: the client's address.
    std::string client;
};

// How long a job waits before it asks for a lane, or memory, again.
inline constexpr std::chrono::milliseconds kLinesAreFull{100};

// Thread-safe.
class Lanes {
    struct Runner {
        Weight weight;
        double expected_ms;
        Deadline::Clock::time_point since;
        Deadline::Clock::time_point until;
    };
    struct Waiter {
        const LaneWork* work;
        Weight weight;
        // When it is due by its client's clock.
        double start;
        // One element, made before it waits: who lets it in must not run out of memory.
        std::list<Runner> seat;
        std::optional<std::list<Runner>::iterator> granted;
        std::condition_variable let_in;
    };

  public:
    explicit Lanes(LanesOptions options);
    Lanes(const Lanes&) = delete;
    Lanes& operator=(const Lanes&) = delete;

    enum class Entry {
        // It computes now.
        kIn,
        // So many wait already.
        kFull,
        // By what runs and waits before it, its turn would come after its deadline.
        kTooLate,
        // While it waited, its deadline passed or its client went.
        kOver,
    };

    // One thread's pass; leave() may come before the end of the scope. Must not outlive the Lanes.
    class Pass {
      public:
        explicit Pass(Lanes& lanes) : lanes_(lanes) {}
        ~Pass() { leave(); }
        Pass(const Pass&) = delete;
        Pass& operator=(const Pass&) = delete;

        // Waits for a lane. Precondition: not inside.
        Entry enter(const LaneWork& work, const Deadline& deadline);
        // More is known now of the work that computes: what it is still expected to take. Work that is long after all
        // may have to wait for another lane; then it has left its own, and is inside again when kIn is said.
        Entry expect(double ms, const Deadline& deadline);
        void leave();
        // How long was waited in line, all in all.
        double waited_ms() const { return waited_ms_; }

      private:
        Lanes& lanes_;
        LaneWork work_;
        std::optional<std::list<Runner>::iterator> runner_;
        double waited_ms_ = 0;
    };

    // How long a piece of work that came now would wait, ms: from what runs and what waits.
    double wait_ms(Weight weight) const;
    // In how many ms the first piece of work of this weight that computes is expected to end; 0: none does.
    double next_end_ms(Weight weight) const;

    struct Load {
        std::size_t lanes, running, waiting_short, waiting_long;
        // A piece of short work that came now would be refused.
        bool full;
    };
    Load load() const;

  private:
    using Lock = std::unique_lock<std::mutex>;

    Entry enter(const LaneWork& work, const Deadline& deadline, bool may_be_full,
                std::optional<std::list<Runner>::iterator>& runner, double& waited_ms);
    void let_in() noexcept;
    bool is_room(Weight weight) const;
    // Running: short work in time, and the rest.
    std::pair<std::size_t, std::size_t> running() const;
    std::list<Waiter*>::iterator next_of(Weight weight);
    double wait_ms(Weight weight, double start) const;
    double start_of(const LaneWork& work) const;

    const LanesOptions options_;
    mutable std::mutex mutex_;
    std::list<Runner> runners_;
    std::list<Waiter*> lines_[kWeights];
    // By weight: the clients' clocks, and that of the lane, ms of work. A client's that is not ahead of it is dropped.
    std::map<std::string, double> clocks_[kWeights];
    double clock_[kWeights] = {0, 0};
    // Short work that came before long work that waits.
    std::size_t passed_over_ = 0;
};

}  // namespace awan
