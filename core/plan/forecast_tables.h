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
inline constexpr ErrorModel kAdditiveError = {{-0.469926, 1.11971, 0.954591, 0, -1.40067, 0.511352, 0.974837, -1.62337, 0, -0.286768, 0.476775, 0.129474, -0.658738, 0.0115956, 0.796904, -0.0304579, 0, 0.0908109}};
inline constexpr ErrorModel kHarrisError = {{-1.74345, 1.10589, 0.567465, 0, -0.777319, 2.47147, -0.573343, -0.742494, 0, 0.111607, 2.19353, -0.106596, -0.229077, -0.495571, 0.423989, -0.0283148, 0, 0.0977549}};
inline constexpr ErrorModel kSingleError = {{4.16012, 0.245684, 0.283546, 0, -0.0694361, 1.26087, -1.76563, 0.487904, 0, 0.0402418, -4.49584, -0.02482, 0.0503371, -0.133567, 0.501098, -0.0428973, 0, -0.0177763}};
inline constexpr ErrorModel kTransportError = {{-3.46371, 0.336838, 0.181986, 0.366289, -0.152399, 0.624312, -0.372394, 0.677223, 0.241236, -0.378792, 1.26606, -0.0683939, -0.0983924, 0.00943965, -0.0965088, -0.0534661, 0.140714, 0.0177579}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-1.13627, 0.0791088, 0.240225, 0, -0.189842, 0.846479, -0.533638, 0.8749, 0, 0.0881408, 1.12698, -0.106072, 0.228596, -0.0398772, 0.0323733, -0.00663909, 0, -0.0431367}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{1.16893, 0, 0.00171523, 3.86521e-07, 0, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{17.9372, 0, 0.00554578, 1.28527e-06, 5.91156e-07, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{5.10153, 0, 0.0187414, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{20.1785, 0, 0.00414286, 2.92887e-06, 3.51862e-08, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.694668, 0, 0.00148121, 0, 0, 0.00503164, 4.98241e-07, 0}};
inline constexpr TimeModel kMarchDrawTime = {{70.5122, 0.000449806, 0, 2.58863e-06, 3.19186e-06, 0, 0, 0}};
inline constexpr TimeModel kPathTime = {{1336.66, 0, 0.514972, 0, 5.69794e-07, 0, 0, 0.00412819}};

}  // namespace awan
