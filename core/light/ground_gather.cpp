#include "core/light/ground_gather.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/survey/lattice.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

using std::numbers::pi;

constexpr int kSide = 33;            // nodes
constexpr double kOpaque = 12;       // scaled optical depth behind which nothing is seen
constexpr double kParallel = 1e-12;  // a direction's component that counts as 0

std::size_t cell_index(const glm::ivec3& n, const glm::ivec3& c) {
    return (static_cast<std::size_t>(c.z) * static_cast<std::size_t>(n.y) +
            static_cast<std::size_t>(c.y)) *
               static_cast<std::size_t>(n.x) +
           static_cast<std::size_t>(c.x);
}

// Point i of a golden-angle spiral: even in height and in turn. along: 0..1.
struct Spiral {
    double along, turn;
};
Spiral spiral(int i, int count) {
    return {(i + 0.5) / count, i * pi * (3 - std::sqrt(5.0))};
}

// Sides of a cell in units of the shortest.
glm::dvec3 sides_of(const CloudAbove& cloud) {
    return cloud.cell / shortest(cloud.cell);
}

// What is seen from a point in a direction: the cloud's light, and the share that comes through of what is behind it.
struct Seen {
    glm::dvec3 light{0};
    double through = 1;
};

// The part of the ray p + t d (cells) that lies in the cloud's box; enter >= leave: none.
struct Crossing {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
};
Crossing cross_box(const glm::ivec3& cells, const glm::dvec3& p, const glm::dvec3& d) {
    Crossing crossing;
    for (int a = 0; a < 3; ++a) {
        if (std::abs(d[a]) < kParallel) {
            if (p[a] < 0 || p[a] > cells[a]) return {0, 0};
            continue;
        }
        const double t0 = -p[a] / d[a], t1 = (cells[a] - p[a]) / d[a];
        crossing.enter = std::max(crossing.enter, std::min(t0, t1));
        crossing.leave = std::min(crossing.leave, std::max(t0, t1));
    }
    return crossing;
}

// A walk from cell to cell along a ray (Amanatides & Woo 1987).
class CellWalk {
  public:
    CellWalk(const glm::ivec3& cells, const glm::dvec3& p, const glm::dvec3& d, double enter)
        : cells_(cells) {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        for (int a = 0; a < 3; ++a) {
            const bool parallel = std::abs(d[a]) < kParallel;
            at_[a] = std::clamp(static_cast<int>(std::floor(p[a] + enter * d[a])), 0, cells[a] - 1);
            way_[a] = d[a] > 0 ? 1 : -1;
            per_[a] = parallel ? kNever : 1 / std::abs(d[a]);
            next_[a] = parallel ? kNever : (at_[a] + (d[a] > 0 ? 1 : 0) - p[a]) / d[a];
        }
    }
    std::size_t cell() const { return cell_index(cells_, at_); }
    // Where the ray leaves the cell.
    double until() const { return next_[axis()]; }
    // On to the next cell; false: the ray leaves the box.
    bool step() {
        const int a = axis();
        at_[a] += way_[a];
        if (at_[a] < 0 || at_[a] >= cells_[a]) return false;
        next_[a] += per_[a];
        return true;
    }

  private:
    // Across which the ray leaves the cell.
    int axis() const {
        return next_.x <= next_.y ? (next_.x <= next_.z ? 0 : 2) : (next_.y <= next_.z ? 1 : 2);
    }
    glm::ivec3 cells_, at_{0}, way_{0};
    glm::dvec3 next_{0}, per_{0};
};

// From p (cells) in direction d (unit, in true proportions). Ways are counted in the cells' shortest sides. With x the
// scaled depth of the way through a cell and `scaled` k, the cell adds its source times (1 - exp(-x)) / k, dimmed by
// the cells before it.
Seen look(const CloudAbove& cloud, const glm::dvec3& p, const glm::dvec3& d) {
    Seen seen;
    const glm::dvec3 in_cells = d / sides_of(cloud);
    const Crossing crossing = cross_box(cloud.cells, p, in_cells);
    if (!(crossing.enter < crossing.leave)) return seen;
    const std::array<double, kHarmonics> y = harmonics(-d);
    std::array<float, kHarmonics> towards{};
    for (std::size_t i = 0; i < kHarmonics; ++i) towards[i] = static_cast<float>(y[i]);

    CellWalk walk(cloud.cells, p, in_cells, crossing.enter);
    double depth = 0;
    for (double t = crossing.enter; t < crossing.leave && depth < kOpaque;) {
        const double until = std::min(walk.until(), crossing.leave);
        const std::size_t cell = walk.cell();
        const double passed =
            std::max(until - t, 0.0) * static_cast<double>(cloud.depth[cell]) * cloud.scaled;
        if (passed > 0) {
            const double weight = exact::exp(-depth) * -exact::expm1(-passed) / cloud.scaled;
            const float* const source = cloud.source[cell].data();
            // Side by side: no sum waits for another.
            float red = 0, green = 0, blue = 0;
            for (std::size_t i = 0; i < kHarmonics; ++i) {
                red += source[i] * towards[i];
                green += source[kHarmonics + i] * towards[i];
                blue += source[2 * kHarmonics + i] * towards[i];
            }
            seen.light +=
                weight * glm::dvec3(std::max(red, 0.F), std::max(green, 0.F), std::max(blue, 0.F));
            depth += passed;
        }
        t = until;
        if (!walk.step()) break;
    }
    seen.through = exact::exp(-depth);
    return seen;
}

// The irradiance that the cloud adds at p, a place on the ground in cells, less what it hides of the sky. Rays are
// spent where the cloud is. Divided by the half sides of its box, the cloud lies in a ball of radius sqrt(3), and rays
// are spread evenly over the cone around that ball. Back in true proportions a direction d of the scaled space stands
// for its solid angle times (product of the half sides) / |half sides * d|^3. From within or near the ball: over the
// whole upper half of the sphere, by cosine.
glm::dvec3 gathered(const CloudAbove& cloud, const SkyDome* sky, const glm::dvec3& p, int rays) {
    const glm::dvec3 middle = 0.5 * glm::dvec3(cloud.cells), half = middle * sides_of(cloud);
    const glm::dvec3 to = (middle - p) / middle;
    const double distance = glm::length(to), radius = std::numbers::sqrt3;
    const bool cone = distance > 1.05 * radius;
    const double cosine = cone ? std::sqrt(1 - radius * radius / (distance * distance)) : 0;
    const glm::dvec3 axis = cone ? to / distance : glm::dvec3(0, 1, 0);
    const SideAxes side = side_axes(axis);
    glm::dvec3 sum(0);
    for (int i = 0; i < rays; ++i) {
        const Spiral s = spiral(i, rays);
        glm::dvec3 d;
        double weight = pi / rays;  // cosine * solid angle
        if (cone) {
            const double along = 1 - s.along * (1 - cosine), flat = std::sqrt(1 - along * along);
            const glm::dvec3 scaled = along * axis + flat * exact::cos(s.turn) * side.u +
                                      flat * exact::sin(s.turn) * side.v;
            d = half * scaled;
            const double length = glm::length(d);
            d /= length;
            if (!(d.y > 0)) continue;
            weight = 2 * pi * (1 - cosine) / rays * half.x * half.y * half.z /
                     (length * length * length) * d.y;
        } else {
            const double flat = std::sqrt(s.along);
            d = {flat * exact::cos(s.turn), std::sqrt(1 - s.along), flat * exact::sin(s.turn)};
        }
        const Seen seen = look(cloud, p, d);
        if (seen.through == 1) continue;
        sum += weight * seen.light;
        if (sky != nullptr) sum -= weight * (1 - seen.through) * sky_radiance(*sky, d);
    }
    return sum;
}

}  // namespace

CloudAbove coarser(CloudAbove cloud, int most) {
    const int longest = std::max({cloud.cells.x, cloud.cells.y, cloud.cells.z});
    const int by = (longest + most - 1) / most;
    if (by <= 1) return cloud;
    CloudAbove made;
    made.origin = cloud.origin;
    made.cell = cloud.cell * static_cast<double>(by);
    made.cells = (cloud.cells + by - 1) / by;
    made.scaled = cloud.scaled;
    const auto count = static_cast<std::size_t>(made.cells.x * made.cells.y * made.cells.z);
    made.depth.assign(count, 0.F);
    made.source.assign(count, {});
    // Depth times source adds up; a block's depth is the mean of its cells', over a longer side.
    for (int z = 0; z < cloud.cells.z; ++z)
        for (int y = 0; y < cloud.cells.y; ++y)
            for (int x = 0; x < cloud.cells.x; ++x) {
                const glm::ivec3 c(x, y, z);
                const std::size_t from = cell_index(cloud.cells, c),
                                  to = cell_index(made.cells, c / by);
                made.depth[to] += cloud.depth[from];
                for (std::size_t i = 0; i < made.source[to].size(); ++i)
                    made.source[to][i] += cloud.depth[from] * cloud.source[from][i];
            }
    for (std::size_t i = 0; i < count; ++i) {
        if (!(made.depth[i] > 0)) continue;
        for (float& one : made.source[i]) one /= made.depth[i];
        made.depth[i] /= static_cast<float>(by * by);
    }
    return made;
}

GroundChange nodes_under(const CloudAbove& cloud, double height) {
    GroundChange change;
    const glm::dvec3 size = cloud.cell * glm::dvec3(cloud.cells);
    const glm::dvec3 middle = cloud.origin + 0.5 * size;
    const double above = std::max(middle.y - height, 0.0);
    change.center = {middle.x, middle.z};
    change.reach = 0.5 * glm::dvec2(size.x, size.z) + 0.5 * above;
    change.side = kSide;
    change.irradiance.assign(static_cast<std::size_t>(kSide * kSide), {});
    return change;
}

void gather(const CloudAbove& cloud, const SkyDome* sky, double height, int rays, int threads,
            GroundChange& change) {
    const auto place = [&](int node) {
        const double t = 2.0 * node / (kSide - 1) - 1;
        return t / (1 - std::abs(t));
    };
    parallel_for(threads, kSide - 2, [&](std::size_t inner) {
        const int j = static_cast<int>(inner) + 1;
        for (int i = 1; i < kSide - 1; ++i) {
            const glm::dvec2 at = change.center + change.reach * glm::dvec2(place(i), place(j));
            const glm::dvec3 p = (glm::dvec3(at.x, height, at.y) - cloud.origin) / cloud.cell;
            const glm::dvec3 sum = gathered(cloud, sky, p, rays);
            std::array<float, 3>& to = change.irradiance[static_cast<std::size_t>(j * kSide + i)];
            for (std::size_t c = 0; c < 3; ++c)
                to[c] += static_cast<float>(sum[static_cast<int>(c)]);
        }
    });
}

}  // namespace awan
