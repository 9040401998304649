#include "core/survey/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

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

std::size_t index_of(const glm::ivec3& cells, int i, int j, int k) {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells.y) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(cells.x) +
           static_cast<std::size_t>(i);
}

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

// Share of a Gaussian's mass below a point, from -kGaussianCut s (0) to kGaussianCut s (1): linear between the nodes
// of a table, within 2e-7. A table of normal_cdf, itself one: inlined and ready scaled it saves a quarter of a million
// small particles' time, which is spent here.
class MassBelow {
  public:
    MassBelow() {
        const double least = normal_cdf(-kGaussianCut), whole = normal_cdf(kGaussianCut) - least;
        for (int i = 0; i <= kNodes; ++i)
            below_[static_cast<std::size_t>(i)] =
                (normal_cdf(-kGaussianCut + 2 * kGaussianCut * i / kNodes) - least) / whole;
        below_[kNodes + 1] = below_[kNodes];
    }
    double operator()(double x) const {  // in s from the centre
        const double at =
            std::clamp((x + kGaussianCut) * (kNodes / (2 * kGaussianCut)), 0.0, double{kNodes});
        const auto node = static_cast<std::size_t>(at);
        return below_[node] + (at - static_cast<double>(node)) * (below_[node + 1] - below_[node]);
    }

  private:
    static constexpr int kNodes = 4096;
    std::array<double, kNodes + 2> below_{};
};

// Shares of a Gaussian's mass in a span of cells along one axis. The whole within +-kGaussianCut s is 1.
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
                        kGaussianCut * gaussian_s(particles, i), lattice.cell.z, lattice.cells.z);
            spans[i] = {static_cast<std::int16_t>(z.first), static_cast<std::int16_t>(z.last)};
        }
    });
    return spans;
}

// Floats that a box's rows are a multiple of, where the lattice's rows are as long.
constexpr std::size_t kWide = 8;

// What a particle adds to a box of cells: along each axis its shares, w of the first.
struct BoxShares {
    const float *x, *y, *z;
    std::size_t count[3];    // cells of the box; a multiple of kWide along x, or less than it
    std::size_t row, layer;  // of the lattice, cells
    float scale;
    float* to;  // the box's first cell
};
AWAN_INLINE void add_box_body(const BoxShares& box) {
    using Wide = float __attribute__((vector_size(4 * kWide)));
    for (std::size_t k = 0; k < box.count[2]; ++k)
        for (std::size_t j = 0; j < box.count[1]; ++j) {
            const float w = box.scale * box.z[k] * box.y[j];
            float* const to = box.to + k * box.layer + j * box.row;
            if (box.count[0] < kWide) {
                for (std::size_t i = 0; i < box.count[0]; ++i) to[i] += w * box.x[i];
                continue;
            }
            for (std::size_t i = 0; i < box.count[0]; i += kWide) {
                Wide sum, x;
                std::memcpy(&sum, to + i, sizeof sum);
                std::memcpy(&x, box.x + i, sizeof x);
                sum += w * x;
                std::memcpy(to + i, &sum, sizeof sum);
            }
        }
}
AWAN_KERNEL(void, add_box, (const BoxShares& box), (box))

// A span whose length is a multiple of kWide and that holds the given one, where the row is long enough.
Span widened(Span span, int cells) {
    constexpr int kStep = kWide;
    const int length = span.last - span.first + 1, wide = (length + kStep - 1) / kStep * kStep;
    if (wide > cells) return span;
    const int first = std::min(span.first, cells - wide);
    return {first, first + wide - 1};
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
        const Span x = span_of(cx, kGaussianCut * s, lattice.cell.x, n.x);
        const Span y = span_of(cy, kGaussianCut * s, lattice.cell.y, n.y);
        if (x.empty() || y.empty()) continue;
        const double mass = mass_of(i);
        if (!(mass > 0)) continue;
        weights_of(below, cx, s, lattice.cell.x, x, wx.data());
        weights_of(below, cy, s, lattice.cell.y, y, wy.data());
        weights_of(below, cz, s, lattice.cell.z, z, wz.data());
        const auto scale = static_cast<float>(std::min(mass / volume, 1e30));
        // Cells beside the particle get 0 more. Where the lattice is narrower, what is left over goes one by one.
        const Span wide = widened(x, n.x);
        const auto before = static_cast<std::size_t>(x.first - wide.first),
                   count = static_cast<std::size_t>(x.last - x.first + 1),
                   width = static_cast<std::size_t>(wide.last - wide.first + 1);
        if (width > count || before > 0) {
            std::move_backward(wx.data(), wx.data() + count, wx.data() + before + count);
            std::fill_n(wx.data(), before, 0.F);
            std::fill_n(wx.data() + before + count, width - before - count, 0.F);
        }
        BoxShares box{.x = wx.data(),
                      .y = wy.data(),
                      .z = wz.data(),
                      .count = {width, static_cast<std::size_t>(y.last - y.first + 1),
                                static_cast<std::size_t>(z.last - z.first + 1)},
                      .row = static_cast<std::size_t>(n.x),
                      .layer = static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y),
                      .scale = scale,
                      .to = cells.data() + index_of(n, wide.first, y.first, z.first)};
        const std::size_t rest = width >= kWide ? width % kWide : 0;
        box.count[0] = width - rest;
        add_box(box);
        if (rest > 0) {
            box.x += width - rest;
            box.to += width - rest;
            box.count[0] = rest;
            add_box(box);
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

// The particles' extent along the axes, each to kGaussianCut s.
Lattice whole_box(const ParticleSet& particles, const glm::dvec3& u, const glm::dvec3& v,
                  const glm::dvec3& w, int count) {
    Lattice box{{}, u, v, w, {}, {}};
    const glm::dvec3 base = particles.center[0];
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 p = particles.center[i] - base;
        const glm::dvec3 q(glm::dot(p, u), glm::dot(p, v), glm::dot(p, w));
        const double reach = kGaussianCut * gaussian_s(particles, i);
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
    const float* row = cells.data();
    for (std::size_t k = 0; k < densest[2].size(); ++k)
        for (std::size_t j = 0; j < densest[1].size(); ++j, row += n.x) {
            float most = 0;
            for (std::size_t i = 0; i < densest[0].size(); ++i) {
                densest[0][i] = std::max(densest[0][i], row[i]);
                most = std::max(most, row[i]);
            }
            densest[1][j] = std::max(densest[1][j], most);
            densest[2][k] = std::max(densest[2][k], most);
        }
    return densest;
}

// Sum of |a[i] - b[i]|.
double difference_of(const float* a, const float* b, std::size_t count) {
    constexpr std::size_t kParts = 4;
    std::array<double, kParts> parts{};
    std::size_t i = 0;
    for (; i + kParts <= count; i += kParts)
        for (std::size_t p = 0; p < kParts; ++p)
            parts[p] += static_cast<double>(std::abs(a[i + p] - b[i + p]));
    for (; i < count; ++i) parts[0] += static_cast<double>(std::abs(a[i] - b[i]));
    return (parts[0] + parts[1]) + (parts[2] + parts[3]);
}

// MatterBox::length in cells. Beyond the outermost cells there is no matter.
glm::dvec3 lengths_of(const std::vector<float>& cells, const glm::ivec3& n) {
    const auto row = static_cast<std::size_t>(n.x);
    const std::size_t layer = row * static_cast<std::size_t>(n.y);
    const std::vector<float> nothing(row);
    double whole = 0;
    glm::dvec3 change(0);
    const float* at = cells.data();
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j, at += row) {
            const double sum = difference_of(at, nothing.data(), row);
            whole += sum;
            change.x +=
                difference_of(at + 1, at, row - 1) + static_cast<double>(at[0] + at[row - 1]);
            change.y += j > 0 ? difference_of(at, at - row, row) : sum;
            change.z += k > 0 ? difference_of(at, at - layer, row) : sum;
            if (j + 1 == n.y) change.y += sum;
            if (k + 1 == n.z) change.z += sum;
        }
    glm::dvec3 lengths(1);
    for (int axis = 0; axis < 3; ++axis)
        if (change[axis] > 0) lengths[axis] = whole / change[axis];
    return lengths;
}

}  // namespace

double lattice_work(const ParticleSet& particles, const glm::dvec3& cell, const glm::ivec3& cells) {
    double work = 0;
    for (const float radius : particles.radius) {
        const glm::dvec3 sides =
            glm::min(kGaussianCut * static_cast<double>(radius) / cell + 1.0, glm::dvec3(cells));
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

int spread_count(const glm::dvec3& size, int count, double most) {
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0)) return count;
    // However thin it is, there is a cell across it.
    const glm::dvec3 share = glm::max(size / longest, glm::dvec3(1 / (most * count)));
    constexpr double kCompactShare = 0.25;
    const double spread = exact::cbrt(kCompactShare / (share.x * share.y * share.z));
    return static_cast<int>(count * std::clamp(spread, 1.0, most));
}

Lattice fitted_cells(const MatterBox& box, int count) {
    const Lattice cubic = cubic_cells(box, count);
    const double longest = std::max({box.length.x, box.length.y, box.length.z});
    const glm::dvec3 flat =
        glm::clamp(kCompact * box.length / longest, glm::dvec3(kFlattest), glm::dvec3(1));
    if (flat == glm::dvec3(1)) return cubic;
    // About as many cells as a cubic lattice has: their common scale follows.
    const glm::dvec3 asked = box.size / (flat * cubic.cell);
    const double scale = exact::cbrt(asked.x * asked.y * asked.z /
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
