// How errors of a scene are put, for validate.cpp and the checks of every model.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace awan {

// The shortest text that reads back as the number; "not a number", "infinite".
std::string to_text(double value);

Error invalid(std::string pointer, std::string message);  // kInvalidScene

// "must be from .. to .., not ..".
Error out_of_range(std::string pointer, double value, double lowest, double highest);
Error out_of_range(std::string pointer, std::uint64_t value, std::uint64_t lowest,
                   std::uint64_t highest);

// NaN is in no range: a draft may come from C++.
Status in_range(double value, double lowest, double highest, const std::string& pointer);
Status count_in_range(std::uint64_t value, std::uint64_t lowest, std::uint64_t highest,
                      const std::string& pointer);

}  // namespace awan
