#pragma once

#include "core/scene/spheres.h"

namespace awan::spheres {

// sigma = -ln t, 1/unit, of S_M = ln .02 / ln t: ln 50 / S_M. Without a visual range, the cloud's density.
inline double extinction_of(const SpheresCloud& cloud, double density) {
    constexpr double kLn50 = 3.912023005428146;
    return cloud.visual_range ? kLn50 / *cloud.visual_range : density;
}

}  // namespace awan::spheres
