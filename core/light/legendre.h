// Legendre moments of the phase functions.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace awan {

// chi_l, l = 0..highest, of p(cos) = sum (2l+1) chi_l P_l(cos): chi_0 = 1, chi_1 = the mean cosine.
// Henyey-Greenstein: g^l. Cornette-Shanks: that times 3/2 (1 + cos^2) / (2 + g^2), by the recurrence of cos P_l.
std::vector<double> legendre_moments(const Medium& medium, int highest);

}  // namespace awan
