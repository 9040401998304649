#include "core/survey/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/float_runs.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

constexpr double kCut = 4;  // in s
// Cells of the volume that finds the box.
constexpr int kCoarse = 32;
constexpr double kCoarseWork = 1e7;  // of it; about 10 ms

// Of fitted cells. Lengths within this factor of each other count as the same.
constexpr double kCompact = 1.5;
// The shortest side to the longest.
constexpr double kFlattest = 1.0 / 32;
// Cells to those of a cubic lattice: somewhat fewer, since light in flat cells takes more sweeps to settle.
constexpr double kCellsToCubic = 0.9;
// Cells along a side to the count that was asked for.
constexpr int kMostAlong = 2;

struct Span {
    int first = 0, last = -1;  // cells, inclusive
    bool empty() const { return last < first; }
};

Span span_of(double center, double reach, double cell, int count) {
    const double first = std::floor((center - reach) / cell);
    const double last = std::floor((center + reach) / cell);
    if (last < 0 || first >= count) return {};
    return {static_cast<int>(std::max(first, 0.0)),
            static_cast<int>(std::min(last, static_cast<double>(count - 1)))};
}

// Share of a Gaussian's mass below a point, from -kCut s (0) to kCut s (1): linear between the nodes of a table,
// within 2e-7. A table of normal_cdf, itself one: inlined and ready scaled it saves a quarter of a million small
// particles' time, which is spent here.
class MassBelow {
  public:
    MassBelow() {
        const double least = normal_cdf(-kCut), whole = normal_cdf(kCut) - least;
        for (int i = 0; i <= kNodes; ++i)
            below_[static_cast<std::size_t>(i)] =
                (normal_cdf(-kCut + 2 * kCut * i / kNodes) - least) / whole;
        below_[kNodes + 1] = below_[kNodes];
    }
    double operator()(double x) const {  // in s from the centre
        const double at = std::clamp((x + kCut) * (kNodes / (2 * kCut)), 0.0, double{kNodes});
        const auto node = static_cast<std::size_t>(at);
        return below_[node] + (at - static_cast<double>(node)) * (below_[node + 1] - below_[node]);
    }

  private:
    static constexpr int kNodes = 4096;
    std::array<double, kNodes + 2> below_{};
};

// Shares of a Gaussian's mass in a span of cells along one axis. The whole within +-kCut s is 1.
void weights_of(const MassBelow& mass_below, double center, double s, double cell, Span span,
                float* weights) {
    const double per = 1 / s;
    double previous = mass_below((span.first * cell - center) * per);
    for (int i = span.first; i <= span.last; ++i) {
        const double next = mass_below(((i + 1) * cell - center) * per);
        *weights++ = static_cast<float>(next - previous);
        previous = next;
    }
}

const MassBelow& mass_below() {
    static const MassBelow table;
    return table;
}

// The layers along w that a particle reaches, both ends included; found once, for all slabs. Lattices have few layers.
struct LayerSpan {
    std::int16_t first, last;
};

std::vector<LayerSpan> layer_spans(const ParticleSet& particles, const Lattice& lattice,
                                   int threads) {
    std::vector<LayerSpan> spans(particles.size());
    constexpr std::size_t kShare = 1u << 15;
    parallel_for(threads, (spans.size() + kShare - 1) / kShare, [&](std::size_t share) {
        const std::size_t end = std::min(spans.size(), (share + 1) * kShare);
        for (std::size_t i = share * kShare; i < end; ++i) {
            const Span z =
                span_of(glm::dot(particles.center[i] - lattice.origin, lattice.w),
                        kCut * gaussian_s(particles, i), lattice.cell.z, lattice.cells.z);
            spans[i] = {static_cast<std::int16_t>(z.first), static_cast<std::int16_t>(z.last)};
        }
    });
    return spans;
}

// Adds the particles to the cells of layers [first, last) along w. weight(i): mass of particle i.
template <typename Mass>
void add_layers(const ParticleSet& particles, const Lattice& lattice, int first, int last,
                const std::vector<LayerSpan>& layers, const Mass& mass_of,
                std::vector<float>& cells) {
    const MassBelow& below = mass_below();
    const glm::ivec3 n = lattice.cells;
    const double volume = lattice.cell.x * lattice.cell.y * lattice.cell.z;
    std::vector<float> wx(static_cast<std::size_t>(n.x)), wy(static_cast<std::size_t>(n.y)),
        wz(static_cast<std::size_t>(n.z));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Span z{std::max<int>(layers[i].first, first),
                     std::min<int>(layers[i].last, last - 1)};
        if (z.empty()) continue;
        const double s = gaussian_s(particles, i);
        const glm::dvec3 apart = particles.center[i] - lattice.origin;
        const double cz = glm::dot(apart, lattice.w);
        const double cx = glm::dot(apart, lattice.u), cy = glm::dot(apart, lattice.v);
        const Span x = span_of(cx, kCut * s, lattice.cell.x, n.x);
        const Span y = span_of(cy, kCut * s, lattice.cell.y, n.y);
        if (x.empty() || y.empty()) continue;
        const double mass = mass_of(i);
        if (!(mass > 0)) continue;
        weights_of(below, cx, s, lattice.cell.x, x, wx.data());
        weights_of(below, cy, s, lattice.cell.y, y, wy.data());
        weights_of(below, cz, s, lattice.cell.z, z, wz.data());
        const auto scale = static_cast<float>(std::min(mass / volume, 1e30));
        const auto count = static_cast<std::size_t>(x.last - x.first + 1);
        for (int k = z.first; k <= z.last; ++k)
            for (int j = y.first; j <= y.last; ++j) {
                const float w = scale * wz[static_cast<std::size_t>(k - z.first)] *
                                wy[static_cast<std::size_t>(j - y.first)];
                float* row =
                    cells.data() + (static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                                    static_cast<std::size_t>(j)) *
                                       static_cast<std::size_t>(n.x);
                if (count <= 8) {
                    for (std::size_t a = 0; a < count; ++a)
                        row[static_cast<std::size_t>(x.first) + a] += w * wx[a];
                } else {
                    add_scaled(row + x.first, wx.data(), w, count);
                }
            }
    }
}

template <typename Mass>
std::vector<float> deposit(const ParticleSet& particles, const Lattice& lattice, int threads,
                           const Mass& mass) {
    std::vector<float> cells(lattice.size());
    const int layers = lattice.cells.z;
    const std::vector<LayerSpan> spans = layer_spans(particles, lattice, threads);
    // Each cell is one slab's, and has its particles in the set's order: neither slabs nor threads show. As few as
    // keep the threads busy, since a particle is worked on once for every slab that it reaches.
    const std::size_t slabs = threads > 1 ? 2 * static_cast<std::size_t>(threads) : 1;
    parallel_for(threads, slabs, [&](std::size_t slab) {
        const auto edge = [&](std::size_t i) {
            return static_cast<int>(i * static_cast<std::size_t>(layers) / slabs);
        };
        if (edge(slab) < edge(slab + 1))
            add_layers(particles, lattice, edge(slab), edge(slab + 1), spans, mass, cells);
    });
    return cells;
}

// The particles' extent along the axes, each to kCut s.
Lattice whole_box(const ParticleSet& particles, const glm::dvec3& u, const glm::dvec3& v,
                  const glm::dvec3& w, int count) {
    Lattice box{{}, u, v, w, {}, {}};
    const glm::dvec3 base = particles.center[0];
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 p = particles.center[i] - base;
        const glm::dvec3 q(glm::dot(p, u), glm::dot(p, v), glm::dot(p, w));
        const double reach = kCut * gaussian_s(particles, i);
        low = glm::min(low, q - reach);
        high = glm::max(high, q + reach);
    }
    const glm::dvec3 size = high - low;
    box.cell = glm::dvec3(std::max({size.x, size.y, size.z}) / count);
    box.cells =
        glm::clamp(glm::ivec3(glm::ceil(size / box.cell)), glm::ivec3(1), glm::ivec3(count));
    box.origin = base + low.x * u + low.y * v + low.z * w;
    return box;
}

using Layers = std::vector<float>;

// The densest cell of each layer across each of the axes.
std::array<Layers, 3> densest_of(const std::vector<float>& cells, const glm::ivec3& n) {
    std::array<Layers, 3> densest;
    for (int axis = 0; axis < 3; ++axis)
        densest[static_cast<std::size_t>(axis)].resize(static_cast<std::size_t>(n[axis]));
    std::size_t at = 0;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i, ++at) {
                const int index[3] = {i, j, k};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    float& most = densest[axis][static_cast<std::size_t>(index[axis])];
                    most = std::max(most, cells[at]);
                }
            }
    return densest;
}

// MatterBox::length in cells. Beyond the outermost cells there is no matter.
glm::dvec3 lengths_of(const std::vector<float>& cells, const glm::ivec3& n) {
    const std::size_t stride[3] = {1, static_cast<std::size_t>(n.x),
                                   static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y)};
    double whole = 0;
    for (const float cell : cells) whole += static_cast<double>(cell);
    glm::dvec3 lengths(1);
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t step = stride[axis], count = static_cast<std::size_t>(n[axis]);
        double change = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::size_t at = i / step % count;
            const float before = at > 0 ? cells[i - step] : 0.F;
            change += static_cast<double>(std::abs(cells[i] - before));
            if (at + 1 == count) change += static_cast<double>(cells[i]);
        }
        if (change > 0) lengths[axis] = whole / change;
    }
    return lengths;
}

}  // namespace

double lattice_work(const ParticleSet& particles, const glm::dvec3& cell, const glm::ivec3& cells) {
    double work = 0;
    for (const float radius : particles.radius) {
        const glm::dvec3 sides =
            glm::min(kCut * static_cast<double>(radius) / cell + 1.0, glm::dvec3(cells));
        work += sides.x * sides.y * sides.z;
    }
    return work;
}

std::vector<float> extinction_in(const ParticleSet& particles, const Lattice& lattice,
                                 int threads) {
    return deposit(particles, lattice, threads,
                   [&](std::size_t i) { return gaussian_mass(particles, i); });
}

std::vector<float> colored_extinction_in(const ParticleSet& particles, const Lattice& lattice,
                                         int channel, int threads) {
    return deposit(particles, lattice, threads, [&](std::size_t i) {
        return gaussian_mass(particles, i) * static_cast<double>(particles.color[i][channel]);
    });
}

MatterBox box_around_matter(const ParticleSet& particles, const glm::dvec3& u, const glm::dvec3& v,
                            const glm::dvec3& w, double rest, int threads) {
    int coarse = kCoarse;
    Lattice box = whole_box(particles, u, v, w, coarse);
    while (coarse > 4 && lattice_work(particles, box.cell, box.cells) > kCoarseWork) {
        coarse = coarse * 3 / 4;
        box = whole_box(particles, u, v, w, coarse);
    }
    const std::vector<float> cells = extinction_in(particles, box, threads);
    const glm::ivec3 n = box.cells;
    const std::array<Layers, 3> densest = densest_of(cells, n);
    // Layers that could be left out: the longest line in them stays below `rest`.
    const double longest = box.cell.x * std::max({n.x, n.y, n.z});
    glm::ivec3 first(0), last(n - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const auto light = [&](int layer) {
            return static_cast<double>(
                       densest[static_cast<std::size_t>(axis)][static_cast<std::size_t>(layer)]) *
                       longest <
                   rest;
        };
        while (first[axis] < last[axis] && light(first[axis])) ++first[axis];
        while (last[axis] > first[axis] && light(last[axis])) --last[axis];
    }
    return {u,
            v,
            w,
            box.at(glm::dvec3(first)),
            box.cell * glm::dvec3(last - first + 1),
            box.cell * lengths_of(cells, n)};
}

Lattice cubic_cells(const MatterBox& box, int count) {
    Lattice made{box.corner, box.u, box.v, box.w, {}, {}};
    const double side = std::max({box.size.x, box.size.y, box.size.z}) / count;
    made.cell = glm::dvec3(side);
    made.cells =
        glm::clamp(glm::ivec3(glm::ceil(box.size / side - 1e-6)), glm::ivec3(1), glm::ivec3(count));
    // What cells are too long is shared by both ends.
    const glm::dvec3 spare = 0.5 * (glm::dvec3(made.cells) * side - box.size);
    made.origin -= spare.x * box.u + spare.y * box.v + spare.z * box.w;
    return made;
}

Lattice fitted_cells(const MatterBox& box, int count) {
    const Lattice cubic = cubic_cells(box, count);
    const double longest = std::max({box.length.x, box.length.y, box.length.z});
    const glm::dvec3 flat =
        glm::clamp(kCompact * box.length / longest, glm::dvec3(kFlattest), glm::dvec3(1));
    if (flat == glm::dvec3(1)) return cubic;
    // About as many cells as a cubic lattice has: their common scale follows.
    const glm::dvec3 asked = box.size / (flat * cubic.cell);
    const double scale = std::cbrt(asked.x * asked.y * asked.z /
                                   (kCellsToCubic * static_cast<double>(cubic.size())));
    Lattice made{box.corner, box.u, box.v, box.w, {}, {}};
    made.cells = glm::clamp(glm::ivec3(glm::round(asked / scale)), glm::ivec3(1),
                            glm::ivec3(kMostAlong * count));
    made.cell = box.size / glm::dvec3(made.cells);
    return made;
}

Lattice within_work(const ParticleSet& particles, const MatterBox& box, int count, double most_work,
                    Division division) {
    Lattice made = division(box, count);
    while (count > 8 && lattice_work(particles, made.cell, made.cells) > most_work) {
        count = count * 3 / 4;
        made = division(box, count);
    }
    return made;
}

Lattice lattice_around_matter(const ParticleSet& particles, const glm::dvec3& u,
                              const glm::dvec3& v, const glm::dvec3& w, double rest, int count,
                              int threads, double most_work) {
    const MatterBox box = box_around_matter(particles, u, v, w, rest, threads);
    return within_work(particles, box, count, most_work, cubic_cells);
}

}  // namespace awan
