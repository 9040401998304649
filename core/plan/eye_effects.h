#pragma once

namespace awan {

// The effects that are made along the rays from the eye, by whatever draws a picture ray by ray (core/draw/march.h,
// core/truth/path_tracer.h). The plan decides (Plan::eye_effects).
struct EyeEffects {
    // The scene's haze, if it has any.
    bool aerial_perspective = true;
    // The clouds' shadows in that haze.
    bool light_shafts = true;
};

}  // namespace awan
