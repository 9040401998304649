#include "core/light/legendre.h"

#include <cmath>
#include <cstddef>

#include "core/base/exact_math.h"

namespace awan {

double phase_moment(const Medium& medium, int l) {
    if (medium.droplets) {
        const auto& moments = medium.droplets->moment;
        return static_cast<std::size_t>(l) < moments.size() ? moments[static_cast<std::size_t>(l)]
                                                            : 0;
    }
    const double g = medium.g;
    if (l == 0) return 1;
    const auto power = [&](int n) { return n == 0 ? 1.0 : g == 0 ? 0.0 : exact::pow(g, n); };
    if (medium.phase == PhaseFunction::kHenyeyGreenstein) return power(l);
    // mu^2 P_l by the recurrence (2l + 1) mu P_l = (l + 1) P_l+1 + l P_l-1, twice.
    const double n = l;
    double sum = power(l) + (n + 1) * (n + 2) / ((2 * n + 1) * (2 * n + 3)) * power(l + 2) +
                 (2 * n * n + 2 * n - 1) / ((2 * n - 1) * (2 * n + 3)) * power(l);
    if (l >= 2) sum += n * (n - 1) / ((2 * n - 1) * (2 * n + 1)) * power(l - 2);
    return 1.5 / (2 + g * g) * sum;
}

}  // namespace awan
