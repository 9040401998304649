// The split of the phase function that the transport solve rests on ("delta-M", Wiscombe 1977).
#pragma once

#include <array>

#include "core/light/harmonics.h"
#include "core/scene/scene.h"

namespace awan {

// Scattering within a narrow forward peak changes light so little that the solve treats it as if it did not happen.
// With the Legendre moments chi_l of the phase function p (legendre.h), L = 3 and f = chi_(L+1):
//     p = f peak + (1 - f) p',     chi'_l = (chi_l - f) / (1 - f) for l = 0..L.
// Extinction is scaled accordingly: of an optical depth tau in matter of albedo a, (1 - a f) tau dims the light, and
// a (1 - f) tau scatters it.
struct ScatteringSplit {
    double albedo = 1;
    // f, 0..1. 0 where g <= 0: a backward peak is not light that goes on, so it stays in p'.
    double peak_share = 0;
    std::array<double, kOrders> moment{};  // chi'_l
    // Of the harmonics, those that p' needs: 1 where it is isotropic, else all 16.
    int harmonics = kHarmonics;

    // 1 - a f: the share of the optical depth that dims light.
    double scaled() const { return 1 - albedo * peak_share; }
    // (1 - f) chi'_l: the moments of scattering that is not the peak's.
    double outside_peak(std::size_t l) const { return (1 - peak_share) * moment[l]; }
};

ScatteringSplit split_scattering(const Medium& medium);

// The phase function up to order L as it is, with nothing taken for a peak: for light that scatters once.
ScatteringSplit whole_scattering(const Medium& medium);

// The first moment of the peak that is not 1, chi_(L+2) / f: Henyey & Greenstein's g. The nearer to 1, the less the
// peak turns light.
double peak_turning(const Medium& medium);

}  // namespace awan
