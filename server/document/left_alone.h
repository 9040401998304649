// What a document may hold and nobody reads: values of free keys, however deep they go.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/scene/limits.h"

namespace awan {

// Keys that any object may have and that nobody reads.
inline bool is_left_alone(std::string_view name) {
    return name.starts_with('_') || name == "name" || name == "description" || name == "$schema";
}

// Where a parser is in such a value. It tells of every value and bracket that comes.
class LeftAlone {
  public:
    // The next value is one.
    void expect() { expected_ = true; }
    // Whether the value that comes is one, or within one.
    bool passing() const { return expected_ || depth_ > 0; }
    // The same, once it has come and has no brackets.
    bool passed() {
        const bool was = passing();
        expected_ = false;
        return was;
    }
    // Whether the parser is between brackets of one.
    bool inside() const { return depth_ > 0; }
    // A bracket opens, with so many around the value. False: that is deeper than a document may be.
    bool enter(std::size_t around) {
        expected_ = false;
        if (around + depth_ >= static_cast<std::size_t>(limits::kMaxJsonDepth)) return false;
        ++depth_;
        return true;
    }
    // A bracket closes. False: it is not of such a value.
    bool leave() {
        if (depth_ == 0) return false;
        --depth_;
        return true;
    }

  private:
    bool expected_ = false;
    std::size_t depth_ = 0;
};

}  // namespace awan
