#include "server/service/lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace awan {
namespace {

using Clock = Deadline::Clock;

// How often those that wait look whether their client has gone.
constexpr std::chrono::milliseconds kLookInLine{20};

// Where one lane serves both weights, so many pieces of short work may come before a long one.
constexpr std::size_t kPassedOver = 8;

// What takes longer than it was expected to takes, on the whole, a good part of it once more.
constexpr double kOverdue = 0.25;

std::size_t index_of(Weight weight) {
    return static_cast<std::size_t>(weight);
}

double ms_until(Clock::time_point until, Clock::time_point now) {
    return std::chrono::duration<double, std::milli>(until - now).count();
}

// How long work goes on that was expected to take so long when it began, and ends at its deadline in any case.
double left_ms(double expected_ms, Clock::time_point since, Clock::time_point until) {
    const double elapsed = ms_since(since);
    const double left = std::max(expected_ms - elapsed, kOverdue * elapsed);
    return std::clamp(left, 0.0, std::max(ms_until(until, Clock::now()), 0.0));
}

}  // namespace

Lanes::Lanes(LanesOptions options) : options_(options) {}

std::pair<std::size_t, std::size_t> Lanes::running() const {
    const auto now = Clock::now();
    std::size_t in_time = 0;
    for (const Runner& runner : runners_)
        if (runner.weight == Weight::kShort && now - runner.since <= options_.patience) ++in_time;
    return {in_time, runners_.size() - in_time};
}

// What overstays runs beside the lanes, but no more than once over: each holds memory.
bool Lanes::is_room(Weight weight) const {
    const auto [in_time, others] = running();
    const std::size_t for_long = options_.lanes - options_.for_short;
    if (weight == Weight::kLong && others >= for_long) return false;
    return in_time + std::min(others, for_long) < options_.lanes &&
           runners_.size() < 2 * options_.lanes;
}

std::list<Lanes::Waiter*>::iterator Lanes::next_of(Weight weight) {
    auto& line = lines_[index_of(weight)];
    return std::min_element(line.begin(), line.end(),
                            [](const Waiter* a, const Waiter* b) { return a->start < b->start; });
}

// Called whenever something has changed, and now and then: a lane also becomes free by time.
void Lanes::let_in() noexcept {
    for (;;) {
        const auto can = [&](Weight weight) {
            return !lines_[index_of(weight)].empty() && is_room(weight);
        };
        const bool can_long = can(Weight::kLong);
        const std::size_t in_time = running().first;
        Weight weight = Weight::kShort;
        if (can_long &&
            (!can(Weight::kShort) || in_time >= std::max<std::size_t>(options_.for_short, 1) ||
             passed_over_ >= kPassedOver))
            weight = Weight::kLong;
        else if (!can(Weight::kShort))
            return;
        passed_over_ = weight == Weight::kShort && can_long ? passed_over_ + 1 : 0;
        const auto chosen = next_of(weight);
        Waiter& waiter = **chosen;
        lines_[index_of(weight)].erase(chosen);
        double& clock = clock_[index_of(weight)];
        clock = std::max(clock, waiter.start);
        auto& clocks = clocks_[index_of(weight)];
        std::erase_if(clocks, [&](const auto& client) { return client.second <= clock; });
        waiter.seat.front().since = Clock::now();
        runners_.splice(runners_.begin(), waiter.seat);
        waiter.granted = runners_.begin();
        waiter.let_in.notify_one();
    }
}

double Lanes::start_of(const LaneWork& work) const {
    const std::size_t w = index_of(work.weight);
    const auto own = clocks_[w].find(work.client);
    return own == clocks_[w].end() ? clock_[w] : std::max(own->second, clock_[w]);
}

// The lanes that it may take become free one by one; who waits before it takes each as it does.
double Lanes::wait_ms(Weight weight, double start) const {
    const std::size_t lanes =
        weight == Weight::kShort ? options_.lanes : options_.lanes - options_.for_short;
    if (is_room(weight) && lines_[index_of(weight)].empty()) return 0;
    std::vector<double> free_at;
    for (const Runner& runner : runners_) {
        if (weight == Weight::kLong && runner.weight == Weight::kShort) continue;
        free_at.push_back(left_ms(runner.expected_ms, runner.since, runner.until));
    }
    std::sort(free_at.begin(), free_at.end());
    // Of what overstays, what ends last stands in nobody's way.
    free_at.resize(std::max<std::size_t>(lanes, 1), 0.0);
    for (const Waiter* other : lines_[index_of(weight)])
        if (other->start <= start)
            *std::min_element(free_at.begin(), free_at.end()) += other->work->expected_ms;
    return *std::min_element(free_at.begin(), free_at.end());
}

double Lanes::wait_ms(Weight weight) const {
    const std::lock_guard lock(mutex_);
    return wait_ms(weight, std::numeric_limits<double>::infinity());
}

double Lanes::next_end_ms(Weight weight) const {
    const std::lock_guard lock(mutex_);
    double least = std::numeric_limits<double>::infinity();
    for (const Runner& runner : runners_)
        if (runner.weight == weight)
            least = std::min(least, left_ms(runner.expected_ms, runner.since, runner.until));
    return std::isfinite(least) ? least : 0;
}

Lanes::Entry Lanes::enter(const LaneWork& work, const Deadline& deadline, bool may_be_full,
                          std::optional<std::list<Runner>::iterator>& runner, double& waited_ms) {
    if (has_passed(deadline)) return Entry::kOver;
    const auto began = Clock::now();
    Lock lock(mutex_);
    auto& line = lines_[index_of(work.weight)];
    // One client never takes the last quarter of a line: others shall find it open.
    const auto own =
        static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [&](const Waiter* other) {
            return other->work->client == work.client;
        }));
    const std::size_t share = options_.line - options_.line / 4;
    const bool room = line.empty() && is_room(work.weight);
    if (!may_be_full && !room && (line.size() >= options_.line || own >= share))
        return Entry::kFull;
    Waiter waiter{&work, work.weight, start_of(work), {}, {}, {}};
    waiter.seat.push_back({work.weight, work.expected_ms, began, deadline.until});
    if (!room && deadline.until != Clock::time_point::max() &&
        wait_ms(work.weight, waiter.start) >= ms_until(deadline.until, began))
        return Entry::kTooLate;
    clocks_[index_of(work.weight)][work.client] = waiter.start + std::max(work.expected_ms, 1.0);
    line.push_back(&waiter);
    let_in();
    while (!waiter.granted) {
        waiter.let_in.wait_for(lock, kLookInLine);
        if (waiter.granted) break;
        if (has_passed(deadline)) {
            line.remove(&waiter);
            waited_ms += ms_since(began);
            return Entry::kOver;
        }
        let_in();
    }
    runner = waiter.granted;
    waited_ms += ms_since(began);
    return Entry::kIn;
}

Lanes::Entry Lanes::Pass::enter(const LaneWork& work, const Deadline& deadline) {
    work_ = work;
    return lanes_.enter(work_, deadline, false, runner_, waited_ms_);
}

Lanes::Entry Lanes::Pass::expect(double ms, const Deadline& deadline) {
    {
        const std::lock_guard lock(lanes_.mutex_);
        Runner& runner = **runner_;
        const bool was_short = runner.weight == Weight::kShort;
        work_.expected_ms = ms;
        work_.weight = was_short ? weight_of(ms) : Weight::kLong;
        runner.expected_ms = ms_since(runner.since) + ms;
        if (runner.weight == work_.weight) return Entry::kIn;
        // Its claim to a lane for short work ends here. Is there another?
        runner.weight = Weight::kLong;
        const std::size_t others = lanes_.running().second - 1;
        const bool stays = others < lanes_.options_.lanes - lanes_.options_.for_short &&
                           lanes_.lines_[index_of(Weight::kLong)].empty();
        lanes_.let_in();
        if (stays) return Entry::kIn;
        lanes_.runners_.erase(*std::exchange(runner_, std::nullopt));
        lanes_.let_in();
    }
    // What it has cost so far would be lost if it were told that the line is full.
    return lanes_.enter(work_, deadline, true, runner_, waited_ms_);
}

void Lanes::Pass::leave() {
    if (!runner_) return;
    const std::lock_guard lock(lanes_.mutex_);
    lanes_.runners_.erase(*std::exchange(runner_, std::nullopt));
    lanes_.let_in();
}

Lanes::Load Lanes::load() const {
    const std::lock_guard lock(mutex_);
    const std::size_t waiting_short = lines_[index_of(Weight::kShort)].size();
    return {options_.lanes, runners_.size(), waiting_short, lines_[index_of(Weight::kLong)].size(),
            waiting_short >= options_.line && !is_room(Weight::kShort)};
}

}  // namespace awan
