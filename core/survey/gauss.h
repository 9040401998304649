// The cumulative normal distribution, for masses and half-line optical depths of Gaussians.
#pragma once

namespace awan {

// How far a Gaussian is followed, in s. What lies beyond (0.03% of its mass) is folded back by renormalising where
// mass must be kept.
inline constexpr double kGaussianCut = 4;

// (1 + erf(x / sqrt 2)) / 2 by linear interpolation in a table; absolute error < 2e-7, monotonic, 0
// below -5.5 and 1 above 5.5.
double normal_cdf(double x);

}  // namespace awan
