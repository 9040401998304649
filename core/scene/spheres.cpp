#include "core/scene/spheres.h"

#include <algorithm>

namespace awan {

template <>
const Table& table_of<SpheresCloud>() {
    return kSpheresTable;
}

Span ratios_of(const SpheresCloud& cloud) {
    const bool cumulus = cloud.kind == SpheresKind::kCumulus;
    return {cloud.ratio_min.value_or(cumulus ? 0.26 : 0.2),
            cloud.ratio_max.value_or(cumulus ? 0.76 : 0.7)};
}

Span shifts_of(const SpheresCloud& cloud) {
    const bool cumulus = cloud.kind == SpheresKind::kCumulus;
    return {cloud.shift_min.value_or(cumulus ? 0.9 : 0.5), cloud.shift_max.value_or(1.0)};
}

std::uint64_t most_particles(const SpheresCloud& cloud) {
    std::uint64_t leaves = 1;
    for (std::uint64_t k = 0; k < cloud.levels && leaves < limits::kMaxSpheresParticles; ++k)
        leaves *= cloud.parts;
    return std::min(leaves, limits::kMaxSpheresParticles);
}

}  // namespace awan
