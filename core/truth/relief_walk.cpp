#include "core/truth/relief_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace awan::truth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Surface minus ray over one cell, as its values at three distances make a parabola: first, middle and last.
struct Gap {
    double first, middle, last;
};

double gap_at(const Relief& relief, const glm::dvec3& o, const glm::dvec3& d, int x, int z,
              double t) {
    const double u = (o.x + t * d.x - relief.low.x) / relief.cell.x - x;
    const double v = (o.z + t * d.z - relief.low.y) / relief.cell.y - z;
    const double h00 = static_cast<double>(relief.node(x, z)),
                 h10 = static_cast<double>(relief.node(x + 1, z)),
                 h01 = static_cast<double>(relief.node(x, z + 1)),
                 h11 = static_cast<double>(relief.node(x + 1, z + 1));
    return (1 - u) * (1 - v) * h00 + u * (1 - v) * h10 + (1 - u) * v * h01 + u * v * h11 -
           (o.y + t * d.y - relief.base);
}

// The least s in 0..1 from which a parabola through those three values is above 0 after it was below; infinite: none.
double first_rise(const Gap& gap, bool& outside) {
    const double c = gap.first, a = 2 * (gap.first + gap.last - 2 * gap.middle),
                 b = gap.last - gap.first - a;
    if (outside && c > 0) {
        outside = false;
        return 0;
    }
    outside = c <= 0;
    // Its roots, the one that cancels nothing first.
    double roots[2] = {kInfinity, kInfinity};
    const double under = b * b - 4 * a * c;
    if (under >= 0) {
        const double q = -0.5 * (b + (b < 0 ? -std::sqrt(under) : std::sqrt(under)));
        roots[0] = a != 0 ? q / a : kInfinity;
        roots[1] = q != 0 ? c / q : kInfinity;
        if (roots[1] < roots[0]) std::swap(roots[0], roots[1]);
    }
    for (const double s : roots) {
        if (!(s > 0 && s <= 1)) continue;
        const double rises = 2 * a * s + b;
        if (outside && rises > 0) {
            outside = false;
            return s;
        }
        if (!outside && rises < 0) outside = true;
    }
    if (outside && gap.last > 0) {  // by rounding
        outside = false;
        return 1;
    }
    outside = gap.last <= 0;
    return kInfinity;
}

// From cell to cell, blocks first. Infinite: no hill.
double hill_ahead(const ReliefWalk& walk, const glm::dvec3& o, const glm::dvec3& d) {
    const Relief& relief = *walk.relief;
    const double height = o.y - relief.base;
    double from = 0, to = kInfinity;
    const auto keep = [&](double at, double by, double low, double high) {
        if (by == 0) {
            if (at < low || at > high) to = -1;
            return;
        }
        const double one = (low - at) / by, other = (high - at) / by;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    };
    const glm::dvec2 high = relief.high();
    keep(o.x, d.x, relief.low.x, high.x);
    keep(o.z, d.z, relief.low.y, high.y);
    keep(height, d.y, 0, relief.highest);
    if (!(from < to)) return kInfinity;
    // A ray that begins below the surface, or comes up through the level ground, is not outside of the hills.
    bool outside = from > 0 ? d.y < 0 || height + from * d.y > 1e-12 * relief.highest
                            : height >= height_at(relief, o.x, o.z);
    glm::ivec2 at;
    double next[2], per[2];
    int way[2];
    for (int a = 0; a < 2; ++a) {
        const double begin = a == 0 ? o.x : o.z, by = a == 0 ? d.x : d.z;
        const double place = (begin + from * by - relief.low[a]) / relief.cell[a];
        at[a] = std::clamp(static_cast<int>(std::floor(place)), 0, relief.cells[a] - 1);
        way[a] = by > 0 ? 1 : -1;
        per[a] = by != 0 ? relief.cell[a] / std::abs(by) : kInfinity;
        next[a] = by != 0
                      ? (relief.low[a] + (at[a] + (by > 0 ? 1 : 0)) * relief.cell[a] - begin) / by
                      : kInfinity;
    }
    for (double t = from; t < to;) {
        const glm::ivec2 block = at / kReliefBlock;
        const double top =
            walk.tops[static_cast<std::size_t>(block.y) * static_cast<std::size_t>(walk.blocks.x) +
                      static_cast<std::size_t>(block.x)];
        // As many cells as lie in the block.
        do {
            const double leave = std::max(std::min({next[0], next[1], to}), t);
            const double low = height + d.y * (d.y < 0 ? leave : t);
            if (low > top) {
                outside = true;
            } else {
                const Gap gap{gap_at(relief, o, d, at.x, at.y, t),
                              gap_at(relief, o, d, at.x, at.y, 0.5 * (t + leave)),
                              gap_at(relief, o, d, at.x, at.y, leave)};
                const double s = first_rise(gap, outside);
                if (std::isfinite(s)) return t + s * (leave - t);
            }
            t = leave;
            if (!(t < to)) return kInfinity;
            const int a = next[0] <= next[1] ? 0 : 1;
            at[a] += way[a];
            if (at[a] < 0 || at[a] >= relief.cells[a]) return kInfinity;
            next[a] += per[a];
        } while (at / kReliefBlock == block);
    }
    return kInfinity;
}

}  // namespace

std::optional<ReliefWalk> relief_walk_of(const Scene& scene, int threads) {
    ReliefWalk walk;
    walk.relief = relief_of(*scene, threads);
    if (!walk.relief) return std::nullopt;
    const Relief& relief = *walk.relief;
    walk.blocks = (relief.cells + kReliefBlock - 1) / kReliefBlock;
    walk.tops.assign(
        static_cast<std::size_t>(walk.blocks.x) * static_cast<std::size_t>(walk.blocks.y), 0);
    for (int z = 0; z <= relief.cells.y; ++z)
        for (int x = 0; x <= relief.cells.x; ++x)
            // Nodes between blocks belong to both.
            for (int j = std::max(z - 1, 0) / kReliefBlock;
                 j <= std::min(z, relief.cells.y - 1) / kReliefBlock; ++j)
                for (int i = std::max(x - 1, 0) / kReliefBlock;
                     i <= std::min(x, relief.cells.x - 1) / kReliefBlock; ++i) {
                    double& top = walk.tops[static_cast<std::size_t>(j) *
                                                static_cast<std::size_t>(walk.blocks.x) +
                                            static_cast<std::size_t>(i)];
                    top = std::max(top, static_cast<double>(relief.node(x, z)));
                }
    return walk;
}

double ground_ahead(const ReliefWalk& walk, const glm::dvec3& o, const glm::dvec3& d) {
    const Relief& relief = *walk.relief;
    const double hill = hill_ahead(walk, o, d);
    if (!(d.y < 0) || o.y <= relief.base) return hill;
    const double level = (o.y - relief.base) / -d.y;
    const double x = o.x + level * d.x, z = o.z + level * d.z;
    const glm::dvec2 high = relief.high();
    const bool beside = x <= relief.low.x || z <= relief.low.y || x >= high.x || z >= high.y;
    return beside ? std::min(hill, level) : hill;
}

bool hills_before(const ReliefWalk& walk, const glm::dvec3& o, const glm::dvec3& d) {
    return std::isfinite(hill_ahead(walk, o, d));
}

glm::dvec3 above_ground(const ReliefWalk& walk, const glm::dvec3& place) {
    const Relief& relief = *walk.relief;
    const double surface = relief.base + height_at(relief, place.x, place.z);
    return {place.x,
            std::max(place.y, surface) + 1e-9 * (std::abs(place.y) + relief.highest) +
                1e-6 * relief.cell.x,
            place.z};
}

glm::dvec3 scattered_off(const glm::dvec3& normal, PathRandom& random) {
    const glm::dvec3 aside = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, aside)), v = glm::cross(normal, u);
    for (int draw = 0; draw < 128; ++draw) {
        const PathRandom::Pair q = random.signed_pair();
        const double r2 = q.a * q.a + q.b * q.b;
        if (r2 < 1) return q.a * u + q.b * v + std::sqrt(1 - r2) * normal;
    }
    return normal;
}

}  // namespace awan::truth
