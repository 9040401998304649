#include "core/survey/islands.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

#include "core/generate/gaussian.h"

namespace awan {
namespace {

constexpr double kBoxReach = 2.5;   // of a particle's box, in s
constexpr double kIslandReach = 4;  // of what an island holds, in s
// Optical depth of a cell that counts as empty.
constexpr double kEmpty = 1e-3;
// Of one particle in a cell: keeps the sums' digits.
constexpr double kMostDepth = 1e3;
// That find whether there is any use.
constexpr double kQuickCells = 64e3;
constexpr int kFineCells = 200;  // along the longest side
constexpr double kMostCells = 1e6;
// Cells; a smaller part is not cut again.
constexpr int kLeastSide = 4;

struct Box {
    glm::ivec3 low, high;  // cells, both included
};

// Optical depth of each cell along its side.
struct Volume {
    glm::dvec3 origin{0};
    double cell = 1;
    glm::ivec3 n{0};
    std::vector<float> depth;

    std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(n.x) +
               static_cast<std::size_t>(i);
    }
};

// Each particle is a box: eight additions to the volume's differences, however large it is.
Volume volume_of(const ParticleSet& particles, double most_cells) {
    Volume volume;
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 reach(kBoxReach * gaussian_s(particles, i));
        low = glm::min(low, particles.center[i] - reach);
        high = glm::max(high, particles.center[i] + reach);
    }
    const glm::dvec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z, 1e-9});
    volume.origin = low;
    int count = kFineCells;
    for (;; count = count * 9 / 10) {
        volume.cell = longest / count;
        const glm::dvec3 n = glm::ceil(size / volume.cell);
        volume.n = glm::clamp(glm::ivec3(n), glm::ivec3(1), glm::ivec3(count));
        if (n.x * n.y * n.z <= most_cells || count <= 16) break;
    }
    // Differences need one more on each side.
    Volume edges = volume;
    edges.n += 1;
    std::vector<double> sum(static_cast<std::size_t>(edges.n.x) *
                            static_cast<std::size_t>(edges.n.y) *
                            static_cast<std::size_t>(edges.n.z));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i), mass = gaussian_mass(particles, i);
        if (!(mass > 0)) continue;
        const glm::dvec3 place = (particles.center[i] - volume.origin) / volume.cell;
        const double reach = kBoxReach * s / volume.cell;
        const glm::ivec3 a =
            glm::clamp(glm::ivec3(glm::floor(place - reach)), glm::ivec3(0), volume.n - 1);
        const glm::ivec3 b = glm::clamp(glm::ivec3(glm::floor(place + reach)), a, volume.n - 1) + 1;
        const glm::dvec3 cells(b - a);
        const double value =
            std::min(mass / (volume.cell * volume.cell * cells.x * cells.y * cells.z), kMostDepth);
        for (int corner = 0; corner < 8; ++corner) {
            const bool x = corner & 1, y = corner & 2, z = corner & 4;
            sum[edges.at(x ? b.x : a.x, y ? b.y : a.y, z ? b.z : a.z)] +=
                (x != y) != z ? -value : value;
        }
    }
    volume.depth.resize(static_cast<std::size_t>(volume.n.x) *
                        static_cast<std::size_t>(volume.n.y) *
                        static_cast<std::size_t>(volume.n.z));
    for (int k = 0; k < volume.n.z; ++k)
        for (int j = 0; j < volume.n.y; ++j) {
            double along = 0;
            for (int i = 0; i < volume.n.x; ++i) {
                along += sum[edges.at(i, j, k)];
                double& here = sum[edges.at(i, j, k)];
                here = along;
                if (j > 0) here += sum[edges.at(i, j - 1, k)];
            }
        }
    for (int k = 0; k < volume.n.z; ++k)
        for (int j = 0; j < volume.n.y; ++j)
            for (int i = 0; i < volume.n.x; ++i) {
                double& here = sum[edges.at(i, j, k)];
                if (k > 0) here += sum[edges.at(i, j, k - 1)];
                volume.depth[volume.at(i, j, k)] = static_cast<float>(std::max(here, 0.0));
            }
    return volume;
}

// The longest line in each plane across each axis, and in all of the box.
struct Planes {
    std::array<std::vector<float>, 3> depth;
    float most = 0;
};

Planes planes_of(const Volume& volume, const Box& box) {
    const glm::ivec3 n = box.high - box.low + 1;
    Planes planes;
    for (int axis = 0; axis < 3; ++axis)
        planes.depth[static_cast<std::size_t>(axis)].assign(static_cast<std::size_t>(n[axis]), 0.F);
    const auto nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y);
    std::vector<float> along_z(nx * ny), along_y(nx);
    const auto raise = [&](std::size_t axis, int plane, float depth) {
        float& most = planes.depth[axis][static_cast<std::size_t>(plane)];
        most = std::max(most, depth);
        planes.most = std::max(planes.most, depth);
    };
    for (int k = 0; k < n.z; ++k) {
        std::fill(along_y.begin(), along_y.end(), 0.F);
        for (int j = 0; j < n.y; ++j) {
            const float* row =
                volume.depth.data() + volume.at(box.low.x, box.low.y + j, box.low.z + k);
            float along_x = 0;
            float* const column = along_z.data() + static_cast<std::size_t>(j) * nx;
            for (std::size_t i = 0; i < nx; ++i) {
                along_x += row[i];
                along_y[i] += row[i];
                column[i] += row[i];
            }
            raise(1, j, along_x);
            raise(2, k, along_x);
        }
        for (std::size_t i = 0; i < nx; ++i) {
            raise(0, static_cast<int>(i), along_y[i]);
            raise(2, k, along_y[i]);
        }
    }
    for (int j = 0; j < n.y; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const float depth = along_z[static_cast<std::size_t>(j) * nx + i];
            raise(0, static_cast<int>(i), depth);
            raise(1, j, depth);
        }
    return planes;
}

struct Cut {
    int axis = -1;
    int after = 0;  // the last cell below it
    int width = 0;  // planes that are as good
};

// The box without its empty planes, and the middle of the widest gap in it.
Cut best_cut(const Planes& planes, Box& box) {
    Cut best;
    const Box whole = box;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<float>& depth = planes.depth[static_cast<std::size_t>(axis)];
        const auto at = [&](int plane) { return depth[static_cast<std::size_t>(plane)]; };
        int first = 0, last = static_cast<int>(depth.size()) - 1;
        while (first < last && static_cast<double>(at(first)) < kEmpty) ++first;
        while (last > first && static_cast<double>(at(last)) < kEmpty) --last;
        box.low[axis] = whole.low[axis] + first;
        box.high[axis] = whole.low[axis] + last;
        if (last - first + 1 < kLeastSide) continue;
        for (int i = first + 1; i < last;) {
            if (static_cast<double>(at(i)) > kCutDepth) {
                ++i;
                continue;
            }
            int end = i;
            float least = at(i);
            int thinnest = i;
            while (end < last && static_cast<double>(at(end)) <= kCutDepth) {
                if (at(end) < least) least = at(end), thinnest = end;
                ++end;
            }
            // A fringe is no gap: there is matter on both sides.
            float before = 0, beyond = 0;
            for (int j = first; j < i; ++j) before = std::max(before, at(j));
            for (int j = end; j <= last; ++j) beyond = std::max(beyond, at(j));
            const bool gap = static_cast<double>(std::min(before, beyond)) > kCutDepth;
            if (gap && end - i > best.width) {
                const bool empty = static_cast<double>(least) < kEmpty;
                best = {axis, whole.low[axis] + (empty ? (i + end - 1) / 2 : thinnest), end - i};
            }
            i = end;
        }
    }
    return best;
}

struct Part {
    Box box;  // of its matter
    Cut cut;  // axis -1: none
    int below = 0, above = 0;
    float depth = 0;
    double cost = 0;  // cells that it takes
};

double cells_in(const Box& box) {
    const glm::dvec3 n = glm::dvec3(box.high - box.low + 1) + 1.0;  // and a margin
    return n.x * n.y * n.z;
}

// All parts, parents first; cut as far as there are gaps.
std::vector<Part> parts_of(const Volume& volume) {
    std::vector<Part> parts(1);
    parts[0].box = {glm::ivec3(0), volume.n - 1};
    std::size_t leaves = 1;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Planes planes = planes_of(volume, parts[i].box);
        Box box = parts[i].box;
        const Cut cut = best_cut(planes, box);
        parts[i].box = box;
        parts[i].depth = planes.most;
        parts[i].cost = cells_in(box);
        if (cut.axis < 0 || leaves == kMostIslands) continue;
        ++leaves;
        parts[i].cut = cut;
        parts[i].below = static_cast<int>(parts.size());
        parts[i].above = parts[i].below + 1;
        Part below, above;
        below.box = above.box = box;
        below.box.high[cut.axis] = cut.after;
        above.box.low[cut.axis] = cut.after + 1;
        parts.push_back(below);
        parts.push_back(above);
    }
    // What does not pay is taken back, from the leaves up.
    for (std::size_t i = parts.size(); i-- > 0;) {
        Part& part = parts[i];
        if (part.cut.axis < 0) continue;
        const double pieces = parts[static_cast<std::size_t>(part.below)].cost +
                              parts[static_cast<std::size_t>(part.above)].cost;
        if (pieces <= (i == 0 ? kPays : kPartPays) * part.cost)
            part.cost = pieces;
        else
            part.cut.axis = -1;
    }
    return parts;
}

bool pays(const ParticleSet& particles, double cells, Volume& volume, std::vector<Part>& parts) {
    volume = volume_of(particles, cells);
    parts = parts_of(volume);
    return parts[0].cut.axis >= 0;
}

// A quick look at coarse cells: where matter fills the box or has no gaps at all, no cuts can pay.
bool hopeless(const ParticleSet& particles) {
    const Volume volume = volume_of(particles, kQuickCells);
    std::size_t full = 0;
    for (const float depth : volume.depth) full += static_cast<double>(depth) >= kEmpty;
    return static_cast<double>(full) > 0.6 * static_cast<double>(volume.depth.size()) ||
           parts_of(volume).size() == 1;
}

}  // namespace

Islands find_islands(const ParticleSet& particles) {
    Islands islands;
    if (particles.size() < 2 || hopeless(particles)) return islands;
    Volume volume;
    std::vector<Part> parts;
    if (!pays(particles, kMostCells, volume, parts)) return islands;

    std::vector<std::size_t> open{0};  // parts, node by node
    islands.nodes.resize(1);
    for (std::size_t node = 0; node < islands.nodes.size(); ++node) {
        const Part& part = parts[open[node]];
        if (part.cut.axis < 0) {
            islands.nodes[node] = {-1, 0, static_cast<int>(islands.list.size()), 0};
            islands.list.push_back({});
            islands.list.back().depth = static_cast<double>(part.depth);
            continue;
        }
        const auto next = static_cast<int>(islands.nodes.size());
        islands.nodes[node] = {part.cut.axis,
                               volume.origin[part.cut.axis] + (part.cut.after + 1) * volume.cell,
                               next, next + 1};
        islands.nodes.resize(islands.nodes.size() + 2);
        open.push_back(static_cast<std::size_t>(part.below));
        open.push_back(static_cast<std::size_t>(part.above));
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
        Island& island =
            islands.list[static_cast<std::size_t>(island_at(islands, particles.center[i]))];
        const double s = gaussian_s(particles, i);
        const glm::dvec3 reach(kIslandReach * s);
        const glm::dvec3 low = particles.center[i] - reach, high = particles.center[i] + reach;
        island.low = island.particles == 0 ? low : glm::min(island.low, low);
        island.high = island.particles == 0 ? high : glm::max(island.high, high);
        ++island.particles;
        double power = 1;
        for (double& sum : island.s_sums) {
            sum += power;
            power *= s;
        }
    }
    return islands;
}

int island_at(const Islands& islands, const glm::dvec3& point) {
    std::size_t node = 0;
    while (islands.nodes[node].axis >= 0) {
        const IslandNode& here = islands.nodes[node];
        node = static_cast<std::size_t>(point[here.axis] < here.cut ? here.below : here.above);
    }
    return islands.nodes[node].below;
}

IslandOnRay island_on_ray(const Islands& islands, const glm::dvec3& start,
                          const glm::dvec3& direction, double t) {
    std::size_t node = 0;
    double until = std::numeric_limits<double>::infinity();
    while (islands.nodes[node].axis >= 0) {
        const IslandNode& here = islands.nodes[node];
        const double apart = here.cut - start[here.axis], speed = direction[here.axis];
        // By the crossing alone: rounding must not put t on one side and the crossing on the other.
        bool below = apart > 0;
        if (speed != 0) {
            const double crossing = apart / speed;
            below = (speed > 0) == (t < crossing);
            if (crossing > t) until = std::min(until, crossing);
        }
        node = static_cast<std::size_t>(below ? here.below : here.above);
    }
    return {islands.nodes[node].below, until};
}

}  // namespace awan
