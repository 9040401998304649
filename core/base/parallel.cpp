#include "core/base/parallel.h"

#include <atomic>
#include <thread>
#include <vector>

#include "core/base/team.h"

namespace awan {

void run_in_parallel(int threads, std::size_t count, void (*work)(const void* what, std::size_t i),
                     const void* what) {
    std::atomic<std::size_t> next{0};
    FirstThrow thrown;
    const auto run = [&] {
        thrown.completes([&] {
            for (std::size_t i = next++; i < count && !thrown.any(); i = next++) work(what, i);
        });
    };
    {
        std::vector<std::jthread> helpers;
        // Without memory or threads for helpers, those that are here do it all.
        try {
            for (std::size_t t = 1; t < static_cast<std::size_t>(threads) && t < count; ++t)
                helpers.emplace_back(run);
        } catch (const std::exception&) {
        }
        run();
    }
    thrown.throw_on();
}

void run_members(Team& team, void (*work)(const void* what, std::size_t member), const void* what) {
    FirstThrow thrown;
    const auto run = [&](std::size_t member) {
        if (!thrown.completes([&] { work(what, member); })) team.leave();
    };
    // Members wait for each other, so none begins before there is a thread for every one.
    enum Start { kNotYet, kGo, kNever };
    std::atomic<int> start{kNotYet};
    const auto all = [&](Start what_now) {
        start = what_now;
        start.notify_all();
    };
    {
        std::vector<std::jthread> others;
        try {
            for (std::size_t member = 1; member < team.size(); ++member)
                others.emplace_back([&, member] {
                    start.wait(kNotYet);
                    if (start == kGo) run(member);
                });
        } catch (...) {
            all(kNever);
            throw;
        }
        all(kGo);
        run(0);
    }
    thrown.throw_on();
}

}  // namespace awan
