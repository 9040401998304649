#include "core/light/delta_m.h"

#include "core/light/legendre.h"

namespace awan {

namespace {

// f: the peak's share.
ScatteringSplit split_by(const Medium& medium, double f) {
    ScatteringSplit split;
    split.albedo = medium.albedo;
    split.peak_share = f;
    for (std::size_t l = 0; l < kOrders; ++l)
        split.moment[l] = (phase_moment(medium, static_cast<int>(l)) - f) / (1 - f);
    const bool isotropic = medium.g == 0 && medium.phase == PhaseFunction::kHenyeyGreenstein;
    split.harmonics = isotropic ? 1 : kHarmonics;
    return split;
}

}  // namespace

ScatteringSplit split_scattering(const Medium& medium) {
    return split_by(medium, asymmetry(medium) > 0 ? phase_moment(medium, kOrders) : 0);
}

ScatteringSplit whole_scattering(const Medium& medium) {
    return split_by(medium, 0);
}

double peak_turning(const Medium& medium) {
    if (!medium.droplets) return medium.g;
    return phase_moment(medium, kOrders + 1) / phase_moment(medium, kOrders);
}

}  // namespace awan
