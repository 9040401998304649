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
inline constexpr ErrorModel kAdditiveError = {{-0.0801274, 1.13869, 1.19589, 0, -0.235722, -0.0592774, 0.683274, 0.170271, 0, 0.0909974, -0.240217, 0.0881006, -0.391555, -0.301232, 0.330122, -0.059649, 0, 0.13022, 0.0552195, -0.133332, 0, 0}};
inline constexpr ErrorModel kHarrisError = {{-1.64714, 0.868624, 0.524235, 0, -1.46976, 2.88476, -0.644077, 1.96814, 0, 0.0103537, 1.17364, -0.133216, -0.068991, -0.350617, 0.27194, -0.0385834, 0, 0.0925379, 0.251003, -0.370787, 0, 0}};
inline constexpr ErrorModel kSingleError = {{0.145346, -0.0979279, 0.42612, 0, -0.755218, 1.88345, -0.805012, 0.615048, 0, 0.0801444, -0.575427, -0.11271, 0.0746639, -0.0865946, 0.0857867, -0.0472325, 0, -0.0604897, -0.281532, -0.373682, 0, 0}};
inline constexpr ErrorModel kTransportError = {{-3.82529, -0.130094, 0.434002, 0.407413, -1.4907, 2.45621, -1.28204, 4.1766, 0.170431, 0.278833, 1.0974, -0.0866506, 0.08152, -0.0960187, -0.0808782, -0.0772548, 0.0668035, -0.0442533, 0.474748, -1.05927, 0, 0}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.903463, 0.0198926, 0.350343, 0, -0.862719, 1.29229, -0.715986, 2.06271, 0, 0.247391, 0.914538, -0.131166, 0.180219, 0.0102818, -0.00921697, -0.0307812, 0, -0.0526665, -0.290981, -0.487141, 0, 0}};

// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};
// Generate, survey and plan.
inline constexpr TimeModel kPrepareTime = {{5.31389, 0, 0.00475237, 5.71011e-07, 0, 0, 0, 0, 0, 0, 82.2002}};
inline constexpr TimeModel kAdditiveTime = {{0.183952, 0, 0.00431395, 2.03743e-06, 5.95797e-05, 0, 0, 0, 0, 0.000135716, 0}};
inline constexpr TimeModel kHarrisLightTime = {{3.24224, 0, 0.0211936, 0, 0, 0, 0, 0, 0, 0, 0}};
inline constexpr TimeModel kHarrisDrawTime = {{0.385357, 0, 0.00543768, 1.53177e-06, 6.74882e-05, 0, 0, 0, 0, 0.000230138, 0}};
inline constexpr TimeModel kMarchLightTime = {{0.727997, 0, 0.00146654, 0, 0, 0.00390448, 5.00809e-07, 0, 0, 0, 36.1384}};
inline constexpr TimeModel kMarchDrawTime = {{19.8712, 0.000937638, 0, 4.39446e-06, 0.000138208, 0, 0, 0, 4.64135e-05, 0.000876269, 0}};
inline constexpr TimeModel kPathTime = {{91.7186, 0, 0.0429349, 0, 0.0111907, 0, 0, 0.0011443, 0, 0.00579892, 0}};

}  // namespace awan
