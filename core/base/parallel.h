// Splits independent work over threads. Which thread does which item never shows in the result.
#pragma once

#include <cstddef>

namespace awan {

// Calls work(what, i) once for every i in 0..count-1, on at most `threads` threads (the caller's is one of them). work
// must not throw and items must not touch each other's data.
void run_in_parallel(int threads, std::size_t count, void (*work)(const void* what, std::size_t i),
                     const void* what);

// The same of anything that can be called as work(i).
template <typename Work>
void parallel_for(int threads, std::size_t count, const Work& work) {
    const auto call = [](const void* what, std::size_t i) { (*static_cast<const Work*>(what))(i); };
    run_in_parallel(threads, count, call, &work);
}

}  // namespace awan
