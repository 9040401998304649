// What a ground does to the picture, before it is decided whether to follow it.
#pragma once

#include "core/survey/survey.h"

namespace awan {

// Whether any particle has matter (within 4 s) below a height.
bool reaches_below(const ParticleSet& particles, double height);

// On 24 x 18 rays; depths towards the sun (the zenith, where no sun is up) by steps through survey.volume, within
// some 5% of it or .05. Below 1 ms. Preconditions: survey has its bounds, view and volume.
GroundView ground_view(const Scene& scene, const ParticleSet& particles, const Survey& survey,
                       int threads);

}  // namespace awan
