// The sun's beam as the eye pass sees it: the phase function split into the part that the light grid's orders
// resolve and the forward peak, and light that was scattered by the peak alone, any number of times.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace awan {

// p(mu) / 4 pi, with the chords |d - s| and |d + s| of the unit vectors that enclose the angle (mu = 1 - chord^2 / 2):
// no cancellation where p is steep.
double phase_of_chords(const Medium& medium, double ahead, double behind);

// How the scattering is split.
struct Peak {
    int from = 0;      // L + 1
    double share = 0;  // f; 0: there is no peak, all is "rest"
};

// p1: the phase function / 4 pi of scattering that is not the peak's; the whole phase function if share is 0.
struct RestOfPhase {
    Medium medium;
    std::vector<double> moments;  // (2l + 1) / 4 pi (chi_l - f); empty: there is no peak
};
RestOfPhase rest_of(const Medium& medium, const Peak& peak);
double rest_of_phase(const RestOfPhase& rest, double ahead, double behind);

// F2(t), radiance per optical depth of the light that the peak alone has scattered, at least once, on the way through
// depth t: sum over l <= L of (2l+1)/4pi f exp(-t (1 - a f)) P_l + sum over l > L of (2l+1)/4pi chi_l exp(-t (1 - a chi_l)) P_l.
// The table holds G = F2(t) exp(t (1 - a f)), which is slow in t, for the angles that a picture needs.
//
// In t: 8 intervals an octave of 1 + t, linear in t within each. In angle: rows, even in asinh(chord / (1 - |g|)), so that a
// peak at either end has as many rows as it needs.
// Linear interpolation costs below 0.3% of G (measured by march_test).
struct PeakTable {
    int columns = 0;  // a multiple of 16; 0: no peak
    float last = 0;   // largest t in it
    double fold = 1;  // 1 - |g|
    double rows_per = 0;
    int half = 0;               // rows from 0 to 90 degrees, less one
    std::vector<float> values;  // of rows that no angle in the asked range needs: 0
};
struct RowAt {
    int row;
    float share;  // of the next row
};
RowAt row_at(const PeakTable& table, double ahead, double behind);

// Angles by their chords ahead: those of the picture.
PeakTable peak_table(const Medium& medium, const Peak& peak, double least_ahead, double most_ahead);

}  // namespace awan
