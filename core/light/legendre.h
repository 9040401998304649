#pragma once

#include "core/scene/scene.h"

namespace awan {

// Legendre moment chi_l of the phase function: p(mu) = sum (2l + 1) chi_l P_l(mu); chi_0 = 1, chi_1 = the mean cosine.
// Henyey-Greenstein: g^l. Cornette-Shanks: 3 / (2 (2 + g^2)) times that of (1 + mu^2) HG. l >= 0.
double phase_moment(const Medium& medium, int l);

}  // namespace awan
