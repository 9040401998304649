// Coefficients of the forecasts, written by tests/calibration/fit.py from scenes measured by tests/calibration. Not to be
// edited by hand: measure and fit anew when a rung changes.
// clang-format off
#pragma once

#include "core/plan/forecast_figures.h"

namespace awan {

// log(error) = sum of coefficient x figure, the margin included. Of grids without what known_error.h says.
struct ErrorModel {
    ErrorFigures coefficient;
};
inline constexpr ErrorModel kAdditiveError = {{0.78326, 0.668929, 0.489794, 0, -1.07031, 0.538873, 0.888417, -2.96435, 0, 0.333781, -1.54834, 0.119472, 0.373515, 0.0299779, 0.453165, 0.0509962, 0, -0.110191, -0.500113, 1.94215, 0, 0}};
inline constexpr ErrorModel kHarrisError = {{-2.17912, 0.65581, 0.0922852, 0, -0.474278, 1.79237, 0.411764, -0.688256, 0, 0.603524, 1.73901, -0.0586931, 0.574149, -0.206749, 0.228269, 0.00513256, 0, -0.168855, 0.326475, -1.02689, 0, 0}};
inline constexpr ErrorModel kSingleError = {{1.72975, 0.396293, 0.0116681, 0, 0.651421, 0.00629548, 1.23227, -0.598411, 0, -0.536298, -2.25925, -0.0743893, 0.119472, -0.142581, -0.257366, -0.0040124, 0, -0.0931884, -0.143573, 0.209332, 0, 0}};
inline constexpr ErrorModel kTransportError = {{-5.37649, 0.417917, -0.115083, 0.962719, 1.08195, -0.489245, -0.946742, 1.80205, 0.307612, 0.212131, 1.08487, -0.123067, 0.921564, -0.210891, 0.146248, 0.0326785, -0.0923291, -0.0499254, 0.331576, -0.405277, -3.36248, 0}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.731246, 0.303608, 0.071117, 0, 0.259834, 0.393515, -0.151279, -0.00683523, 0, -0.0620814, 0.988265, -0.146444, 0.210726, 0.0122429, 0.104716, 0.000426051, 0, -0.0382318, 0.233172, 0.518487, 21.6312, 0}};

}  // namespace awan
