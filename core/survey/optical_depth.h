// The largest optical depth along lines through a cloud, measured on a raster of lines.
#pragma once

#include "core/base/deadline.h"
#include "core/survey/survey.h"

namespace awan {

// Over parallel lines. direction: unit.
double parallel_optical_depth(const ParticleSet& particles, glm::dvec3 direction);

struct EyeDepth {
    double largest = 0;
    // Over the rays that meet cloud: at least 5% of the largest alpha.
    double mean = 0;
    // Share of the picture's rays that meet cloud.
    double covered = 0;
    // Particles within whose cut a ray passes, mean over the picture.
    double particles_per_pixel = 0;
};

// Over the rays of a view, from the eye outward.
EyeDepth eye_optical_depth(const ParticleSet& particles, const View& view);

// Lines along the longer side of the raster.
inline constexpr int kRasterSide = 64;
// Line-particle pairs, about 10 ms each: parallel lines have separable Gaussians, rays do not.
inline constexpr double kMaxLineWork = 1e7;
inline constexpr double kMaxRayWork = 1e6;

}  // namespace awan
