// What the haze of a scene does to its picture, measured on a raster of rays before anything is decided.
#pragma once

#include "core/survey/survey.h"

namespace awan {

// Uses the survey's view and volume. Zeros without haze. Sampled: 16 x 12 rays, 32 points each; about 2 ms.
HazeFigures haze_figures(const Scene& scene, const Survey& survey);

}  // namespace awan
