// Whether every value of an object is in the range that its table says, whoever made it: a draft may come from C++.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/scene/table.h"

namespace awan {

// The first value that is out of its range, in the table's order, objects within included. NaN is in no range. `at` is
// the pointer to the object. Costs no allocation where all is in range, however long the lists.
Status check_ranges(const Table& table, const void* object, const std::string& at);

}  // namespace awan
