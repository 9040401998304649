#pragma once

#include <string>

#include "core/scene/scene.h"

namespace awan {

// The scene's extinction and light (core/light/light_volume.h) as an OpenVDB file. The light is that of the rung that
// the scene names, else of transport-32. voxels: along the longest side; fewer where they would take more than
// most_work (core/survey/volume.h). Errors: kInvalidScene, of a rung or a look without a grid, and those of
// encode_vdb().
Result<std::string> encode_lit_vdb(const Scene& scene, int voxels, double most_work, int threads);

}  // namespace awan
