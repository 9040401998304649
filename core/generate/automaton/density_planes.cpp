#include "core/generate/automaton/density_planes.h"

#include "core/generate/automaton/shape.h"

namespace awan::automaton {

SummedPlanes::SummedPlanes(const AutomatonCloud& cloud, const AutomatonGrid& grid,
                           const std::vector<CloudBits>& fields) {
    const auto weights = smooth_weights(cloud);
    if (!weights[0].empty()) {
        weighted_.emplace(grid, fields, weights);
        return;
    }
    even_.emplace(grid, fields,
                  std::array{static_cast<std::size_t>(cloud.smooth.x),
                             static_cast<std::size_t>(cloud.smooth.y),
                             static_cast<std::size_t>(cloud.smooth.z)});
}

DensityPlanes::DensityPlanes(const AutomatonCloud& cloud, const AutomatonGrid& grid,
                             const CellDensity& density)
    : now_(cloud, grid, density.now), share_(density.share_of_next), scale_(1 / now_.most()) {
    if (!density.next.empty() && share_ > 0) next_.emplace(cloud, grid, density.next);
}

}  // namespace awan::automaton
