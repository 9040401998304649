// Values and samples of the phase function of droplets (core/scene/droplets.h) for paths of light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/droplets.h"

namespace awan::truth {

// p between nodes of w: 1 - cosine on the first half, 1 + cosine on the second. Interval k of the first half lies
// between nodes k and k + 1, interval k of the second is number `half` + k.
struct DropletLaw {
    explicit DropletLaw(const DropletPhase& phase);

    std::size_t half = 0;  // intervals of either half of the sphere
    // The nodes are where the bits of the float 1 + w stretch, shifted down by `shift`, change.
    float stretch = 1;
    int shift = 0;
    std::vector<float> from, width;     // w, of an interval
    std::vector<float> p_from, p_rise;  // p at `from`, and by how much it is more at the other end
    // Intervals by their light: number i is kept with the chance keep[i], else it is other[i] (Walker 1977).
    std::vector<float> keep;
    std::vector<std::uint32_t> other;
};

// p where w is 1 -+ cosine (whichever is less) of the half that `behind` says.
double value(const DropletLaw& law, double w, bool behind);

}  // namespace awan::truth
