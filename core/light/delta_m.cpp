#include "core/light/delta_m.h"

#include "core/light/legendre.h"

namespace awan {

ScatteringSplit split_scattering(const Medium& medium) {
    ScatteringSplit split;
    split.albedo = medium.albedo;
    const double f = asymmetry(medium) > 0 ? phase_moment(medium, kOrders) : 0;
    split.peak_share = f;
    for (std::size_t l = 0; l < kOrders; ++l)
        split.moment[l] = (phase_moment(medium, static_cast<int>(l)) - f) / (1 - f);
    const bool isotropic = medium.g == 0 && medium.phase == PhaseFunction::kHenyeyGreenstein;
    split.harmonics = isotropic ? 1 : kHarmonics;
    return split;
}

double peak_turning(const Medium& medium) {
    if (!medium.droplets) return medium.g;
    return phase_moment(medium, kOrders + 1) / phase_moment(medium, kOrders);
}

}  // namespace awan
