// The largest optical depth along lines through a cloud, measured on a raster of lines.
#pragma once

#include "core/base/deadline.h"
#include "core/survey/survey.h"

namespace awan {

// Over parallel lines. direction: unit.
double parallel_optical_depth(const ParticleSet& particles, glm::dvec3 direction);

struct EyeDepth {
    double largest = 0;
    double mean = 0;     // over the rays that meet cloud: at least 5% of the largest alpha
    double covered = 0;  // share of the picture's rays that do
    double particles_per_pixel = 0;  // within whose cut a ray passes, mean over the picture
};

// Over the rays of a view, from the eye outward.
EyeDepth eye_optical_depth(const ParticleSet& particles, const View& view);

inline constexpr int kRasterSide = 64;  // lines along the longer side of the raster
// Line-particle pairs, about 10 ms each: parallel lines have separable Gaussians, rays do not.
inline constexpr double kMaxLineWork = 1e7;
inline constexpr double kMaxRayWork = 1e6;

}  // namespace awan
