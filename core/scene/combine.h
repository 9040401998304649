// Several scenes as one.
#pragma once

#include "core/scene/scene.h"

namespace awan {

// Puts the clouds of `other` beside those of `scene`, where they stand; what that document says for all of its clouds
// (fill, density, seed) goes into each. Everything else is the first scene's: sun, sky, ground, haze, camera, image,
// time. Errors, kInvalidScene with a pointer into `other`: what is said of matter once a scene, and otherwise there
// (medium, detail, look).
Status combine_into(SceneDraft& scene, const SceneDraft& other);

}  // namespace awan
