// Coefficients of the forecasts, fitted by tests/calibration/fit.py to scenes measured by tests/calibration. Not to be edited
// by hand: measure and fit anew when a rung changes.
#pragma once

#include <array>

#include "core/plan/forecast_figures.h"

namespace awan {

// log(error) = sum of coefficient x figure, the margin included.
struct ErrorModel {
    ErrorFigures coefficient;
};
inline constexpr ErrorModel kAdditiveError = {{0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr ErrorModel kHarrisError = {{0, .8, .1, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr ErrorModel kSingleError = {{0, .8, .1, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr ErrorModel kTransportError = {{-3.5, .8, .1, .8, 0, 0, .5, 0, 0, 0, 0, 0}};
// Of rung truth: noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};

// ms = sum of coefficient x figure, on one thread of the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
inline constexpr TimeModel kPrepareTime = {{1, 0, 1e-4, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kSplatTime = {{5, 2e-5, 1e-3, 3.6e-6, 0, 0, 0, 0}};
inline constexpr TimeModel kMarchTime = {{3, 1e-4, 0, 4e-6, 1e-4, 1e-3, 1e-6, 0}};
inline constexpr TimeModel kPathTime = {{3, 0, 0, 0, 0, 0, 0, 7e-3}};

// Share of the march rungs' time that more threads do not shorten.
inline constexpr double kSerialShare = 0.2;

}  // namespace awan
