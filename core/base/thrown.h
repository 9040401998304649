// What was thrown, as an Error.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "core/base/result.h"

namespace awan {

// What is said where there is no memory; of those who have none even for an Error.
inline constexpr std::string_view kOutOfMemoryText = "there is not enough memory for this now";

inline Error out_of_memory() {
    return {ErrorCode::kOutOfMemory, "", std::string(kOutOfMemoryText)};
}

// out_of_memory() of what memory, or threads, that could not be had throw; of others kInternal with their text.
inline Error error_of_thrown(const std::exception& thrown) {
    if (dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr ||
        dynamic_cast<const std::system_error*>(&thrown) != nullptr)
        return out_of_memory();
    return {ErrorCode::kInternal, "", thrown.what()};
}

}  // namespace awan
