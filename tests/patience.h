// How long a test waits for what should take next to no time.
#pragma once

#include <chrono>

namespace awan::test {

// So many seconds, and thirty times as many under sanitizers, which are slow.
inline std::chrono::seconds patience(int seconds) {
#ifdef AWAN_SANITIZED
    return std::chrono::seconds(30 * seconds);
#else
    return std::chrono::seconds(seconds);
#endif
}

}  // namespace awan::test
