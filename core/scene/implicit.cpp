#include "core/scene/implicit.h"

#include <algorithm>

namespace awan {

template <>
const Table& table_of<ImplicitCloud>() {
    return kImplicitTable;
}

bool makes_primitives(const ImplicitCloud& cloud) {
    return cloud.growth || cloud.bubbles || cloud.billows || cloud.cells ||
           !cloud.particles.empty();
}

ImplicitCloud spelled_out(const ImplicitCloud& cloud) {
    const ImplicitSettings s = resolved(cloud);
    ImplicitCloud all = cloud;
    all.primitives = s.primitives;
    all.base = s.base;
    all.amount = s.amount;
    all.exponent = s.exponent;
    all.blend = s.blend;
    all.displacement = s.displacement;
    all.noise_size = s.noise_size;
    all.octaves = s.octaves;
    all.gain = s.gain;
    all.stretch = s.stretch;
    all.jet = s.jet;
    all.jet_turbulence = s.jet_turbulence;
    all.ripple = s.ripple;
    all.ripple_depth = s.ripple_depth;
    all.ripple_turbulence = s.ripple_turbulence;
    return all;
}

std::uint64_t most_particles(const ImplicitCloud& cloud) {
    const std::uint64_t n = std::min(cloud.resolution, limits::kMaxImplicitResolution);
    return std::min(n * n * n, limits::kMaxImplicitCells);
}

}  // namespace awan
