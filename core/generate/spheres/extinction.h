#pragma once

#include "core/scene/spheres.h"

namespace awan::spheres {

// The extinction of a leaf, 1/unit: sigma = -ln t, where the visual range is S_M = ln .02 / ln t, so sigma = ln 50 /
// S_M. Without a visual range it is the cloud's density.
inline double extinction_of(const SpheresCloud& cloud, double density) {
    constexpr double kLn50 = 3.912023005428146;
    return cloud.visual_range ? kLn50 / *cloud.visual_range : density;
}

}  // namespace awan::spheres
