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
inline constexpr ErrorModel kAdditiveError = {{-0.469926, 1.11971, 0.954591, 0, -1.40067, 0.511352, 0.974837, -1.62337, 0, -0.286768, 0.476775, 0.129474, -0.658738, 0.0115956, 0.796904, -0.0304579, 0, 0.0908109, 0, 0, 0, 0}};
inline constexpr ErrorModel kHarrisError = {{-1.74345, 1.10589, 0.567465, 0, -0.777319, 2.47147, -0.573343, -0.742494, 0, 0.111607, 2.19353, -0.106596, -0.229077, -0.495571, 0.423989, -0.0283148, 0, 0.0977549, 0, 0, 0, 0}};
inline constexpr ErrorModel kSingleError = {{4.16012, 0.245684, 0.283546, 0, -0.0694361, 1.26087, -1.76563, 0.487904, 0, 0.0402418, -4.49584, -0.02482, 0.0503371, -0.133567, 0.501098, -0.0428973, 0, -0.0177763, 0, 0, 0, 0}};
inline constexpr ErrorModel kTransportError = {{-3.46371, 0.336838, 0.181986, 0.366289, -0.152399, 0.624312, -0.372394, 0.677223, 0.241236, -0.378792, 1.26606, -0.0683939, -0.0983924, 0.00943965, -0.0965088, -0.0534661, 0.140714, 0.0177579, 0, 0, 0, 0}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-1.13627, 0.0791088, 0.240225, 0, -0.189842, 0.846479, -0.533638, 0.8749, 0, 0.0881408, 1.12698, -0.106072, 0.228596, -0.0398772, 0.0323733, -0.00663909, 0, -0.0431367, 0, 0, 0, 0}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{1.99424, 0, 0.00257119, 3.33524e-07, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{0.130246, 0, 0.00428898, 1.46054e-06, 5.82299e-05, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{2.8784, 0, 0.0363786, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.354794, 0, 0.00566278, 2.34865e-06, 5.99665e-05, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.726964, 0, 0.00106465, 0, 0, 0.00463359, 5.58925e-07, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchDrawTime = {{17.8033, 0.000591203, 0, 3.21642e-06, 0.000164679, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kPathTime = {{82.5531, 0, 0.0170453, 0, 0.0104222, 0, 0, 0.00247803, 0, 0, 0}};

}  // namespace awan
