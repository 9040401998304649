#include "core/base/parallel.h"

#include <atomic>
#include <thread>
#include <vector>

namespace awan {

void run_in_parallel(int threads, std::size_t count, void (*work)(const void* what, std::size_t i),
                     const void* what) {
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(what, i);
    };
    std::vector<std::jthread> helpers;
    for (std::size_t t = 1; t < static_cast<std::size_t>(threads) && t < count; ++t)
        helpers.emplace_back(run);
    run();
}

}  // namespace awan
