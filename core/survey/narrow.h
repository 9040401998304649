// Particles that are narrow beside the gaps between a picture's rays: how wide they are drawn, so that rays see all of
// their matter, and how much optical depth that leaves them.
//
// A picture shows the mean of transmittance, not the transmittance of the mean depth. Rays through a Gaussian of
// central depth tau and standard deviation s lose light over the area
//     integral of 1 - exp(-tau exp(-r^2 / (2 s^2))) over the plane = 2 pi s^2 Ein(tau),
//     Ein(z) = integral of (1 - exp(-t)) / t over t = 0..z
// (Abramowitz & Stegun 1964, 5.1.40). One that is drawn wider keeps this area, not its mass: a mean over all places of
// particles that stand independently of each other is then exact, since the transmittances of such multiply.
#pragma once

namespace awan {

// Least s, in gaps between rays, of a Gaussian that is drawn: a narrower one is widened to that. Sampled at the rays, a
// thin one sums to its area within 1%.
inline constexpr double kLeastWidth = 0.6;
// The same for a Gaussian of any central depth: the deeper, the steeper are its edges, and the closer rays have to be.
double least_width(double depth);

// Ein(z), z >= 0; relative error < 1e-9.
double covered_area(double depth);
// Its inverse: relative error < 1e-6.
double depth_covering(double area);

// Central depth of a Gaussian of depth `depth` that is drawn `wider` times as wide, >= 1: Ein of it is Ein(depth) /
// wider^2.
double widened_depth(double depth, double wider);

}  // namespace awan
