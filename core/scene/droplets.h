// How a cloud's droplets of water scatter light: the phase function that the series of Lorenz and Mie (mie.h) gives
// for drops of many sizes, with the corona's peak ahead, the fogbow about 40 degrees from straight back, and the glory.
//
// Drops are distributed as Hansen & Travis 1974 has it: n(r) ~ r^((1 - 3 v) / v) exp(-r / (a v)), a the effective
// radius, v = 0.1 the effective variance. Refractive indices of water are those of Hale & Querry 1973. The function is
// one for all colours, the mean of three wavelengths by their share of luminance: bow and glory are white.
#pragma once

#include <memory>
#include <vector>

namespace awan {

// p, of mean 1 over the sphere. It is linear between nodes in w, which is 1 - cosine for the half of the sphere ahead
// and 1 + cosine for that behind. The nodes divide the octaves of 1 + w (2^octaves - 1) evenly, kPerOctave each, so
// that the bits of that float say between which nodes it lies.
struct DropletPhase {
    static constexpr int kPerOctaveBits = 5;
    double diameter = 0;  // effective, micrometres
    int octaves = 0;
    std::vector<double> nodes;          // w, from 0 to 1
    std::vector<double> ahead, behind;  // p there
    std::vector<double> moment;         // Legendre moments, of order 0 on: 1, the mean cosine, ...
};

// diameter: effective, micrometres, limits::kMinDroplet..kMaxDroplet. Takes some 50 ms, at 50 micrometres 100.
DropletPhase droplet_phase(double diameter);

// p for less = 1 - cosine and more = 1 + cosine, each without cancellation.
double phase_value(const DropletPhase& droplets, double less, double more);

// The share of light that turns by less than the angle of 1 - cosine = less, 0..2.
double share_within(const DropletPhase& droplets, double less);

// Jendersie et al. 2023, a fit of Henyey & Greenstein's function and Draine's (core/shaders/phase.glsl) to that of
// droplets of one diameter (micrometres, 1.5..50): p = (1 - share) HG(narrow) + share Draine(wide, alpha). It has no
// bow and no glory. For splats.
struct DropletFit {
    double narrow = 0, wide = 0, alpha = 0, share = 0;
};
DropletFit droplet_fit(double diameter);

}  // namespace awan
