// The layout file of Rekawan (Sunar et al. 2005, section 4.3), `.awn`: total particles, number of cubes, then a line
// a cube:
//   particles, x-length, y-length, z-length, cx, cy, cz, max radius
// Separators are commas and/or white space; numbers like 6.12438e-007 are read; totals that do not match the lines
// are an error that names both numbers.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// A draft of one cloud with the layout's cubes and every other value at its default.
// Errors: kMalformed, `pointer` is "line N" (1-based).
Result<SceneDraft> read_awn(std::string_view text);

// The layout of a scene. Numbers are the shortest that read back to the same double, so
// write(read(x)) and read(write(x)) are identities. Fails with kInvalidScene when the scene is more
// than one layout can say: several clouds, a moved cloud, ready particles, a cube with its own
// density.
Result<std::string> write_awn(const SceneDraft& scene);

}  // namespace awan
