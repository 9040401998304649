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
inline constexpr ErrorModel kAdditiveError = {{1.90105, 0.878644, 0.692138, 0, 1.60932, -1.31764, 0.139051, -2.68242, 0, -0.146463, -1.99332, -0.0608248, 0.580218, -0.514849, 1.34893, 0.00521729, 0, 0.0143109, 1.39254, -2.57672, -8.14558, 0.702067}};
inline constexpr ErrorModel kHarrisError = {{-0.67524, 0.60207, 0.18909, 0, -0.28802, 2.03535, 0.91566, -1.0221, 0, 0.065032, 0.447815, -0.194994, 0.478219, -0.404919, 0.146925, 0.00336313, 0, -0.128556, 0.890364, -1.48792, -6.18424, -0.634096}};
inline constexpr ErrorModel kSingleError = {{1.23524, 0.474289, 0.103021, 0, 0.106565, 0.835713, 0.254581, 0.368406, 0, -0.439531, -1.20737, -0.109923, 0.161984, -0.0833627, -0.394509, -0.0128523, 0, 0.0218814, 0.24738, -0.62115, -5.75166, -0.35172}};
inline constexpr ErrorModel kTransportError = {{-3.66366, 0.366972, -0.0241193, 0.228208, 0.167981, 1.48503, 1.41726, -3.78492, 0.150326, 0.0423132, 0.717542, -0.0958024, 0.151793, -0.278064, -0.247332, 0.00602158, 0.0312943, -0.063734, 2.13665, -1.32386, -6.89757, -0.436759}};
// Of rung truth: rms noise of a pixel with one path.
inline constexpr ErrorModel kPathNoise = {{-0.655201, 0.413742, 0.0962093, 0, -0.217755, 1.07725, 0.360736, -0.490079, 0, 0.12886, 0.925809, -0.132288, 0.35038, -0.0102349, -0.099063, -0.0106852, 0, 0.00213514, 0.701691, -0.970007, -4.39352, -0.643473}};

}  // namespace awan
