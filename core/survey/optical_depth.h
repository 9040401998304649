// The largest optical depth along lines through a cloud, measured on a raster of lines.
#pragma once

#include "core/deadline.h"
#include "core/survey/survey.h"

namespace awan {

// Over parallel lines. direction: unit.
double parallel_optical_depth(const ParticleSet& particles, glm::dvec3 direction);

// Over the rays of a view, from the eye outward.
double eye_optical_depth(const ParticleSet& particles, const View& view);

inline constexpr int kRasterSide = 64;  // lines along the longer side of the raster
// Line-particle pairs, about 10 ms each: parallel lines have separable Gaussians, rays do not.
inline constexpr double kMaxLineWork = 1e7;
inline constexpr double kMaxRayWork = 1e6;

}  // namespace awan
