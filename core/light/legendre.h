#pragma once

#include "core/scene/scene.h"

namespace awan {

// The Legendre moment chi_l, l >= 0, of the phase function p of the scattering angle's cosine mu:
//     p(mu) = sum_l (2 l + 1) chi_l P_l(mu),     chi_0 = 1, chi_1 the mean cosine.
// Henyey & Greenstein (1941): chi_l = g^l. Cornette & Shanks (1992): 3 / (2 (2 + g^2)) times the moment of
// (1 + mu^2) p_HG, by the recurrence of mu^2 P_l. Droplets: core/scene/droplets.h.
double phase_moment(const Medium& medium, int l);

}  // namespace awan
