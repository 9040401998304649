// How long a test waits and how much it looks at: sanitizers take 5 to 20 times as long for the same.
#pragma once

#include <chrono>

namespace awan::test {

#ifdef AWAN_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// How long to wait for what should take so many seconds at most.
inline std::chrono::seconds patience(int seconds) {
    return std::chrono::seconds(kSanitized ? 30 * seconds : seconds);
}

// As many scenes, paths or pixels as a law is tried on; under sanitizers only so few that all its code runs.
template <typename Number>
constexpr Number or_fewer(Number all, Number sanitized) {
    return kSanitized ? sanitized : all;
}

}  // namespace awan::test
