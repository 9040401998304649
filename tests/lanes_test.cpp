// Who computes when: lanes for short and long work, turns, waits that are foretold.
#include "server/service/lanes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "fake_renderer.h"

namespace awan::test {
namespace {

using namespace std::chrono_literals;
using Entry = Lanes::Entry;

const LaneWork kPreview{Weight::kShort, 50, "a"};
const LaneWork kPicture{Weight::kLong, 20'000, "a"};

Deadline within(std::chrono::milliseconds time) {
    return {Deadline::Clock::now() + time, nullptr};
}

// Work that enters on a thread of its own and stays, in its lane or in line, until it is told to go.
class Guest {
  public:
    Guest(Lanes& lanes, LaneWork work, Deadline deadline = {})
        : gone_(std::make_shared<std::atomic<bool>>(false)),
          thread_([this, &lanes, work = std::move(work), deadline]() mutable {
              Lanes::Pass pass(lanes);
              if (!deadline.cancelled) deadline.cancelled = gone_;
              entry = pass.enter(work, deadline);
              answered = true;
              while (!go_) std::this_thread::sleep_for(1ms);
          }) {}
    ~Guest() { leave(); }
    void leave() {
        go_ = true;
        *gone_ = true;
        if (thread_.joinable()) thread_.join();
    }
    bool inside() const { return answered && entry == Entry::kIn; }

    std::atomic<Entry> entry{Entry::kOver};
    std::atomic<bool> answered{false};

  private:
    std::atomic<bool> go_{false};
    std::shared_ptr<std::atomic<bool>> gone_;
    std::thread thread_;
};

std::unique_ptr<Guest> guest(Lanes& lanes, const LaneWork& work) {
    const Lanes::Load before = lanes.load();
    auto entered = std::make_unique<Guest>(lanes, work);
    EXPECT_TRUE(eventually([&] {
        const Lanes::Load now = lanes.load();
        return now.running + now.waiting_short + now.waiting_long >
                   before.running + before.waiting_short + before.waiting_long ||
               entered->answered;
    }));
    return entered;
}

TEST(Lanes, LongWorkNeverTakesTheLaneOfShortWork) {
    Lanes lanes({3, 1, 16});
    std::vector<std::unique_ptr<Guest>> pictures;
    for (int i = 0; i < 4; ++i) pictures.push_back(guest(lanes, kPicture));
    EXPECT_EQ(lanes.load().running, 2u);
    EXPECT_EQ(lanes.load().waiting_long, 2u);
    Lanes::Pass preview(lanes);
    EXPECT_EQ(preview.enter(kPreview, within(5s)), Entry::kIn);
    EXPECT_LT(preview.waited_ms(), 1000);
}

TEST(Lanes, ShortWorkTakesAnyLaneAndLongWorkIsNotPassedOverForEver) {
    Lanes lanes({2, 1, 16});
    auto first = guest(lanes, kPreview);
    auto second = guest(lanes, kPreview);
    EXPECT_EQ(lanes.load().running, 2u);
    auto third = guest(lanes, kPreview);
    auto picture = guest(lanes, kPicture);
    EXPECT_FALSE(third->inside());
    first->leave();
    EXPECT_TRUE(eventually([&] { return picture->inside(); })) << "its lane is free";
    EXPECT_FALSE(third->inside());
    second->leave();
    EXPECT_TRUE(eventually([&] { return third->inside(); }));
}

TEST(Lanes, OneLaneOfBothServesShortWorkFirst) {
    Lanes lanes({1, 0, 16});
    auto running = guest(lanes, kPicture);
    auto picture = guest(lanes, kPicture);
    auto preview = guest(lanes, kPreview);
    running->leave();
    EXPECT_TRUE(eventually([&] { return preview->inside(); }));
    EXPECT_FALSE(picture->inside());
    preview->leave();
    EXPECT_TRUE(eventually([&] { return picture->inside(); }));
}

TEST(Lanes, WhatTurnsOutLongWaitsForALaneOfLongWork) {
    Lanes lanes({2, 1, 16});
    auto picture = guest(lanes, kPicture);
    Lanes::Pass pass(lanes);
    ASSERT_EQ(pass.enter(kPreview, within(5s)), Entry::kIn);
    EXPECT_EQ(pass.expect(100, within(5s)), Entry::kIn) << "it is short still";
    EXPECT_EQ(lanes.load().running, 2u);
    EXPECT_EQ(pass.expect(5000, within(100ms)), Entry::kTooLate) << "20 s are before it";
    EXPECT_EQ(lanes.load().running, 1u) << "it has left";
    Lanes::Pass other(lanes);
    ASSERT_EQ(other.enter(kPreview, within(5s)), Entry::kIn);
    std::thread soon([&] {
        std::this_thread::sleep_for(50ms);
        picture->leave();
    });
    EXPECT_EQ(other.expect(5000, Deadline{}), Entry::kIn);
    soon.join();
}

TEST(Lanes, ShortWorkThatOverstaysStandsInNobodysWay) {
    Lanes lanes({2, 1, 16, 100ms});
    auto picture = guest(lanes, kPicture);
    auto overstays = guest(lanes, kPreview);
    EXPECT_EQ(lanes.load().running, 2u);
    Lanes::Pass preview(lanes);
    EXPECT_EQ(preview.enter(kPreview, within(10s)), Entry::kIn);
    EXPECT_GT(preview.waited_ms(), 20);
    auto another = guest(lanes, kPreview);
    EXPECT_TRUE(eventually([&] { return another->inside(); }));
    auto fifth = guest(lanes, kPreview);
    std::this_thread::sleep_for(300ms);
    EXPECT_FALSE(fifth->inside()) << "but not without end: each holds memory";
}

TEST(Lanes, ClientsTakeTurns) {
    Lanes lanes({2, 1, 16});
    auto running = guest(lanes, kPicture);
    std::vector<std::unique_ptr<Guest>> many;
    for (int i = 0; i < 3; ++i) many.push_back(guest(lanes, {Weight::kLong, 5000, "many"}));
    auto one = guest(lanes, {Weight::kLong, 5000, "one"});
    running->leave();
    EXPECT_TRUE(eventually([&] { return many[0]->inside() || one->inside(); }));
    (many[0]->inside() ? many[0] : one)->leave();
    EXPECT_TRUE(eventually([&] { return one->inside() || many[0]->inside(); }));
    EXPECT_FALSE(many[1]->inside()) << "the other client's turn comes before its second";
    EXPECT_FALSE(many[2]->inside());
}

TEST(Lanes, OneClientCannotFillALine) {
    Lanes lanes({2, 1, 4});
    std::vector<std::unique_ptr<Guest>> many;
    for (int i = 0; i < 5; ++i) many.push_back(guest(lanes, kPicture));
    EXPECT_EQ(lanes.load().waiting_long, 3u);
    EXPECT_TRUE(eventually([&] { return many.back()->answered.load(); }));
    EXPECT_EQ(many.back()->entry, Entry::kFull);
    auto other = guest(lanes, {Weight::kLong, 1000, "b"});
    EXPECT_EQ(lanes.load().waiting_long, 4u);
    EXPECT_FALSE(other->answered);
    Lanes::Pass last(lanes);
    EXPECT_EQ(last.enter({Weight::kLong, 1000, "c"}, within(1h)), Entry::kFull);
}

TEST(Lanes, WaitsAreForetoldFromWhatRunsAndWaits) {
    Lanes lanes({2, 1, 16});
    EXPECT_EQ(lanes.wait_ms(Weight::kLong), 0);
    auto running = guest(lanes, kPicture);
    EXPECT_NEAR(lanes.wait_ms(Weight::kLong), 20'000, 1000);
    EXPECT_EQ(lanes.wait_ms(Weight::kShort), 0);
    EXPECT_NEAR(lanes.next_end_ms(Weight::kLong), 20'000, 1000);
    EXPECT_EQ(lanes.next_end_ms(Weight::kShort), 0);
    auto waiting = guest(lanes, {Weight::kLong, 7000, "b"});
    EXPECT_NEAR(lanes.next_end_ms(Weight::kLong), 20'000, 1000);
    EXPECT_NEAR(lanes.wait_ms(Weight::kLong), 27'000, 1000);
    Lanes::Pass pass(lanes);
    EXPECT_EQ(pass.enter(kPicture, within(10s)), Entry::kTooLate) << "refused at once";
    EXPECT_EQ(lanes.load().waiting_long, 1u);
}

TEST(Lanes, WhoseDeadlinePassesOrWhoGoesLeavesTheLine) {
    Lanes lanes({1, 0, 16});
    auto running = guest(lanes, kPreview);
    const auto gone = std::make_shared<std::atomic<bool>>(false);
    Guest goes(lanes, kPreview, {Deadline::Clock::time_point::max(), gone});
    Guest late(lanes, kPreview, within(300ms));
    EXPECT_TRUE(eventually([&] { return lanes.load().waiting_short >= 1; }));
    *gone = true;
    EXPECT_TRUE(eventually([&] { return goes.answered && late.answered; }));
    EXPECT_EQ(goes.entry, Entry::kOver);
    EXPECT_EQ(late.entry, Entry::kOver);
    EXPECT_EQ(lanes.load().waiting_short, 0u);
}

}  // namespace
}  // namespace awan::test
