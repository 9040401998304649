// Coefficients of the forecasts, written by tests/calibration/fit.py from scenes measured by tests/calibration. Not to be
// edited by hand: measure and fit anew when a rung changes.
// clang-format off
#pragma once

#include <array>

#include "core/plan/forecast_figures.h"

namespace awan {

// log(error) = sum of coefficient x figure, the margin included.
struct ErrorModel {
    ErrorFigures coefficient;
};
inline constexpr ErrorModel kAdditiveError = {{-0.739129, 0.521582, 0.899561, 0, -1.31656, 0.833945, 2.38495, -1.78595, 0, -0.433189, 1.61951, 0.0996577}};
inline constexpr ErrorModel kHarrisError = {{-1.64443, 0.633518, 0.291114, 0, -0.731068, 1.64559, -0.821806, 1.85743, 0, 0.0257171, 2.88591, -0.0877938}};
inline constexpr ErrorModel kSingleError = {{3.21566, 0.204387, 0.127068, 0, 0.271945, 0.543851, -0.958535, 0.715249, 0, -0.372387, -3.59906, -0.0686816}};
inline constexpr ErrorModel kTransportError = {{-4.13559, 0.178366, 0.043076, 0.568059, 1.23484, -0.760815, -0.485584, 1.21847, 0.27976, -0.605146, 2.08091, -0.132308}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-1.26729, 0.217487, 0.222599, 0, 0.0965947, 0.269381, -0.369081, -0.124298, 0, -0.0184165, 1.32224, -0.118306}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{0.584599, 0, 0.000863295, 1.52017e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{0.398299, 0, 0.000667601, 7.01336e-06, 1.84743e-07, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{0.0580244, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.269342, 0, 0.000763221, 4.14321e-06, 1.18146e-20, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.529841, 0, 0.00366338, 0, 0, 0.00585193, 4.21172e-07, 0}};
inline constexpr TimeModel kMarchDrawTime = {{3.71323, 0.000134743, 0.000995438, 1.59846e-05, 2.23353e-05, 0, 0, 0}};
inline constexpr TimeModel kPathTime = {{74.6634, 0, 0.0450811, 0, 0, 0, 0, 0.00148719}};

}  // namespace awan
