// How long a caller is willing to wait. Long loops ask over() now and then and give up with an
// Error.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>

#include "core/base/result.h"

namespace awan {

// A moment after which the answer is of no use, and whether anybody still waits for it.
struct Deadline {
    using Clock = std::chrono::steady_clock;

    // By default there is none.
    Clock::time_point until = Clock::time_point::max();
    // True as soon as nobody waits for the answer any more. May be null.
    std::shared_ptr<const std::atomic<bool>> cancelled;

    // The error to return when there is no point in going on, else nothing.
    std::optional<Error> over() const {
        if (cancelled && cancelled->load(std::memory_order_relaxed))
            return Error{ErrorCode::kCancelled, "", "the client is gone"};
        if (until != Clock::time_point::max() && Clock::now() >= until)
            return Error{ErrorCode::kOverDeadline, "",
                         "the deadline passed before the answer was ready"};
        return std::nullopt;
    }
};

// Milliseconds of wall time that have passed.
inline double ms_since(Deadline::Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Deadline::Clock::now() - start).count();
}

}  // namespace awan
