// What stands behind a cloud, as light that the forward peak has scattered shows it.
//
// The transport solve lets the peak's light go straight on (core/light/delta_m.h). But it turns by some degrees, and
// what stands behind is not the same all around: beside a low sun the sky is bright and the ground below it dark. So a
// ray has from the peak not what stands right behind it, but the mean of that over the peak's own width.
#pragma once

#include <vector>

#include "core/draw/backdrop.h"
#include "core/draw/march_phase.h"

namespace awan {

// Light that the peak has scattered once or more often, on its way through matter of depth tau, with x = a f tau and
// k = 1 - a f: of Legendre order l it keeps (exp(x r_l) - 1) / (exp(x) - 1), with r_l = 1 for l <= L and chi_l / f
// beyond. Thin matter scatters once: r_l. The most of it comes through where exp(-k tau) - exp(-tau) is the greatest,
// at x = -log k. Between the two its width grows about with x.

// That x; 50, which is as good as without end, where nothing is absorbed and all is the peak's.
double depth_of_most(const Medium& medium, const Peak& peak);

// A share of the light turns by about so much (radians, 0..pi). Shares may be negative: the peak keeps the orders up to
// L whole, and what turns far, the solve's own part of the phase function has too much of.
struct Ring {
    double angle, share;
};
// So many, of rising angles; their shares add up to 1. x >= 0. Precondition: peak.share > 0.
std::vector<Ring> rings_of_peak(const Medium& medium, const Peak& peak, double x, int count);

// Of every pixel's middle ray, r g b, row by row from the top. EMPTY where nothing is seen through the peak.
struct BehindPeak {
    std::vector<float> once;   // through thin matter
    std::vector<float> often;  // where the most comes through
};

// hills: how they are lit, if the ground has some. from_sky, from_ground: whether the peak
// brings the light of these; directions without it count as black.
BehindPeak behind_through_peak(const Scene& scene, const View& view, int width, int height,
                               const GroundLight& ground, const Peak& peak, bool from_sky,
                               bool from_ground, int threads, const ReliefLight* hills = nullptr);

}  // namespace awan
