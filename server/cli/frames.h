// Which frames of a sequence, and what their files are called.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace awan {

// "" and "all": every one of `count`; else numbers and ranges with commas, "0-11,20", "0-99x10" (every tenth), in that
// order, each < count.
Result<std::vector<std::uint64_t>> parse_frames(const std::string& text, std::uint64_t count);

// Whether so many frames can be told apart by their files' names: more than one need a place for the number.
Status check_numbered(const std::string& output, std::size_t frames);

// A name with a place for a number where there are no frames: it would be taken as it stands. flag: what it was given
// to, and a blank.
Status check_not_numbered(const std::string& output, const std::string& flag = "-o ");

// The name with frame's number in place of %d, %04d (as many digits as said, 1 to 9) or #### (as many digits as marks,
// two or more). Without such a place: the name.
std::string numbered_name(const std::string& output, std::uint64_t frame);

}  // namespace awan
