// What stands behind a cloud, as light that the forward peak has scattered shows it.
//
// The transport solve lets the peak's light go straight on (core/light/delta_m.h). But it turns by some degrees, and
// what stands behind is not the same all around: beside a low sun the sky is bright and the ground below it dark. So a
// ray has from the peak not what stands right behind it, but the mean of that over the peak's own width.
#pragma once

#include <vector>

#include "core/draw/backdrop.h"
#include "core/draw/march_phase.h"

namespace awan {

// Angles (radians, rising, in 0..pi) of so many rings that each hold the same share of the light that the peak has
// scattered once or more often, at the depth at which the most of it comes through: where exp(-k tau) - exp(-tau) is
// the greatest, k = 1 - a f. Of order l it keeps (exp(a f tau r_l) - 1) / (exp(a f tau) - 1), with r_l = 1 for l <= L
// and chi_l / f beyond. Precondition: peak.share > 0.
std::vector<double> rings_of_peak(const Medium& medium, const Peak& peak, int count);

// Of every pixel's middle ray, r g b, row by row from the top. from_sky, from_ground: whether the peak brings the light
// of these; directions without it count as black.
std::vector<float> behind_through_peak(const Scene& scene, const View& view, int width, int height,
                                       const GroundLight& ground, const Peak& peak, bool from_sky,
                                       bool from_ground, int threads);

}  // namespace awan
