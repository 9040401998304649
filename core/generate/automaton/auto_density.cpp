// What a cloud grows to in the long run, from its description (core/generate/models.h).
#include <algorithm>

#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/shape.h"
#include "core/generate/models.h"

namespace awan::automaton {
namespace {

// The share of the cells along a radius that are clouds.
double mean_cover(const AutomatonCloud& cloud) {
    if (!(cloud.activation > 0) || !(cloud.humidity > 0)) return 0;
    constexpr int kPlaces = 64;
    double sum = 0;
    for (int n = 0; n < kPlaces; ++n) {
        const double f = std::clamp(
            fall_off_at(cloud.fall_off, cloud.fall_off_table, (n + 0.5) / kPlaces), 0.0, 1.0);
        const double born = cloud.humidity * f, gone = cloud.extinction * (1 - f);
        if (born > 0) sum += born / (born + gone);
    }
    return sum / kPlaces;
}

}  // namespace

double density_for_depth(const AutomatonCloud& cloud, std::uint64_t key, double depth) {
    double height = 0, count = 0;
    for (const AutomatonEllipsoid& one : first_ellipsoids(cloud, key)) {
        const double top = std::min(one.center.y + one.radii.y, cloud.cells.y);
        const double bottom = std::max({one.center.y - one.radii.y, cloud.base, 0.0});
        if (!(top > bottom)) continue;
        height += top - bottom;
        ++count;
    }
    // Over its disc an ellipsoid is two thirds as high as in its middle.
    const double cells = count > 0 ? 2.0 / 3 * height / count * mean_cover(cloud) : 0;
    return cells > 0 ? depth / (cloud.cell * cells) : 0;
}

}  // namespace awan::automaton
