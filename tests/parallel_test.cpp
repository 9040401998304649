// Threads that share work: what one of them throws is carried to the caller, and nobody waits for ever.
#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <vector>

#include "core/base/team.h"

namespace awan::test {
namespace {

TEST(ParallelFor, DoesEveryItemOnce) {
    for (const int threads : {1, 2, 7}) {
        std::vector<int> done(1000);
        parallel_for(threads, done.size(), [&](std::size_t i) { ++done[i]; });
        EXPECT_EQ(done, std::vector<int>(1000, 1)) << threads;
    }
}

TEST(ParallelFor, ThrowsWhatAnItemThrows) {
    for (const int threads : {1, 2, 7}) {
        std::atomic<int> begun{0};
        const auto run = [&] {
            parallel_for(threads, 100'000, [&](std::size_t i) {
                ++begun;
                if (i == 10) throw std::bad_alloc();
            });
        };
        EXPECT_THROW(run(), std::bad_alloc) << threads;
        EXPECT_GE(begun, 11);
    }
}

TEST(ParallelFor, OneOfSeveralThatAreThrownIsThrown) {
    const auto run = [] {
        parallel_for(7, 7, [](std::size_t i) { throw std::runtime_error(std::to_string(i)); });
    };
    EXPECT_THROW(run(), std::runtime_error);
}

// Whichever member throws, at whichever step: the others end too, and the first that was thrown comes out, not that
// the others met a team without it.
TEST(Team, ThrowsWhatAMemberThrows) {
    constexpr std::size_t kMembers = 4;
    constexpr int kSteps = 5;
    for (std::size_t thrower = 0; thrower < kMembers; ++thrower)
        for (int at = 0; at < kSteps; ++at) {
            Team team(kMembers);
            std::atomic<int> last{0};
            const auto run = [&] {
                run_team(team, [&](std::size_t member) {
                    for (int step = 0; step < kSteps; ++step) {
                        if (member == thrower && step == at) throw std::bad_alloc();
                        team.wait();
                        if (step + 1 == kSteps) ++last;
                    }
                });
            };
            EXPECT_THROW(run(), std::bad_alloc) << thrower << " at " << at;
            EXPECT_EQ(last, 0) << "nobody goes on without a member";
        }
}

TEST(Team, OfTwoTeamsNobodyWaitsForAMemberThatThrew) {
    for (std::size_t thrower = 0; thrower < 4; ++thrower)
        for (int at = 0; at < 3; ++at) {
            Team all(4);
            std::array<Team, 2> halves{Team(2), Team(2)};
            const auto run = [&] {
                run_team(all, [&](std::size_t member) {
                    Team& half = halves[member / 2];
                    as_member(half, [&] {
                        for (int step = 0; step < 3; ++step) {
                            if (member == thrower && step == at) throw std::bad_alloc();
                            for (int i = 0; i < 50; ++i) half.wait();
                            all.wait();
                        }
                    });
                });
            };
            EXPECT_THROW(run(), std::bad_alloc) << thrower << " at " << at;
        }
}

}  // namespace
}  // namespace awan::test
