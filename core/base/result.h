// Errors as values. A stage that can fail returns Result<T>: a T, or an Error that names the place.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace awan {

// What kind of thing went wrong; it decides the HTTP status and the exit code.
enum class ErrorCode {
    // HTTP 400, exit code 3: the text is no JSON, or no layout at all.
    kMalformed,
    // HTTP 422, exit code 3: it parses, but no scene can be made of it.
    kInvalidScene,
    // HTTP 422, exit code 3: a valid part of the contract that this version lacks.
    kUnsupported,
    // HTTP 413, exit code 3: over a limit on size.
    kTooLarge,
    // HTTP 503, exit code 4: no EGL or no OpenGL 4.5 here.
    kNoRenderer,
    // HTTP 504, exit code 4: the time allowed ran out.
    kOverDeadline,
    // HTTP 503, exit code 4: the system has not enough memory or threads for it now.
    kOutOfMemory,
    // No answer, exit code 4: nobody waits for it any more.
    kCancelled,
    // Exit code 5: a file could not be read or written.
    kIo,
    // HTTP 500, exit code 4: a bug.
    kInternal,
};

// What went wrong, and where.
struct Error {
    ErrorCode code = ErrorCode::kInternal;
    // JSON pointer (RFC 6901) to the offending value, e.g. "/cubes/3/size/1"; "" is the whole
    // document. For a layout that is not JSON: "line 14".
    std::string pointer;
    // What is wrong and what was allowed; one sentence, no newline.
    std::string message;
};

// Either a value or an Error. Precondition of value()/operator*/operator->: ok().
template <typename T>
class [[nodiscard]] Result {
  public:
    Result(T value) : value_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
    Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }

    T& value() & {
        assert(ok());
        return *value_;
    }
    const T& value() const& {
        assert(ok());
        return *value_;
    }
    T&& value() && {
        assert(ok());
        return *std::move(value_);
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const {
        assert(!ok());
        return error_;
    }

  private:
    // Not a std::variant, which takes a compiler far longer, in every file.
    std::optional<T> value_;
    // That of a Result without a value.
    Error error_;
};

// The outcome of something that gives no value: nothing, or an Error.
using Status = std::optional<Error>;

}  // namespace awan
