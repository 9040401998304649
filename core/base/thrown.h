// What was thrown, as an Error.
#pragma once

#include <exception>
#include <new>
#include <system_error>

#include "core/base/result.h"

namespace awan {

// kOutOfMemory of what memory, or threads, that could not be had throw; kInternal with the exception's text of others.
inline Error error_of_thrown(const std::exception& thrown) {
    if (dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr ||
        dynamic_cast<const std::system_error*>(&thrown) != nullptr)
        return {ErrorCode::kOutOfMemory, "", "there is not enough memory for this now"};
    return {ErrorCode::kInternal, "", thrown.what()};
}

}  // namespace awan
