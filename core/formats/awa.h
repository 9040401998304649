// The layout file of the texture system, `.awa`. Rekawan (Sunar et al. 2005) had one beside `.awn` (awn.h), of which
// nothing but the ending was published; this one is Awan's, in the manner of that:
//   awa 1
//   total of billboards
//   number of cubes
// and then a line a cube:
//   billboards, x-length, y-length, z-length, cx, cy, cz, max radius, texture
// The first line says which version of the format it is; there is the first alone. Separators, numbers and totals are
// as in `.awn`. The texture is a name or a hash (scene/texture.h), or "none": the cube is of particles then.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// Whether that is how such a layout begins.
bool is_awa(std::string_view text);

// A draft of one cloud with the layout's cubes, as many particles in each as it has billboards, and every other value
// at its default. Errors: kMalformed, `pointer` is "line N" (1-based).
Result<SceneDraft> read_awa(std::string_view text);

// The layout of a scene, as write_awn: what a cube is painted with and how many billboards it has are those that hold
// for it, be they its own, the cloud's or the scene's. Fails with kInvalidScene when the scene is more than one layout
// can say.
Result<std::string> write_awa(const SceneDraft& scene);

}  // namespace awan
