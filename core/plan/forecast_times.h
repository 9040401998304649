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
inline constexpr TimeModel kPrepareTime = {{1.43259, 0, 0.000966922, 6.64295e-08, 0, 0, 0, 0, 0, 0, 76.034, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{3.40263, 0, 0.00248724, 1.14041e-06, 8.58942e-06, 0, 0, 0, 0, 3.03988e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{2.35634, 0, 0.00562015, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.30896, 0, 0.00420637, 6.51369e-07, 3.12539e-05, 0, 0, 0, 0, 4.62078e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.848736, 0, 0.000881663, 0, 0, 0.000485522, 1.51484e-07, 0, 0, 0, 0, 0, 0.000530085, 0.0539104}};
inline constexpr TimeModel kMarchDrawTime = {{2.88837, 0, 0.00452757, 0, 0.00013594, 0, 0, 0, 0.000115255, 0.000164206, 0, 3.47236e-05, 0, 0.0138051}};
inline constexpr TimeModel kPathTime = {{0, 0, 0.412038, 0, 0.00311928, 0, 0, 0.00107784, 0, 0.00494184, 0, 0, 0, 0}};

}  // namespace awan
