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
inline constexpr TimeModel kPrepareTime = {{2.02339, 0, 0.00205756, 7.59236e-08, 0, 0, 0, 0, 0, 0, 64.8617, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{1.21498, 0, 0.00302986, 1.16932e-06, 2.16378e-05, 0, 0, 0, 0, 7.3778e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{2.29904, 0, 0.00411478, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.884061, 0, 0.00288725, 1.18039e-06, 2.47639e-05, 0, 0, 0, 0, 2.4587e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.856333, 0, 0.000862366, 0, 0, 0.000401721, 1.01929e-07, 0, 0, 0, 0, 0, 0.000530615, 0.0451603}};
inline constexpr TimeModel kMarchDrawTime = {{1.3933, 0.00017019, 0.00555529, 1.34242e-07, 5.08886e-05, 0, 0, 0, 7.33291e-05, 0.00012291, 0, 3.0882e-05, 0, 0.0165453}};
// Measuring the error (measuring_figures): of grids; of others, with the light of the coarsest grid.
inline constexpr TimeModel kMeasureGridTime = {{13.0879, 0, 0.00604803, 0, 0, 0, 0, 0, 6.76296e-05, 0.000507325, 0, 2.90965e-05, 0, 0.0177897}};
inline constexpr TimeModel kMeasureOtherTime = {{9.84521, 0, 0.002081, 0, 0, 0.00111635, 1.98698e-08, 0, 7.17617e-05, 0, 0, 9.58414e-06, 0.000161295, 0}};
inline constexpr TimeModel kPathTime = {{0, 0, 1.34779, 0, 0.0045052, 0, 0, 0.0011253, 0, 0.0086587, 0, 0, 0, 0}};

}  // namespace awan
