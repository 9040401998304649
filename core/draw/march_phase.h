// The sun's beam as the eye pass sees it. The phase function is split (core/light/delta_m.h) into the part that the
// light grid's orders resolve and the forward peak; beside light scattered once by the former there is light scattered
// by the peak alone, any number of times. Without the latter, clouds between the eye and the sun would lack their
// silver lining.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace awan {

// p(mu) / 4 pi for the angle between two unit vectors d and s, by the chords |d - s| (ahead) and |d + s| (behind):
// mu = 1 - ahead^2 / 2, which would lose its digits where p is steep.
double phase_of_chords(const Medium& medium, double ahead, double behind);

// How scattering is split.
struct Peak {
    int from = 0;      // L + 1
    double share = 0;  // f; 0: there is no peak, all is "rest"
};

// p1, the phase function / 4 pi of scattering that is not the peak's: sum over l <= L of moments_l P_l(mu). Where share
// is 0 it is the whole phase function.
struct RestOfPhase {
    Medium medium;
    std::vector<double> moments;  // (2l + 1) / 4 pi (chi_l - f); empty: there is no peak
};
RestOfPhase rest_of(const Medium& medium, const Peak& peak);
double rest_of_phase(const RestOfPhase& rest, double ahead, double behind);

// Light that only the peak has scattered, at least once, on its way through depth t, as radiance per optical depth and
// irradiance (a the albedo, f the peak's share, chi_l the moments of the phase function):
//     F2(t) = sum over l <= L of (2 l + 1) / 4 pi f     exp(-t (1 - a f))     P_l(mu)
//           + sum over l > L  of (2 l + 1) / 4 pi chi_l exp(-t (1 - a chi_l)) P_l(mu).
// The table holds G = F2(t) exp(t (1 - a f)), which changes slowly with t, for the angles that a picture needs.
//
// Its columns are depths: 8 an octave of 1 + t, linear between them. Its rows are angles, even in asinh(chord /
// fold), so that a peak has many rows and the rest of the angles few; the chord is `ahead` up to 90 degrees and
// `behind` from there. Linear interpolation costs less than 0.3% of G (measured by march_test).
struct PeakTable {
    int columns = 0;            // a multiple of 16; 0: no peak
    float last = 0;             // largest t in it
    double fold = 1;            // 1 - |g|; of droplets as narrow as their peak
    double rows_per = 0;        // rows per unit of asinh
    int half = 0;               // index of the row of 90 degrees; the last has twice that
    std::vector<float> values;  // row by row; 0 in rows that no angle of the picture needs
};
struct RowAt {
    int row;
    float share;  // of the next row
};
RowAt row_at(const PeakTable& table, double ahead, double behind);

// The table for angles whose chord ahead is least_ahead to most_ahead.
PeakTable peak_table(const Medium& medium, const Peak& peak, double least_ahead, double most_ahead);

}  // namespace awan
