#include "core/survey/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/generate/gaussian.h"
#include "core/parallel.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

constexpr double kCut = 4;           // in s
constexpr int kCoarse = 32;          // cells of the volume that finds the box
constexpr double kCoarseWork = 1e7;  // of it; about 10 ms
constexpr std::size_t kSlabs = 16;   // units of work, fixed so that threads do not show

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

// Shares of a Gaussian's mass in a span of cells along one axis. The whole within +-kCut s is 1.
void weights_of(double center, double s, double cell, Span span, float* weights) {
    static const double none = normal_cdf(-kCut), all = normal_cdf(kCut), whole = all - none;
    const auto below = [&](int edge) {  // a small particle's ends need no error function
        const double at = (edge * cell - center) / s;
        return at <= -kCut ? none : at >= kCut ? all : normal_cdf(at);
    };
    double previous = below(span.first);
    for (int i = span.first; i <= span.last; ++i) {
        const double next = below(i + 1);
        *weights++ = static_cast<float>((next - previous) / whole);
        previous = next;
    }
}

__attribute__((target_clones("avx512f", "avx2", "default"))) void add_scaled(float* to,
                                                                             const float* from,
                                                                             float scale,
                                                                             std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) to[i] += scale * from[i];
}

// Adds the particles to the cells of layers [first, last) along w. weight(i): mass of particle i.
template <typename Mass>
void add_layers(const ParticleSet& particles, const Lattice& lattice, int first, int last,
                const Mass& mass_of, std::vector<float>& cells) {
    const glm::ivec3 n = lattice.cells;
    const double volume = lattice.cell * lattice.cell * lattice.cell;
    std::vector<float> wx(static_cast<std::size_t>(n.x)), wy(static_cast<std::size_t>(n.y)),
        wz(static_cast<std::size_t>(n.z));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i);
        const glm::dvec3 apart = particles.center[i] - lattice.origin;
        const double cz = glm::dot(apart, lattice.w);
        Span z = span_of(cz, kCut * s, lattice.cell, n.z);
        z.first = std::max(z.first, first);
        z.last = std::min(z.last, last - 1);
        if (z.empty()) continue;
        const double cx = glm::dot(apart, lattice.u), cy = glm::dot(apart, lattice.v);
        const Span x = span_of(cx, kCut * s, lattice.cell, n.x);
        const Span y = span_of(cy, kCut * s, lattice.cell, n.y);
        if (x.empty() || y.empty()) continue;
        const double mass = mass_of(i);
        if (!(mass > 0)) continue;
        weights_of(cx, s, lattice.cell, x, wx.data());
        weights_of(cy, s, lattice.cell, y, wy.data());
        weights_of(cz, s, lattice.cell, z, wz.data());
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
    parallel_for(threads, kSlabs, [&](std::size_t slab) {
        const auto edge = [&](std::size_t i) {
            return static_cast<int>(i * static_cast<std::size_t>(layers) / kSlabs);
        };
        if (edge(slab) < edge(slab + 1))
            add_layers(particles, lattice, edge(slab), edge(slab + 1), mass, cells);
    });
    return cells;
}

// The particles' extent along the axes, each to kCut s.
Lattice whole_box(const ParticleSet& particles, const glm::dvec3& u, const glm::dvec3& v,
                  const glm::dvec3& w, int count) {
    Lattice box{{}, u, v, w, 0, {}};
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
    box.cell = std::max({size.x, size.y, size.z}) / count;
    box.cells =
        glm::clamp(glm::ivec3(glm::ceil(size / box.cell)), glm::ivec3(1), glm::ivec3(count));
    box.origin = base + low.x * u + low.y * v + low.z * w;
    return box;
}

}  // namespace

double lattice_work(const ParticleSet& particles, double cell, const glm::ivec3& cells) {
    double work = 0;
    for (const float radius : particles.radius) {
        const double side = kCut * static_cast<double>(radius) / cell + 1;
        work += std::min(side, static_cast<double>(cells.x)) *
                std::min(side, static_cast<double>(cells.y)) *
                std::min(side, static_cast<double>(cells.z));
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

Lattice lattice_around_matter(const ParticleSet& particles, const glm::dvec3& u,
                              const glm::dvec3& v, const glm::dvec3& w, double rest, int count,
                              int threads) {
    int coarse = kCoarse;
    Lattice box = whole_box(particles, u, v, w, coarse);
    while (coarse > 4 && lattice_work(particles, box.cell, box.cells) > kCoarseWork) {
        coarse = coarse * 3 / 4;
        box = whole_box(particles, u, v, w, coarse);
    }
    const std::vector<float> cells = extinction_in(particles, box, threads);
    // Layers that could be left out: the longest line in them stays below `rest`.
    const glm::ivec3 n = box.cells;
    std::array<std::vector<float>, 3> densest;
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
    const double longest = box.cell * std::max({n.x, n.y, n.z});
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
    Lattice found{box.at(glm::dvec3(first)), u, v, w, 0, {}};
    const glm::dvec3 size = box.cell * glm::dvec3(last - first + 1);
    found.cell = std::max({size.x, size.y, size.z}) / count;
    found.cells = glm::clamp(glm::ivec3(glm::ceil(size / found.cell - 1e-6)), glm::ivec3(1),
                             glm::ivec3(count));
    // Cells are cubic: what they are too long is shared by both ends.
    const glm::dvec3 spare = 0.5 * (glm::dvec3(found.cells) * found.cell - size);
    found.origin -= spare.x * u + spare.y * v + spare.z * w;
    return found;
}

}  // namespace awan
