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
inline constexpr ErrorModel kAdditiveError = {{-0.752527, 0.988518, 0.546535, 0, -0.897142, -0.446032, 3.86106, -2.38779, 0, -0.936356, 1.39978, 0.0997121}};
inline constexpr ErrorModel kHarrisError = {{-1.05863, 1.12963, 0.162234, 0, -0.36106, -0.0544904, 1.84648, 0.486843, 0, 0.0816395, 1.23112, -0.227788}};
inline constexpr ErrorModel kSingleError = {{4.95733, 0.684874, -0.0732855, 0, 0.830372, 0.218285, -0.839255, 1.4572, 0, -0.817827, -4.76786, -0.110876}};
inline constexpr ErrorModel kTransportError = {{-3.81715, 0.325484, -0.163022, 0.822954, 1.71521, -1.49001, 0.661427, 1.11024, 0.146989, -1.46504, 1.2191, -0.298638}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.615856, 0.380571, 0.152549, 0, 0.132541, 0.0933859, -0.449137, 0.91181, 0, -0.612844, 0.809764, -0.160145}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{0.40136, 0, 0.00107519, 2.85785e-05, 0, 0, 0, 0}};
inline constexpr TimeModel kAdditiveTime = {{0.290315, 0, 0.00492781, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisLightTime = {{0.0571455, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.328857, 0, 0.00423104, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.502837, 0, 0.00555054, 0, 0, 0.00867481, 4.03829e-07, 0}};
inline constexpr TimeModel kMarchDrawTime = {{2.90139, 0.000727092, 0.000704345, 2.97471e-05, 8.90015e-19, 0, 0, 0}};
inline constexpr TimeModel kPathTime = {{135.745, 0, 0.235693, 0, 0, 0, 0, 0.00192858}};

}  // namespace awan
