#include "core/truth/matter.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/truth/oracles.h"

namespace awan::truth {
namespace {

// Cells along the longest side: larger lattices leave the caches.
constexpr double kMaxSide = 176;
constexpr double kMaxNodes = 12e6, kMaxColored = 6e6;  // of a lattice: 48 MB each
constexpr double kMinSide = 64;
// Wanted of the particles that matter.
constexpr double kCellsPerS = 10;
// Of the largest extinction, by one particle.
constexpr double kAllowed = 0.008;

// Particles that misplace more optical depth than this on a lattice are plainly seen. Lists of bricks are filled with
// these up to so many entries, and with the others up to fewer: every entry costs each path that comes by.
constexpr double kMisplaced = 0.05;
constexpr double kMaxPlainEntries = 1e6, kMaxFineEntries = 20e3;

// Everything about a particle that does not depend on the lattice. Scene units, about the cloud's centre.
struct Source {
    glm::dvec3 center;
    double s, peak, cut;
    glm::vec3 color;
};

// Beyond cut * s a particle's optical depth is below 1e-5, or 1e-5 of its own.
double cut_of(double central_depth) {
    return std::clamp(std::sqrt(2 * std::log(1e5 * std::max(central_depth, 1.0))), 4.8, 9.0);
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

// The smallest cell that keeps a box within the bounds on lattices.
double smallest_cell(const Box& box, double max_nodes) {
    const glm::dvec3 size = box.size();
    return std::max(box.longest() / kMaxSide, std::cbrt(size.x * size.y * size.z / max_nodes));
}

glm::ivec3 nodes_for(const Box& box, double cell) {
    return glm::ivec3(glm::ceil(box.size() / cell)) + 2;
}

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
        mass[index(cell_of(g))] += g.peak * std::pow(g.s * g.s / s2, 1.5);
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
            sum += g.peak * std::exp(-0.5 * glm::dot(v, v));
        }
        largest = std::max(largest, sum);
    }
    return largest;
}

// Error that a particle makes on a lattice, of its peak (lattice.h).
double lattice_error(double s_in_cells) {
    return s_in_cells < kNarrowest ? 1.0 : std::min(0.25 / (s_in_cells * s_in_cells), 1.0);
}

// Which of the sources are to be listed, by index; the others go on the lattice.
std::vector<bool> choose_listed(const std::vector<Source>& sources, double cell, double largest) {
    std::vector<bool> listed(sources.size(), false);
    // Those that would be good to list: what it spares (optical depth misplaced) for a brick that has it on its list.
    std::vector<std::pair<double, std::size_t>> plain, fine;
    const auto entries_of = [cell](const Source& g) {
        return std::pow(2 * g.cut * g.s / (kBrick * cell) + 1, 3);
    };
    double entries = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& g = sources[i];
        const double s = g.s / cell, error = lattice_error(s);
        const double misplaced = error * g.peak * g.s * std::sqrt(2 * std::numbers::pi);
        if (s >= kCellsPerS / 2 || g.peak * error <= kAllowed * largest) continue;
        // Narrow and dense: a majorant of such a peak would make a walk stop everywhere in its bricks.
        const bool dense = s < 4 && g.peak * kBrick * cell > 1000;
        if (dense)
            listed[i] = true;
        else
            (misplaced > kMisplaced ? plain : fine).emplace_back(-misplaced / entries_of(g), i);
    }
    const auto list_best = [&](std::vector<std::pair<double, std::size_t>>& wanted, double most) {
        std::sort(wanted.begin(), wanted.end());
        for (const auto& [merit, i] : wanted) {
            entries += entries_of(sources[i]);
            if (entries > most) return;
            listed[i] = true;
        }
    };
    list_best(plain, kMaxPlainEntries);
    list_best(fine, kMaxFineEntries);
    return listed;
}

// Lists of those of n items that touch each of the cells first(i)..last(i), as begin/items.
template <typename Touch>
void make_lists(std::size_t lists, std::size_t n, std::vector<std::uint32_t>& begin,
                std::vector<std::uint32_t>& items, const Touch& touch) {
    begin.assign(lists + 1, 0);
    for (std::size_t i = 0; i < n; ++i) touch(i, [&](std::size_t list) { ++begin[list + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < n; ++i)
        touch(i, [&](std::size_t list) { items[next[list]++] = static_cast<std::uint32_t>(i); });
}

glm::ivec3 brick_of(const glm::dvec3& p, const glm::ivec3& bricks) {
    return glm::clamp(glm::ivec3(glm::floor(p / static_cast<double>(kBrick))), glm::ivec3(0),
                      bricks - 1);
}

void list_by_brick(Matter& m) {
    make_lists(m.most.size(), m.listed.size(), m.brick_begin, m.brick_items,
               [&](std::size_t i, const auto& put) {
                   const Matter::Listed& one = m.listed[i];
                   const double reach = std::sqrt(one.reach2);
                   const glm::ivec3 a = brick_of(one.center - reach, m.bricks),
                                    b = brick_of(one.center + reach, m.bricks);
                   for (int z = a.z; z <= b.z; ++z)
                       for (int y = a.y; y <= b.y; ++y)
                           for (int x = a.x; x <= b.x; ++x) put(m.brick({x, y, z}));
               });
}

int column_of(double x, int columns) {
    return std::clamp(static_cast<int>(std::floor(x / kBrick)), 0, columns - 1);
}

void list_by_column(Matter& m) {
    m.columns = (glm::ivec2(m.sun_nodes) + kBrick - 1) / kBrick;
    make_lists(static_cast<std::size_t>(m.columns.x) * static_cast<std::size_t>(m.columns.y),
               m.to_sun.size(), m.column_begin, m.column_items,
               [&](std::size_t i, const auto& put) {
                   const Matter::ListedToSun& one = m.to_sun[i];
                   const double reach = std::sqrt(one.reach2);
                   for (int y = column_of(one.center.y - reach, m.columns.y);
                        y <= column_of(one.center.y + reach, m.columns.y); ++y)
                       for (int x = column_of(one.center.x - reach, m.columns.x);
                            x <= column_of(one.center.x + reach, m.columns.x); ++x)
                           put(static_cast<std::size_t>(x) +
                               static_cast<std::size_t>(m.columns.x) * static_cast<std::size_t>(y));
               });
}

// A trilinear field is nowhere above its nodes, nor its lumps above what most_detailed says.
void find_most(Matter& m, int threads) {
    if (m.extinction.empty()) return;
    parallel_for(threads, static_cast<std::size_t>(m.bricks.z), [&](std::size_t bz) {
        const int z = static_cast<int>(bz);
        for (int y = 0; y < m.bricks.y; ++y)
            for (int x = 0; x < m.bricks.x; ++x) {
                float most = 0;
                const glm::ivec3 a = glm::ivec3(x, y, z) * kBrick;
                const glm::ivec3 b = glm::min(a + kBrick, m.nodes - 1);
                for (int k = a.z; k <= b.z; ++k)
                    for (int j = a.y; j <= b.y; ++j)
                        for (int i = a.x; i <= b.x; ++i)
                            most = std::max(most,
                                            m.extinction[static_cast<std::size_t>(i) +
                                                         static_cast<std::size_t>(m.nodes.x) *
                                                             (static_cast<std::size_t>(j) +
                                                              static_cast<std::size_t>(m.nodes.y) *
                                                                  static_cast<std::size_t>(k))]);
                if (m.detail)
                    most = static_cast<float>(
                        m.cell * most_detailed(*m.detail, static_cast<double>(most) / m.cell));
                m.most[m.brick({x, y, z})] = most * 1.00001f;  // interpolation rounds
            }
    });
}

// The sun's lattice, from smooth extinctions to those with detail.
void add_detail_to_sun(Matter& m, double sun_cell, int threads) {
    const glm::dmat3 back = glm::inverse(m.sun_axes);  // to the matter's cells
    const auto row = static_cast<std::size_t>(m.sun_nodes.x);
    parallel_for(threads, m.sun_depth.size() / row, [&](std::size_t line) {
        const auto j = static_cast<double>(line % static_cast<std::size_t>(m.sun_nodes.y));
        const auto k = static_cast<double>(line / static_cast<std::size_t>(m.sun_nodes.y));
        for (std::size_t i = 0; i < row; ++i) {
            float& value = m.sun_depth[line * row + i];
            const glm::dvec3 q(static_cast<double>(i), j, k);
            const double ratio = m.cell / sun_cell;
            value = static_cast<float>(
                with_detail(m, static_cast<float>(static_cast<double>(value) * ratio),
                            back * (q - m.sun_origin)) /
                ratio);
        }
    });
}

// Extinction at the nodes becomes the depth gathered along the third axis. By the trapezium rule:
// smooth Gaussians leave it an error of (cell / s)^2 / 50 of a particle's own depth.
void gather_along_sun(std::vector<float>& values, const glm::ivec3& n) {
    const std::size_t plane = static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y);
    std::vector<double> depth(plane, 0.0);
    std::vector<float> before(plane, 0.0f);
    for (int k = 0; k < n.z; ++k) {
        float* now = values.data() + plane * static_cast<std::size_t>(k);
        for (std::size_t i = 0; i < plane; ++i) {
            depth[i] += 0.5 * (static_cast<double>(before[i]) + static_cast<double>(now[i]));
            before[i] = now[i];
            now[i] = static_cast<float>(depth[i]);
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

double listed_depth(const Matter::Listed& one, const glm::dvec3& o, const glm::dvec3& d,
                    double from, double to) {
    const glm::dvec3 v = one.center - o;
    const double along = glm::dot(v, d);
    const glm::dvec3 aside = v - along * d;
    const double b2 = glm::dot(aside, aside);
    if (b2 >= one.reach2) return 0;
    const double half = std::sqrt(one.reach2 - b2);
    const double a = std::max(from, along - half) - along, b = std::min(to, along + half) - along;
    if (!(a < b)) return 0;
    const double per = 1 / (std::sqrt(2.0) * one.s);
    // Arguments of one sign: no difference of two numbers near 1.
    double part;
    if (a > 0)
        part = std::erfc(a * per) - std::erfc(b * per);
    else if (b < 0)
        part = std::erfc(-b * per) - std::erfc(-a * per);
    else
        part = std::erf(b * per) - std::erf(a * per);
    return std::max(
        one.peak * one.s * std::sqrt(std::numbers::pi / 2) * std::exp(-b2 * per * per) * part, 0.0);
}

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

    const glm::dmat3 axes = axes_along(to_sun);
    Box box, sun_box;
    for (const Source& g : sources) {
        box.hold(g.center, g.cut * g.s);
        sun_box.hold(axes * g.center, g.cut * g.s);
    }
    const double wanted = std::min(typical_s(sources) / kCellsPerS, box.longest() / kMinSide);
    const double cell = std::max(wanted, smallest_cell(box, m.colored ? kMaxColored : kMaxNodes));
    const double sun_cell = std::max(wanted, smallest_cell(sun_box, kMaxNodes));
    const double largest = about_largest(sources, box);

    m.detail = particles.detail;
    m.origin = middle + box.low;
    m.cell = cell;
    m.nodes = nodes_for(box, cell);
    m.top = glm::dvec3(m.nodes - 1);
    m.bricks = (m.nodes - 2) / kBrick + 1;
    m.most.assign(static_cast<std::size_t>(m.bricks.x) * static_cast<std::size_t>(m.bricks.y) *
                      static_cast<std::size_t>(m.bricks.z),
                  0.0f);
    m.sun_axes = axes * (cell / sun_cell);
    m.sun_origin = (axes * box.low - sun_box.low) / sun_cell;
    m.sun_nodes = nodes_for(sun_box, sun_cell);

    std::vector<LatticeGaussian> on_lattice, on_sun_lattice;
    std::vector<glm::vec3> colors;
    const std::vector<bool> listed =
        particles.detail ? std::vector<bool>(sources.size(), false)
                         : choose_listed(sources, std::max(cell, sun_cell), largest);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& g = sources[i];
        const glm::dvec3 c = (g.center - box.low) / cell;
        const glm::dvec3 at_sun = (axes * g.center - sun_box.low) / sun_cell;
        const double s = g.s / cell, sun_s = g.s / sun_cell;
        if (!listed[i]) {
            on_lattice.push_back({c, s, g.cut, g.peak * cell});
            on_sun_lattice.push_back({at_sun, sun_s, g.cut, g.peak * sun_cell});
            colors.push_back(g.color);
        } else {
            m.listed.push_back({c, s, g.peak * cell, g.cut * g.cut * s * s, g.color});
            m.to_sun.push_back({at_sun, sun_s, g.peak * g.s * std::sqrt(2 * std::numbers::pi),
                                g.cut * g.cut * sun_s * sun_s});
        }
    }
    sources = {};

    if (!on_lattice.empty()) {
        auto depth = sum_on_lattice(m.sun_nodes, on_sun_lattice, threads, deadline);
        if (!depth.ok()) return depth.error();
        m.sun_depth = *std::move(depth);
        if (m.detail) add_detail_to_sun(m, sun_cell, threads);
        gather_along_sun(m.sun_depth, m.sun_nodes);
        on_sun_lattice = {};
        auto sum = sum_on_lattice(m.nodes, on_lattice, threads, deadline);
        if (!sum.ok()) return sum.error();
        m.extinction = *std::move(sum);
        for (int channel = 0; m.colored && channel < 3; ++channel) {
            std::vector<LatticeGaussian> tinted = on_lattice;
            for (std::size_t i = 0; i < tinted.size(); ++i)
                tinted[i].peak *= static_cast<double>(colors[i][channel]);
            auto sums = sum_on_lattice(m.nodes, tinted, threads, deadline);
            if (!sums.ok()) return sums.error();
            m.color[static_cast<std::size_t>(channel)] = *std::move(sums);
        }
    }
    find_most(m, threads);
    if (!m.listed.empty()) {
        list_by_brick(m);
        list_by_column(m);
    }
    return m;
}

double extinction(const Matter& m, const glm::dvec3& p) {
    if (m.empty || glm::any(glm::lessThan(p, glm::dvec3(0))) ||
        glm::any(glm::greaterThan(p, m.top)))
        return 0;
    double sum = m.extinction.empty()
                     ? 0.0
                     : with_detail(m, interpolated(m.extinction.data(), m.nodes, p.x, p.y, p.z), p);
    if (m.listed.empty()) return sum;
    const std::size_t b = m.brick(brick_of(p, m.bricks));
    for (std::uint32_t i = m.brick_begin[b]; i < m.brick_begin[b + 1]; ++i) {
        const Matter::Listed& one = m.listed[m.brick_items[i]];
        const glm::dvec3 v = p - one.center;
        const double d2 = glm::dot(v, v);
        if (d2 < one.reach2) sum += one.peak * std::exp(-d2 / (2 * one.s * one.s));
    }
    return sum;
}

double depth_to_sun(const Matter& m, const glm::dvec3& p) {
    if (m.empty) return 0;
    const glm::dvec3 q = m.sun_axes * p + m.sun_origin;
    if (q.x < 0 || q.y < 0 || q.z < 0 || q.x > m.sun_nodes.x - 1 || q.y > m.sun_nodes.y - 1)
        return 0;
    double depth =
        m.sun_depth.empty()
            ? 0.0
            : static_cast<double>(interpolated(m.sun_depth.data(), m.sun_nodes, q.x, q.y, q.z));
    if (m.listed.empty()) return depth;
    const std::size_t column = static_cast<std::size_t>(column_of(q.x, m.columns.x)) +
                               static_cast<std::size_t>(m.columns.x) *
                                   static_cast<std::size_t>(column_of(q.y, m.columns.y));
    for (std::uint32_t i = m.column_begin[column]; i < m.column_begin[column + 1]; ++i) {
        const Matter::ListedToSun& one = m.to_sun[m.column_items[i]];
        const double x = q.x - one.center.x, y = q.y - one.center.y, b2 = x * x + y * y;
        if (b2 >= one.reach2) continue;
        const double past = (q.z - one.center.z) / one.s;
        if (past < -9) continue;
        const double whole = one.depth * std::exp(-b2 / (2 * one.s * one.s));
        depth += past > 6 ? whole : whole * 0.5 * std::erfc(-past * std::sqrt(0.5));
    }
    return depth;
}

glm::dvec3 color_at(const Matter& m, const glm::dvec3& p) {
    if (!m.colored) return glm::dvec3(1);
    double whole = 0;
    glm::dvec3 sum(0);
    if (!m.extinction.empty()) {
        whole = static_cast<double>(interpolated(m.extinction.data(), m.nodes, p.x, p.y, p.z));
        for (std::size_t c = 0; c < 3; ++c)
            sum[static_cast<int>(c)] =
                static_cast<double>(interpolated(m.color[c].data(), m.nodes, p.x, p.y, p.z));
    }
    if (!m.listed.empty()) {
        const std::size_t b = m.brick(brick_of(p, m.bricks));
        for (std::uint32_t i = m.brick_begin[b]; i < m.brick_begin[b + 1]; ++i) {
            const Matter::Listed& one = m.listed[m.brick_items[i]];
            const glm::dvec3 v = p - one.center;
            const double d2 = glm::dot(v, v);
            if (d2 >= one.reach2) continue;
            const double part = one.peak * std::exp(-d2 / (2 * one.s * one.s));
            whole += part;
            sum += part * glm::dvec3(one.color);
        }
    }
    // Of sums in float, each rounded by itself.
    return whole > 0 ? glm::clamp(sum / whole, 0.0, 1.0) : glm::dvec3(1);
}

}  // namespace awan::truth
