// Scenes to calibrate forecasts on and, from other keys, to check them on.
#pragma once

#include <string>

#include "core/scene/scene.h"

namespace awan::calibration {

// Scene number `index` of a set ("fit", "check", ...): thin veils to optical depth 100, g from 0 to .9, the sun all
// round, 1 to 20,000 particles, lumps, layouts of cubes, flat slabs, several clouds, eyes inside. Always the same scene
// for the same name and number. `kind` says in a word what it is.
struct NumberedScene {
    SceneDraft draft;
    std::string kind;
};
NumberedScene numbered_scene(const std::string& set, int index, int width, int height);

}  // namespace awan::calibration
