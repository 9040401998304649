// The light in a cloud as one number a cell, for programs that draw volumes.
#pragma once

#include <vector>

#include "core/light/transport_light.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// For each cell of the volume (its order), the radiance that matter there sends out per optical depth, the mean over
// all directions, luminance (Rec. 709): of the sun, the sky and the ground, scattered any number of times. Times the
// extinction it is an emission per unit of length. 0 where the volume has no matter. light: of the whole scene, with a
// grid. The same for every number of threads.
std::vector<float> light_volume(const Scene& scene, const TransportLight& light,
                                const DensityVolume& volume, int threads);

}  // namespace awan
