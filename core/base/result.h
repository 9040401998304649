// Errors as values. A stage that can fail returns Result<T>: a T, or an Error that names the place.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace awan {

enum class ErrorCode {
    kMalformed,     // the text is not JSON / not a layout at all            (HTTP 400, exit 3)
    kInvalidScene,  // it parses, but no scene can be made of it             (HTTP 422, exit 3)
    kUnsupported,   // a valid part of the contract that this version lacks  (HTTP 422, exit 3)
    kTooLarge,      // over a limit on size                                  (HTTP 413, exit 3)
    kNoRenderer,    // no EGL / OpenGL 4.5 here                              (HTTP 503, exit 4)
    kOverDeadline,  // the time allowed ran out                              (HTTP 504, exit 4)
    kCancelled,     // nobody waits for the answer any more                  (no answer, exit 4)
    kIo,            // a file could not be read or written                   (exit 5)
    kInternal,      // a bug                                                 (HTTP 500, exit 4)
};

struct Error {
    ErrorCode code = ErrorCode::kInternal;
    // JSON pointer (RFC 6901) to the offending value, e.g. "/cubes/3/size/1"; "" is the whole
    // document. For a layout that is not JSON: "line 14".
    std::string pointer;
    std::string message;  // what is wrong and what was allowed; one sentence, no newline
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
    Error error_;  // that of a Result without a value
};

// The outcome of something that gives no value: nothing, or an Error.
using Status = std::optional<Error>;

}  // namespace awan
