#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/truth/lists.h"
#include "core/truth/matter.h"
#include "core/truth/matter_columns.h"
#include "core/truth/oracles.h"

namespace awan::truth {
namespace {

// Wanted of the particles that matter, and along the longest side.
constexpr double kCellsPerS = 7;
constexpr double kMinSide = 64;
// Cells in which there is matter: 30 to 40 MB of nodes; with more, walks wait for memory, with fewer they meet looser
// majorants. Bricks of the whole box, 8 bytes each.
constexpr double kMaxCells = 1.2e6, kMaxBricks = 1.5e6;
// Nodes that particles are added to, all together: a second or two of one core.
constexpr double kMaxUpdates = 4e9;

// On a lattice a particle ripples by 1 / (4 s^2) of its peak, s in cells, and by nothing in the mean. Of those narrower
// than this the ones are listed that misplace more optical depth than kMisplaced by it, those first that misplace most,
// as many as kListedPerBrick or kFewListed entries of bricks' lists hold: every entry costs each path that comes by.
constexpr double kListedBelow = 5, kMisplaced = 0.05;
constexpr double kListedPerBrick = 0.05, kFewListed = 4e3;
// Of the largest extinction, by one particle.
constexpr double kAllowed = 0.008;
// Optical depth of a brick of such a particle's peak. With a majorant like that a walk would stop everywhere in it.
constexpr double kDense = 1000;

// Along the longest side, where the volume of matter is looked for; marks are at most so many.
constexpr int kLookSide = 128;
constexpr double kMaxMarks = 1e7;

// Everything about a particle that does not depend on the lattice. Scene units, about the cloud's centre.
struct Source {
    glm::dvec3 center;
    double s, peak, cut;
    glm::vec3 color;
};

// Beyond cut * s a particle's optical depth is below 1e-5, or 1e-5 of its own.
double cut_of(double central_depth) {
    return std::clamp(std::sqrt(2 * exact::log(1e5 * std::max(central_depth, 1.0))), 4.8, 9.0);
}

struct Box {
    glm::dvec3 low{INFINITY}, high{-INFINITY};
    void hold(const glm::dvec3& c, double reach) {
        low = glm::min(low, c - reach);
        high = glm::max(high, c + reach);
    }
    glm::dvec3 size() const { return high - low; }
    double longest() const { return std::max({size().x, size().y, size().z}); }
};

// Most of the mass is in particles wider than this.
double typical_s(const std::vector<Source>& sources) {
    std::vector<std::pair<double, double>> by_s;
    by_s.reserve(sources.size());
    double total = 0;
    for (const Source& g : sources) {
        by_s.emplace_back(g.s, g.peak * g.s * g.s * g.s);
        total += by_s.back().second;
    }
    std::sort(by_s.begin(), by_s.end());
    double below = 0;
    for (const auto& [s, mass] : by_s)
        if ((below += mass) >= 0.05 * total) return s;
    return by_s.back().first;
}

// About the largest extinction of the cloud, from below: of one particle, or the sum at some where there
// are many.
double about_largest(const std::vector<Source>& sources, const Box& box) {
    constexpr int kSide = 24;
    const double cell = box.longest() / kSide;
    std::vector<double> mass(kSide * kSide * kSide, 0.0);
    double largest = 0;
    const auto cell_of = [&](const Source& g) {
        return glm::clamp(glm::ivec3((g.center - box.low) / cell), glm::ivec3(0),
                          glm::ivec3(kSide - 1));
    };
    const auto index = [](const glm::ivec3& at) {
        return static_cast<std::size_t>(at.x + kSide * (at.y + kSide * at.z));
    };
    for (const Source& g : sources) {
        largest = std::max(largest, g.peak);
        // What a Gaussian wider than a cell leaves in it.
        const double s2 = g.s * g.s + cell * cell / (2 * std::numbers::pi);
        mass[index(cell_of(g))] += g.peak * exact::pow(g.s * g.s / s2, 1.5);
    }
    // The true value at particles of full cells.
    std::vector<std::pair<double, std::size_t>> full;
    for (std::size_t i = 0; i < sources.size(); i += sources.size() / 4096 + 1) {
        const glm::ivec3 at = cell_of(sources[i]);
        full.emplace_back(-mass[index(at)], i);
    }
    const std::size_t looks = std::min<std::size_t>(full.size(), 32);
    std::partial_sort(full.begin(), full.begin() + static_cast<std::ptrdiff_t>(looks), full.end());
    for (std::size_t k = 0; k < looks; ++k) {
        double sum = 0;
        for (const Source& g : sources) {
            const glm::dvec3 v = (g.center - sources[full[k].second].center) / g.s;
            sum += g.peak * exact::exp(-0.5 * glm::dot(v, v));
        }
        largest = std::max(largest, sum);
    }
    return largest;
}

// Cubic scene units in which there is matter, from above, by a coarse grid over the box (lattice axes).
double volume_of(const std::vector<Source>& sources, const Box& box, const glm::dmat3& axes) {
    const double cell = box.longest() / kLookSide;
    const glm::ivec3 n = glm::min(glm::ivec3(box.size() / cell) + 1, kLookSide);
    std::vector<bool> marked(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                             static_cast<std::size_t>(n.z));
    double marks = 0;
    for (const Source& g : sources)
        marks += exact::pow(std::min(2 * g.cut * g.s / cell + 1, double{kLookSide}), 3);
    // Of very many wide ones some tell as much as all.
    const auto stride = static_cast<std::size_t>(std::ceil(std::max(marks / kMaxMarks, 1.0)));
    double count = 0;
    for (std::size_t s = 0; s < sources.size(); s += stride) {
        const Source& g = sources[s];
        const glm::dvec3 c = (axes * g.center - box.low) / cell;
        // Of a cell's middle from the centre: half the cell's diagonal more than the particle reaches.
        const double reach = g.cut * g.s / cell, far = reach + 0.87;
        const auto at = [&](double sign) {
            return glm::clamp(glm::ivec3(glm::floor(c + sign * reach)), glm::ivec3(0), n - 1);
        };
        const glm::ivec3 a = at(-1), b = at(1);
        for (int x = a.x; x <= b.x; ++x)
            for (int y = a.y; y <= b.y; ++y)
                for (int z = a.z; z <= b.z; ++z) {
                    const glm::dvec3 v = glm::dvec3(x, y, z) + 0.5 - c;
                    if (glm::dot(v, v) > far * far) continue;
                    const std::size_t i =
                        (static_cast<std::size_t>(x) * static_cast<std::size_t>(n.y) +
                         static_cast<std::size_t>(y)) *
                            static_cast<std::size_t>(n.z) +
                        static_cast<std::size_t>(z);
                    count += marked[i] ? 0 : 1;
                    marked[i] = true;
                }
    }
    return count * cell * cell * cell;
}

// As fine as is wanted, as coarse as memory and time ask for.
double chosen_cell(const std::vector<Source>& sources, const Box& box, double volume) {
    const double wanted = std::min(typical_s(sources) / kCellsPerS, box.longest() / kMinSide);
    const glm::dvec3 size = box.size();
    double updates = 0;
    for (const Source& g : sources) updates += exact::pow(2 * g.cut * g.s, 3);
    return std::max({wanted, exact::cbrt(volume / kMaxCells),
                     exact::cbrt(size.x * size.y * size.z / kMaxBricks) / kBrick,
                     // Along one side, too, there are bricks to walk through.
                     box.longest() / (kBrick * 2048.0), exact::cbrt(updates / kMaxUpdates)});
}

// Which of the sources are to be listed, by index; the others go on the lattice. bricks: with matter in them.
std::vector<bool> choose_listed(const std::vector<Source>& sources, double cell, double largest,
                                double bricks) {
    std::vector<bool> listed(sources.size(), false);
    // Those that would be good to list: what it spares (optical depth misplaced) for a brick that has it on its list.
    std::vector<std::pair<double, std::size_t>> wanted;
    const auto entries_of = [cell](const Source& g) {
        return exact::pow(2 * g.cut * g.s / (kBrick * cell) + 1, 3);
    };
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& g = sources[i];
        const double s = g.s / cell;
        const double error = s < kNarrowest ? 1.0 : std::min(0.25 / (s * s), 1.0);
        const double misplaced = error * g.peak * g.s * std::sqrt(2 * std::numbers::pi);
        const bool dense = s < kListedBelow && g.peak * kBrick * cell > kDense;
        if (!dense &&
            (s >= kListedBelow || misplaced <= kMisplaced || g.peak * error <= kAllowed * largest))
            continue;
        wanted.emplace_back(-misplaced / entries_of(g), i);
    }
    std::sort(wanted.begin(), wanted.end());
    const double most = std::max(kListedPerBrick * bricks, kFewListed);
    double entries = 0;
    for (const auto& [merit, i] : wanted) {
        entries += entries_of(sources[i]);
        if (entries > most) break;
        listed[i] = true;
    }
    return listed;
}

void list_by_brick(Matter& m) {
    const auto bricks_of = [&](std::size_t i) {
        const Matter::Listed& one = m.listed[i];
        const double reach = std::sqrt(one.reach2);
        return std::pair{brick_of(m, one.center - reach), brick_of(m, one.center + reach)};
    };
    make_lists(m.brick.size(), m.listed.size(), m.brick_begin, m.brick_items,
               [&](std::size_t i, const auto& put) {
                   const auto [a, b] = bricks_of(i);
                   for (int x = a.x; x <= b.x; ++x)
                       for (int y = a.y; y <= b.y; ++y)
                           for (int z = a.z; z <= b.z; ++z) put(m.brick_at({x, y, z}));
               });
    for (std::size_t b = 0; b < m.brick.size(); ++b)
        m.brick[b].listed = m.brick_begin[b] != m.brick_begin[b + 1] ? 1 : 0;
    make_lists(m.column(m.bricks.x, 0), m.listed.size(), m.column_begin, m.column_items,
               [&](std::size_t i, const auto& put) {
                   const auto [a, b] = bricks_of(i);
                   for (int x = a.x; x <= b.x; ++x)
                       for (int y = a.y; y <= b.y; ++y) put(m.column(x, y));
               });
}

// Joins bricks to blocks (matter.h) as long as a flight across one would look at no more than kLooksPerBlock points, on
// average.
void join_bricks(Matter& m) {
    constexpr float kLooksPerBlock = 0.5f;
    for (int level = 1; level <= kMostLevels; ++level) {
        const int side = 1 << level, half = side / 2;
        const float most_allowed = kLooksPerBlock / static_cast<float>(kBrick * side);
        // Whole ones only: none reaches out of the lattice.
        for (int x = 0; x + side <= m.bricks.x; x += side)
            for (int y = 0; y + side <= m.bricks.y; y += side)
                for (int z = 0; z + side <= m.bricks.z; z += side) {
                    const glm::ivec3 high = glm::ivec3(x, y, z) + side;
                    float most = 0;
                    bool joins = true;
                    // The eight of the level below.
                    for (int bx = x; bx < high.x && joins; bx += half)
                        for (int by = y; by < high.y && joins; by += half)
                            for (int bz = z; bz < high.z && joins; bz += half) {
                                const Brick& part = m.brick[m.brick_at({bx, by, bz})];
                                most = std::max(most, part.most);
                                joins = part.listed == 0 &&
                                        static_cast<int>(part.level) == level - 1 &&
                                        most <= most_allowed;
                            }
                    if (!joins) continue;
                    for (int bx = x; bx < high.x; ++bx)
                        for (int by = y; by < high.y; ++by)
                            for (int bz = z; bz < high.z; ++bz) {
                                Brick& brick = m.brick[m.brick_at({bx, by, bz})];
                                brick.most = most;
                                brick.level = static_cast<std::uint32_t>(level) & 15u;
                            }
                }
    }
}

// Rows: two axes across the sun's rays, and the way its light goes.
glm::dmat3 axes_along(const glm::dvec3& to_sun) {
    const glm::dvec3 w = -to_sun;
    const glm::dvec3 aside = std::abs(w.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(aside, w)), v = glm::cross(w, u);
    return glm::transpose(glm::dmat3(u, v, w));
}

}  // namespace

Result<Matter> make_matter(const ParticleSet& particles, const glm::dvec3& to_sun, int threads,
                           const Deadline& deadline) {
    Matter m;
    std::vector<Source> sources;
    Bounds bounds;
    bool first = true;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.density[i] <= 0) continue;
        const glm::dvec3& c = particles.center[i];
        bounds = first ? Bounds{c, c} : Bounds{glm::min(bounds.min, c), glm::max(bounds.max, c)};
        first = false;
    }
    if (first) return m;
    m.empty = false;
    const glm::dvec3 middle = 0.5 * bounds.min + 0.5 * bounds.max;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.density[i] <= 0) continue;
        const glm::vec3 color = particles.color.empty() ? glm::vec3(1) : particles.color[i];
        if (color != glm::vec3(1)) m.colored = true;
        sources.push_back({particles.center[i] - middle, gaussian_s(particles, i),
                           static_cast<double>(particles.density[i]),
                           cut_of(central_depth(particles, i)), color});
    }

    m.axes = axes_along(to_sun);
    Box box, lattice_box;
    for (const Source& g : sources) {
        box.hold(g.center, g.cut * g.s);
        lattice_box.hold(m.axes * g.center, g.cut * g.s);
    }
    if (auto error = deadline.over()) return *error;
    const double volume = volume_of(sources, lattice_box, m.axes);
    const double cell = chosen_cell(sources, lattice_box, volume);
    const double largest = about_largest(sources, box);
    if (auto error = deadline.over()) return *error;

    m.detail = particles.detail;
    m.origin = middle + box.low;
    m.cell = cell;
    m.top = box.size() / cell;
    // A brick more on every side, for those that are widened.
    m.shift = (m.axes * box.low - lattice_box.low) / cell + double{kBrick};
    m.bricks = glm::ivec3(lattice_box.size() / (kBrick * cell)) + 3;

    OnLattice on_lattice;
    const std::vector<bool> listed =
        particles.detail
            ? std::vector<bool>(sources.size(), false)
            : choose_listed(sources, cell, largest, volume / exact::pow(kBrick * cell, 3));
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& g = sources[i];
        const glm::dvec3 c = (m.axes * g.center - lattice_box.low) / cell + double{kBrick};
        const double s = g.s / cell;
        if (listed[i]) {
            m.listed.push_back({c, s, g.peak * cell, g.cut * g.cut * s * s, g.color});
        } else {
            on_lattice.gaussians.push_back({c, s, g.cut, g.peak * cell});
            on_lattice.colors.push_back(g.color);
        }
    }
    sources = {};
    if (auto error = fill_bricks(m, on_lattice, threads, deadline)) return *error;
    // There is always a brick of nodes to read, if only of zeros.
    if (m.nodes.empty()) m.nodes.assign(kBrickStride, Node{0, 0});
    if (!m.listed.empty()) list_by_brick(m);
    join_bricks(m);
    return m;
}

}  // namespace awan::truth
