// Tables of particles that were moved elsewhere, for implicit clouds (core/scene/implicit_primitive.h).
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace awan {

// A table as text: names in its first line, of which time, id, x, y, z and radius must be there and weight may be,
// others are passed over; a row each time and particle. Cells stand between commas, semicolons, tabs or blanks; lines
// that begin with # say nothing. -> the rows as a list of JSON, as `particles` of a document has them. Errors
// (kInvalidScene, at `pointer`): the line, and what is wanted there.
Result<std::string> particle_table_to_json(std::string_view table, const std::string& pointer);

}  // namespace awan
