// Splits independent work over threads. Which thread does which item never shows in the result.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace awan {

// Calls work(i) once for every i in 0..count-1, on at most `threads` threads (the caller's is one
// of them). work must not throw and items must not touch each other's data.
template <typename Work>
void parallel_for(int threads, std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> helpers;
    for (std::size_t t = 1; t < static_cast<std::size_t>(threads) && t < count; ++t)
        helpers.emplace_back(run);
    run();
}

}  // namespace awan
