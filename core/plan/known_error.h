// What of the error of a picture by transport is known from the survey alone: no two grids differ by it, so it is
// never measured. Forecasts and stated errors contain it alike.
#pragma once

#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Relative, as RungForecast::error; without Survey::model_error. detailed: whether detail (core/generate/detail.h) is
// seen. cells: of the rung, along the longest side.
double known_error(const Scene& scene, const Survey& survey, bool detailed, int cells);

}  // namespace awan
