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
inline constexpr ErrorModel kAdditiveError = {{0.36379, 1.17562, 1.23498, 0, -0.345808, -0.0847594, 0.915549, -0.382856, 0, -0.00396175, -0.400814, 0.0900693, -0.501407, -0.262019, 0.315806, -0.0676102, 0, 0.11293, 0.109593, -0.131061, 0, 0}};
inline constexpr ErrorModel kHarrisError = {{-0.572748, 1.1038, 0.52986, 0, -1.47214, 2.94806, -0.444, 1.17754, 0, 0.0577776, 1.14365, -0.163583, -0.241208, -0.360755, 0.322042, -0.0415133, 0, 0.0990032, 0.376059, -0.233467, 0, 0}};
inline constexpr ErrorModel kSingleError = {{1.20914, 0.102957, 0.347105, 0, -0.632916, 1.85735, -1.59715, 1.11292, 0, 0.165666, -0.774801, -0.127145, 0.0627865, -0.130544, 0.29014, -0.0405688, 0, -0.0417414, -0.192765, -0.4121, 0, 0}};
inline constexpr ErrorModel kTransportError = {{-3.12759, 0.0530862, 0.366958, 0.737707, -1.07909, 1.58343, -0.451864, 3.01585, 0.156582, -0.257215, 0.805981, -0.0896622, -0.102262, 0.0160038, -0.178901, -0.0924993, 0.0422239, -0.0169067, 0.662024, -0.783439, 0, 0}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.72316, 0.0198926, 0.350343, 0, -0.862719, 1.29229, -0.715986, 2.06271, 0, 0.247391, 0.914538, -0.131166, 0.180219, 0.0102818, -0.00921697, -0.0307812, 0, -0.0526665, -0.290981, -0.487141, 0, 0}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{4.85117, 0, 0.00338225, 7.66718e-07, 0, 0, 0, 0, 0, 0, 105.259}};
inline constexpr TimeModel kAdditiveTime = {{0.215865, 0, 0.0044202, 1.96891e-06, 5.25528e-05, 0, 0, 0, 0, 5.09407e-05, 0}};
inline constexpr TimeModel kHarrisLightTime = {{1.62746, 0, 0.0257787, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.529611, 0, 0.00643643, 2.23003e-06, 4.86236e-05, 0, 0, 0, 0, 5.51498e-06, 0}};
inline constexpr TimeModel kMarchLightTime = {{1.33539, 0, 0.000994512, 0, 0, 0.0041944, 5.23618e-07, 0, 0, 0, 26.648}};
inline constexpr TimeModel kMarchDrawTime = {{17.4879, 0.000819024, 0, 3.5508e-06, 0.000153961, 0, 0, 0, 3.99446e-05, 0.000575353, 0}};
inline constexpr TimeModel kPathTime = {{83.3994, 0, 0.0175855, 0, 0.0112723, 0, 0, 0.00154639, 0, 0.00787429, 0}};

}  // namespace awan
