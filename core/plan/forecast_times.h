// Coefficients of the forecasts, written by tests/calibration/fit.py from scenes measured by tests/calibration. Not to be
// edited by hand: measure and fit anew when a rung changes.
// clang-format off
#pragma once

#include "core/plan/forecast_figures.h"

namespace awan {

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{3.60712, 0, 0.0018534, 2.81182e-08, 0, 0, 0, 0, 0, 0, 71.0839, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{0.598091, 0, 0.00456869, 1.6139e-06, 6.67814e-05, 0, 0, 0, 0, 6.8738e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{2.57761, 0, 0.00568982, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.203591, 0, 0.00431405, 8.99397e-07, 4.0901e-05, 0, 0, 0, 0, 2.41709e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{1.22376, 0, 0.000678895, 0, 0, 0.000564842, 1.04652e-07, 0, 0, 0, 0, 0, 0.000508753, 0.0503716}};
inline constexpr TimeModel kMarchDrawTime = {{0.783154, 0.000112313, 0.00444618, 4.17954e-07, 7.36477e-05, 0, 0, 0, 6.83242e-05, 0.000118425, 0, 3.40664e-05, 0, 0.0156401}};
inline constexpr TimeModel kPathTime = {{0, 0, 0.839193, 0, 0.0041085, 0, 0, 0.000944044, 0, 0.00936433, 0, 0, 0, 0}};

}  // namespace awan
