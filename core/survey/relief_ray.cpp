#include "core/survey/relief_ray.h"

#include <algorithm>
#include <cmath>

namespace awan {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The ray in the relief's own units: cells along x and z, heights above the base.
struct InCells {
    double x, z, dx, dz;
    double y, dy;
};

// The part of the ray that is over the relief and not above its tops; from >= to: none.
struct HillSpan {
    double from, to;
};
HillSpan over_hills(const Relief& relief, const InCells& ray, double to) {
    HillSpan span{0, to};
    const auto clip = [&](double at, double by, double low, double high) {
        if (by == 0) {
            if (!(at >= low && at <= high)) span.to = -1;
            return;
        }
        const double a = (low - at) / by, b = (high - at) / by;
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    };
    clip(ray.x, ray.dx, 0, relief.cells.x);
    clip(ray.z, ray.dz, 0, relief.cells.y);
    // Whoever is above all tops meets nothing; below the base there is nothing.
    clip(ray.y, ray.dy, -1e-9 * relief.highest, relief.highest);
    return span;
}

// The ray over one cell, t from `from` to `to`: height above the surface is c0 + c1 s + c2 s^2, s = t - from.
struct OverCell {
    double c0, c1, c2;
    double at(double s) const { return c0 + s * (c1 + s * c2); }
};
OverCell over_cell(const Relief& relief, const InCells& ray, int x, int z, double from) {
    const double a = static_cast<double>(relief.node(x, z)),
                 b = static_cast<double>(relief.node(x + 1, z)) - a,
                 c = static_cast<double>(relief.node(x, z + 1)) - a,
                 e = static_cast<double>(relief.node(x + 1, z + 1)) - a - b - c;
    const double u = ray.x + from * ray.dx - x, v = ray.z + from * ray.dz - z;
    return {ray.y + from * ray.dy - (a + b * u + c * v + e * u * v),
            ray.dy - (b * ray.dx + c * ray.dz + e * (u * ray.dz + v * ray.dx)),
            -e * ray.dx * ray.dz};
}

// Where it comes from above to below between s0 (above or on it) and s1 (below), by bisection and Newton's method.
double crossing(const OverCell& over, double s0, double s1) {
    double s = 0.5 * (s0 + s1);
    for (int i = 0; i < 40 && s1 - s0 > 1e-15 * std::abs(s1); ++i) {
        const double here = over.at(s);
        (here >= 0 ? s0 : s1) = s;
        const double slope = over.c1 + 2 * s * over.c2;
        const double next = s - here / slope;
        s = slope < 0 && next > s0 && next < s1 ? next : 0.5 * (s0 + s1);
    }
    return s;
}

}  // namespace

double hills_ahead(const Relief& relief, const glm::dvec3& o, const glm::dvec3& d, double to) {
    const InCells ray{(o.x - relief.low.x) / relief.cell.x,
                      (o.z - relief.low.y) / relief.cell.y,
                      d.x / relief.cell.x,
                      d.z / relief.cell.y,
                      o.y - relief.base,
                      d.y};
    const HillSpan span = over_hills(relief, ray, to);
    if (!(span.from < span.to)) return kNever;
    const auto top = static_cast<int>(relief.levels.size()) - 1;
    const auto cell_at = [](double at, int cells) {
        return std::clamp(static_cast<int>(std::floor(at)), 0, cells - 1);
    };
    int x = cell_at(ray.x + span.from * ray.dx, relief.cells.x),
        z = cell_at(ray.z + span.from * ray.dz, relief.cells.y);
    double t = span.from;
    // Whether the ray was above the surface so far; a ray that comes in from aside or from above is.
    bool above =
        t > 0 ? ray.dy < 0 || ray.y + t * ray.dy >= 0 : ray.y >= height_at(relief, o.x, o.z);
    for (int level = std::min(top, 5); t < span.to;) {
        const int bx = x >> level, bz = z >> level;
        // The block's far sides along the ray.
        const double next_x = ray.dx > 0   ? (((bx + 1) << level) - ray.x) / ray.dx
                              : ray.dx < 0 ? ((bx << level) - ray.x) / ray.dx
                                           : kNever;
        const double next_z = ray.dz > 0   ? (((bz + 1) << level) - ray.z) / ray.dz
                              : ray.dz < 0 ? ((bz << level) - ray.z) / ray.dz
                                           : kNever;
        const double leave = std::max(std::min({next_x, next_z, span.to}), t);
        const double lowest = ray.y + ray.dy * (ray.dy < 0 ? leave : t);
        const Relief::Level& blocks = relief.levels[static_cast<std::size_t>(level)];
        const auto highest = static_cast<double>(
            blocks
                .highest[static_cast<std::size_t>(bz) * static_cast<std::size_t>(blocks.blocks.x) +
                         static_cast<std::size_t>(bx)]);
        if (lowest > highest) {
            above = true;
        } else if (level > 0) {
            --level;
            continue;
        } else {
            const OverCell over = over_cell(relief, ray, x, z, t);
            const double last = leave - t, first = over.c0, end = over.at(last);
            const double turn = over.c2 != 0 ? -over.c1 / (2 * over.c2) : -1;
            const bool turns = turn > 0 && turn < last;
            if (above && first < 0) return t;
            above = first >= 0;
            if (turns && above != (over.at(turn) >= 0)) {
                if (above) return t + crossing(over, 0, turn);
                above = true;
                if (end < 0) return t + crossing(over, turn, last);
            } else if (above && end < 0) {
                return t + crossing(over, turns ? turn : 0, last);
            }
            above = end >= 0;
        }
        if (!(leave < span.to)) break;
        // On to the next block: across one of its sides for certain, along the other as far as the ray goes.
        if (next_x <= next_z) {
            x = ray.dx > 0 ? (bx + 1) << level : (bx << level) - 1;
            z = std::clamp(cell_at(ray.z + leave * ray.dz, relief.cells.y), bz << level,
                           ((bz + 1) << level) - 1);
        } else {
            z = ray.dz > 0 ? (bz + 1) << level : (bz << level) - 1;
            x = std::clamp(cell_at(ray.x + leave * ray.dx, relief.cells.x), bx << level,
                           ((bx + 1) << level) - 1);
        }
        if (x < 0 || z < 0 || x >= relief.cells.x || z >= relief.cells.y) break;
        t = leave;
        level = std::min(level + 1, top);
    }
    return kNever;
}

double ground_ahead(const Relief& relief, const glm::dvec3& o, const glm::dvec3& d) {
    double plane = kNever;
    if (d.y < 0 && o.y > relief.base) {
        plane = (relief.base - o.y) / d.y;
        const double x = o.x + plane * d.x, z = o.z + plane * d.z;
        const glm::dvec2 high = relief.high();
        // Where the hills are there is no plane.
        if (x > relief.low.x && z > relief.low.y && x < high.x && z < high.y) plane = kNever;
    }
    return std::min(plane, hills_ahead(relief, o, d));
}

glm::dvec3 lifted(const Relief& relief, const glm::dvec3& place) {
    const double over = relief.base + height_at(relief, place.x, place.z);
    const double by = 1e-9 * (std::abs(place.y) + relief.highest) + 1e-6 * relief.cell.x;
    return {place.x, std::max(place.y, over) + by, place.z};
}

}  // namespace awan
