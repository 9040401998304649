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
inline constexpr ErrorModel kAdditiveError = {{0.236545, 1.25773, 0.872959, 0, -0.805131, -0.0383552, 2.25307, -3.0478, 0, -0.0694837, -1.14128, 0.107826, -0.611986, 0.0101681, 0.100123, -0.0213991, 0, 0.0912761, 0.872761, -1.69386, -7.37905, 0.701265}};
inline constexpr ErrorModel kHarrisError = {{-2.48828, 0.902808, 0.246061, 0, -0.167557, 1.73552, 0.388293, 0.299169, 0, 0.297149, 0.663481, 0.0669666, -0.232678, -0.29, 0.0446776, 0.0130425, 0, 0.0529431, 0.119322, 0.300773, -2.93231, 0.0836679}};
inline constexpr ErrorModel kSingleError = {{1.004, 0.715246, 0.0936115, 0, -0.255586, 1.51982, 0.0205681, -1.20744, 0, -0.0353386, -1.49515, -0.0261712, -0.10626, -0.201109, 0.0978121, -0.000111879, 0, 0.0667624, -0.328841, 0.526941, -4.9076, -0.00905232}};
inline constexpr ErrorModel kTransportError = {{-4.95136, 0.905087, -0.0795365, 1.19935, -1.30721, 1.13292, -0.858695, 0.943011, 0.263274, 0.438669, 0.589332, -0.0208776, -0.0722497, 0.0813426, 0.126774, -0.0190739, -0.0548917, 0.076996, 0.0339946, -0.345825, -1.67756, 0.323244}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.731246, 0.303608, 0.071117, 0, 0.259834, 0.393515, -0.151279, -0.00683523, 0, -0.0620814, 0.988265, -0.146444, 0.210726, 0.0122429, 0.104716, 0.000426051, 0, -0.0382318, 0.233172, 0.518487, 21.6312, 0}};

}  // namespace awan
