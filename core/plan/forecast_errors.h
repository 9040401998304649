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
inline constexpr ErrorModel kAdditiveError = {{0.609313, 1.00719, 0.801798, 0, -0.457454, -0.115134, 2.24968, -1.9731, 0, -0.238765, -1.58523, 0.0942517, -0.00934387, -0.0441918, -0.0210513, 0.00388217, 0, 0.00376755, 0.0651203, -1.56576, -7.05023, 0.530846}};
inline constexpr ErrorModel kHarrisError = {{-2.95389, 0.571048, 0.199503, 0, 0.641208, 1.01784, 1.62736, 0.599664, 0, 0.02622, 0.845616, 0.05215, 0.236097, -0.27174, -0.219967, 0.0228783, 0, -0.0621398, 0.233432, -0.133225, -4.60502, -0.504302}};
inline constexpr ErrorModel kSingleError = {{0.743036, 0.258728, 0.0321202, 0, 0.500522, 0.694663, 0.306962, -0.676193, 0, -0.135271, -1.26394, -0.0893084, 0.281765, -0.199619, 0.00294129, 0.00805727, 0, -0.0810063, -0.188435, -0.0509731, -5.98997, -0.328778}};
inline constexpr ErrorModel kTransportError = {{-5.37562, 0.937164, -0.000334971, 1.07949, -0.535907, 1.23121, -0.0600501, 0.0430453, 0.26758, 0.608624, 0.997569, -0.0907357, 0.466177, -0.0807428, 0.156667, -0.0230569, -0.0657076, 0.115117, 0.594011, -1.10807, -3.15411, -0.520338}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.731246, 0.303608, 0.071117, 0, 0.259834, 0.393515, -0.151279, -0.00683523, 0, -0.0620814, 0.988265, -0.146444, 0.210726, 0.0122429, 0.104716, 0.000426051, 0, -0.0382318, 0.233172, 0.518487, 21.6312, 0}};

}  // namespace awan
