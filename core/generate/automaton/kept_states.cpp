#include "core/generate/automaton/kept_states.h"

#include <algorithm>
#include <vector>

namespace awan::automaton {

std::size_t bytes_of(const AutomatonState& state) {
    std::size_t words = state.hum.size() + state.act.size() + state.cld.size();
    for (const auto& sky : state.earlier) words += sky.size();
    return sizeof state + words * sizeof(std::uint64_t) +
           state.ellipsoids.size() * sizeof(AutomatonEllipsoid);
}

std::shared_ptr<const AutomatonState> KeptStates::latest(std::uint64_t rules, std::uint64_t key,
                                                         std::uint64_t step) {
    const std::lock_guard lock(mutex_);
    const auto run = runs_.find({rules, key});
    if (run == runs_.end()) return nullptr;
    run->second.used = ++clock_;
    const auto after = run->second.at.upper_bound(step);
    return after == run->second.at.begin() ? nullptr : std::prev(after)->second;
}

void KeptStates::pass(const AutomatonState& state) {
    if (bytes_of(state) > most_bytes_) return;
    const std::lock_guard lock(mutex_);
    Run& run = run_of(state);
    if (state.step % run.interval == 0) keep(state, run);
}

void KeptStates::arrive(const AutomatonState& state) {
    if (bytes_of(state) > most_bytes_) return;
    const std::lock_guard lock(mutex_);
    Run& run = run_of(state);
    // Whoever plays on has no use for where it was.
    if (run.asked != state.step && run.asked % run.interval != 0) drop(run, run.asked);
    run.asked = state.step;
    keep(state, run);
}

std::size_t KeptStates::bytes_in_use() const {
    const std::lock_guard lock(mutex_);
    return used_;
}

std::size_t KeptStates::states() const {
    const std::lock_guard lock(mutex_);
    std::size_t count = 0;
    for (const auto& [name, run] : runs_) count += run.at.size();
    return count;
}

KeptStates::Run& KeptStates::run_of(const AutomatonState& state) {
    Run& run = runs_[{state.rules, state.key}];
    run.used = ++clock_;
    return run;
}

void KeptStates::keep(const AutomatonState& state, Run& run) {
    const std::size_t bytes = bytes_of(state);
    if (run.at.contains(state.step)) return;
    make_room(bytes, run);
    // Its own run may have been thinned meanwhile.
    if (state.step % run.interval != 0 && state.step != run.asked) return;
    run.at.emplace(state.step, std::make_shared<const AutomatonState>(state));
    used_ += bytes;
}

void KeptStates::drop(Run& run, std::uint64_t step) {
    const auto found = run.at.find(step);
    if (found == run.at.end()) return;
    used_ -= bytes_of(*found->second);
    run.at.erase(found);
}

void KeptStates::make_room(std::size_t bytes, Run& run) {
    while (used_ + bytes > most_bytes_) {
        const auto oldest = std::min_element(
            runs_.begin(), runs_.end(),
            [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
        if (&oldest->second != &run) {
            for (const auto& [step, kept] : oldest->second.at) used_ -= bytes_of(*kept);
            runs_.erase(oldest);
            continue;
        }
        // It is alone.
        if (run.at.empty()) return;
        run.interval *= 2;
        std::vector<std::uint64_t> dropped;
        for (const auto& [step, kept] : run.at)
            if (step % run.interval != 0) dropped.push_back(step);
        // Where but one or two fit, the earlier ones go.
        if (dropped.empty()) dropped.push_back(run.at.begin()->first);
        for (const std::uint64_t step : dropped) drop(run, step);
    }
}

void keep_states(SceneDraft& draft, const std::shared_ptr<KeptStates>& kept) {
    for (Cloud& cloud : draft.clouds) {
        if (!cloud.automaton) continue;
        auto keeping = std::make_shared<AutomatonCloud>(*cloud.automaton);
        keeping->kept = kept;
        cloud.automaton = std::move(keeping);
    }
}

}  // namespace awan::automaton
