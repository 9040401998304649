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
inline constexpr ErrorModel kAdditiveError = {{0.156692, 1.25145, 0.869404, 0, -0.812746, -0.0280516, 2.24721, -3.04924, 0, -0.0702216, -1.14165, 0.107362, -0.605154, 0.0088911, 0.102911, -0.0212417, 0, 0.0901194, 0.883511, -1.66035, -7.33854, 0.700117}};
inline constexpr ErrorModel kHarrisError = {{-2.59312, 0.892758, 0.235444, 0, -0.0549103, 1.65733, 0.329991, 0.265552, 0, 0.305748, 0.656205, 0.0657759, -0.221612, -0.301321, 0.0953176, 0.015343, 0, 0.0515933, 0.136294, 0.298493, -2.82625, 0.0797357}};
inline constexpr ErrorModel kSingleError = {{0.912375, 0.717036, 0.0965986, 0, -0.241231, 1.5031, 0.0315791, -1.22594, 0, -0.0347722, -1.49624, -0.0265948, -0.107426, -0.201137, 0.097267, -0.000528051, 0, 0.0669859, -0.329197, 0.512752, -4.81277, -0.0158669}};
inline constexpr ErrorModel kTransportError = {{-5.30507, 0.810866, 0.196794, 0.758253, -0.930397, 0.745288, -0.70106, 1.01172, 0.230312, 0.484955, 0.679704, -0.00805378, -0.060934, 0.0598148, 0.16242, -0.039981, -0.0211759, 0.0678484, 0.892345, -0.294918, -2.09682, 0.291547}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.731246, 0.303608, 0.071117, 0, 0.259834, 0.393515, -0.151279, -0.00683523, 0, -0.0620814, 0.988265, -0.146444, 0.210726, 0.0122429, 0.104716, 0.000426051, 0, -0.0382318, 0.233172, 0.518487, 21.6312, 0}};

}  // namespace awan
