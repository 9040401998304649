// Two ways to do a thing, timed turn by turn in one run, so that a noisy machine disturbs both
// alike.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace awan::bench {

template <typename Work>
double milliseconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// Counters: ours_ms and baseline_ms (medians), times_faster (median of the ratios of neighbours).
template <typename Ours, typename Baseline>
void paired(benchmark::State& state, const Ours& ours, const Baseline& baseline) {
    std::vector<double> a, b, ratio;
    ours();  // warm up: shaders compiled, memory touched
    baseline();
    for (auto _ : state) {
        a.push_back(milliseconds(ours));
        b.push_back(milliseconds(baseline));
        ratio.push_back(b.back() / a.back());
        state.SetIterationTime(a.back() / 1e3);
    }
    state.counters["ours_ms"] = median(a);
    state.counters["baseline_ms"] = median(b);
    state.counters["times_faster"] = median(ratio);
}

}  // namespace awan::bench
