#include "core/truth/matter_columns.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/base/exact_math.h"
#include "core/base/float_runs.h"
#include "core/base/parallel.h"
#include "core/truth/lists.h"

namespace awan::truth {
namespace {

// Rows of a column: one at each of its nodes across the light.
constexpr int kRows = kBrickNodes * kBrickNodes;
// Extinction, and its product with each colour.
constexpr std::size_t kColoredChannels = 4;

struct Span {
    int first, last;
    bool any() const { return first <= last; }
};

// Nodes of first..last within `reach` of c.
Span covered(double c, double reach, int first, int last) {
    return {static_cast<int>(std::clamp(std::ceil(c - reach), static_cast<double>(first),
                                        static_cast<double>(last) + 1)),
            static_cast<int>(std::clamp(std::floor(c + reach), static_cast<double>(first) - 1,
                                        static_cast<double>(last)))};
}

// exp(-(k - c)^2 / 2 s^2) for k in the span: from its middle outwards, each from the one before, in double.
void profile(double c, double s, Span span, std::vector<float>& out) {
    out.resize(static_cast<std::size_t>(span.last - span.first + 1));
    const double per = 1 / (s * s), shrink = exact::exp(-per);
    const int middle = std::clamp(static_cast<int>(std::lround(c)), span.first, span.last);
    for (const int way : {1, -1}) {
        const double at = (middle - c) * way;
        double value = exact::exp(-0.5 * at * at * per);
        double ratio = exact::exp(-(at + 0.5) * per);
        for (int k = middle; k >= span.first && k <= span.last; k += way) {
            out[static_cast<std::size_t>(k - span.first)] = static_cast<float>(value);
            value *= ratio;
            ratio *= shrink;
        }
    }
}

// Wide Gaussians, on a lattice of twice the cell, the sun's axis first; by channel: extinction, and by colour.
struct Coarse {
    glm::ivec3 nodes{0};  // of the lattice, in the matter's order of axes
    std::vector<float> values[4];
};

// Everything that columns share.
struct Filling {
    const Matter& m;
    glm::ivec3 nodes;
    // Summed node by node.
    std::vector<LatticeGaussian> narrow;
    std::vector<glm::vec3> colors;
    Coarse coarse;
    std::size_t channels;
};

// Extinctions of a column's rows: channel, row, node along the light.
class Rows {
  public:
    Rows(std::size_t channels, int length)
        : length_(static_cast<std::size_t>(length)), values_(channels * kRows * length_) {}
    void clear() { std::fill(values_.begin(), values_.end(), 0.0f); }
    float* row(std::size_t channel, int x, int y) {
        return values_.data() +
               (channel * kRows + static_cast<std::size_t>(x * kBrickNodes + y)) * length_;
    }
    int length() const { return static_cast<int>(length_); }

  private:
    std::size_t length_;
    std::vector<float> values_;
};

void add_narrow(const Filling& f, std::size_t index, const glm::ivec2& first, Rows& rows,
                std::vector<float>& along) {
    const LatticeGaussian& g = f.narrow[index];
    const double reach = g.cut * g.s;
    const Span x = covered(g.center.x, reach, first.x, first.x + kBrick);
    const Span y = covered(g.center.y, reach, first.y, first.y + kBrick);
    if (!x.any() || !y.any()) return;
    // As far as it reaches in the row nearest to its centre; the others take what is there, 1e-5 of its peak at most.
    const double dx =
        std::clamp(g.center.x, static_cast<double>(x.first), static_cast<double>(x.last)) -
        g.center.x;
    const double dy =
        std::clamp(g.center.y, static_cast<double>(y.first), static_cast<double>(y.last)) -
        g.center.y;
    const double left = reach * reach - dx * dx - dy * dy;
    if (left <= 0) return;
    const Span z = covered(g.center.z, std::sqrt(left), 0, rows.length() - 1);
    if (!z.any()) return;
    profile(g.center.z, g.s, z, along);
    float across_x[kBrickNodes], across_y[kBrickNodes];
    const double per = 1 / (g.s * std::sqrt(2.0));
    for (int n = 0; n < kBrickNodes; ++n) {
        const auto u = static_cast<float>((first.x + n - g.center.x) * per);
        const auto v = static_cast<float>((first.y + n - g.center.y) * per);
        across_x[n] = exact::exp(-u * u) * static_cast<float>(g.peak);
        across_y[n] = exact::exp(-v * v);
    }
    for (int i = x.first; i <= x.last; ++i)
        for (int j = y.first; j <= y.last; ++j) {
            const float scale = across_x[i - first.x] * across_y[j - first.y];
            for (std::size_t c = 0; c < f.channels; ++c)
                add_scaled(rows.row(c, i - first.x, j - first.y) + z.first, along.data(),
                           c == 0 ? scale : scale * f.colors[index][static_cast<int>(c) - 1],
                           along.size());
        }
}

void add_coarse(const Filling& f, const glm::ivec2& first, Rows& rows, std::vector<float>& sum) {
    const glm::ivec3 n = f.coarse.nodes;
    if (n.x == 0) return;
    const auto length = static_cast<std::size_t>(n.z);
    for (std::size_t c = 0; c < f.channels; ++c)
        for (int i = 0; i < kBrickNodes; ++i)
            for (int j = 0; j < kBrickNodes; ++j) {
                sum.assign(length, 0.0f);
                const Refining x = refining(first.x + i), y = refining(first.y + j);
                for (int a = 0; a < x.count; ++a)
                    for (int b = 0; b < y.count; ++b) {
                        const int u = x.first + a, v = y.first + b;
                        if (u < 0 || v < 0 || u >= n.x || v >= n.y) continue;
                        const std::size_t row =
                            static_cast<std::size_t>(u) * static_cast<std::size_t>(n.y) +
                            static_cast<std::size_t>(v);
                        add_scaled(sum.data(), f.coarse.values[c].data() + row * length,
                                   x.weight[a] * y.weight[b], length);
                    }
                float* out = rows.row(c, i, j);
                add_refined_row(sum.data(), n.z, out, rows.length());
                // Cubic weights are partly negative: what undershoots 0 at a steep edge is no matter.
                for (int k = 0; k < rows.length(); ++k) out[k] = std::max(out[k], 0.0f);
            }
}

// The bricks of one x: their nodes, in order, to be joined with the others'.
struct Slab {
    std::vector<Node> nodes;
    std::vector<glm::vec3> tints;
};

// The brick from node `from` on along its column. depth: as the rows' extinctions, gathered. Bricks without matter get
// no nodes.
Brick made_brick(const Filling& f, Rows& rows, const std::vector<float>& depth, int from,
                 Slab& slab) {
    float most = 0;
    for (int i = 0; i < kBrickNodes; ++i)
        for (int j = 0; j < kBrickNodes; ++j) {
            const float* row = rows.row(0, i, j) + from;
            for (int k = 0; k < kBrickNodes; ++k) most = std::max(most, row[k]);
        }
    if (!(most > 0)) return {};
    Brick brick;
    // Interpolation rounds.
    brick.most = most * 1.00001f;
    if (f.m.detail)
        brick.most = static_cast<float>(
            f.m.cell * most_detailed(*f.m.detail, static_cast<double>(brick.most) / f.m.cell) *
            1.00001);
    brick.nodes = static_cast<std::uint32_t>(slab.nodes.size() / kBrickStride) & kNoNodes;
    const std::size_t first = slab.nodes.size();
    slab.nodes.resize(first + kBrickStride, Node{0, 0});
    if (f.channels > 1) slab.tints.resize(first + kBrickStride, glm::vec3(0));
    const auto length = static_cast<std::size_t>(rows.length());
    for (int i = 0; i < kBrickNodes; ++i)
        for (int j = 0; j < kBrickNodes; ++j)
            for (int k = 0; k < kBrickNodes; ++k) {
                const auto row = static_cast<std::size_t>(i * kBrickNodes + j);
                const std::size_t at = first + row * kBrickNodes + static_cast<std::size_t>(k);
                slab.nodes[at] = {rows.row(0, i, j)[from + k],
                                  depth[row * length + static_cast<std::size_t>(from + k)]};
                for (std::size_t c = 1; c < f.channels; ++c)
                    slab.tints[at][static_cast<int>(c) - 1] = rows.row(c, i, j)[from + k];
            }
    return brick;
}

// What a row gathers from its start on; with detail that of the lumps at its nodes.
void gather(const Filling& f, const glm::ivec2& first, Rows& rows, std::vector<float>& depth) {
    const auto length = static_cast<std::size_t>(rows.length());
    depth.resize(kRows * length);
    for (int i = 0; i < kBrickNodes; ++i)
        for (int j = 0; j < kBrickNodes; ++j) {
            const float* row = rows.row(0, i, j);
            float* out = depth.data() + static_cast<std::size_t>(i * kBrickNodes + j) * length;
            double sum = 0, before = 0;
            for (std::size_t k = 0; k < length; ++k) {
                const double now =
                    with_detail(f.m, row[k], {first.x + i, first.y + j, static_cast<double>(k)});
                sum += k == 0 ? 0 : 0.5 * (before + now);
                before = now;
                out[k] = static_cast<float>(sum);
            }
        }
}

// False: out of time.
bool fill_slab(const Filling& f, const std::vector<std::uint32_t>& near, int bx, Brick* bricks,
               Slab& slab, const std::atomic<bool>& stop, const Deadline& deadline) {
    const glm::ivec3 n = f.m.bricks;
    std::vector<std::uint32_t> begin, items;
    make_lists(static_cast<std::size_t>(n.y), near.size(), begin, items,
               [&](std::size_t i, const auto& put) {
                   const LatticeGaussian& g = f.narrow[near[i]];
                   const double reach = g.cut * g.s;
                   const Span y =
                       covered(g.center.y / kBrick - 0.5, reach / kBrick + 0.5, 0, n.y - 1);
                   for (int b = y.first; b <= y.last; ++b) put(static_cast<std::size_t>(b));
               });
    Rows rows(f.channels, f.nodes.z);
    std::vector<float> depth, scratch;
    for (int by = 0; by < n.y; ++by) {
        const auto column = static_cast<std::size_t>(by);
        if (begin[column] == begin[column + 1] && f.coarse.nodes.x == 0) continue;
        const glm::ivec2 first(bx * kBrick, by * kBrick);
        rows.clear();
        add_coarse(f, first, rows, scratch);
        for (std::uint32_t i = begin[column]; i < begin[column + 1]; ++i) {
            if (i % 256 == 0 && (stop.load(std::memory_order_relaxed) || deadline.over()))
                return false;
            add_narrow(f, near[items[i]], first, rows, scratch);
        }
        if (stop.load(std::memory_order_relaxed) || deadline.over()) return false;
        gather(f, first, rows, depth);
        for (int bz = 0; bz < n.z; ++bz)
            bricks[column * static_cast<std::size_t>(n.z) + static_cast<std::size_t>(bz)] =
                made_brick(f, rows, depth, bz * kBrick, slab);
    }
    return true;
}

Status sum_coarse(Filling& f, const OnLattice& wide, int threads, const Deadline& deadline) {
    if (wide.gaussians.empty()) return std::nullopt;
    f.coarse.nodes = f.nodes / 2 + 3;
    std::vector<LatticeGaussian> turned;
    for (std::size_t c = 0; c < f.channels; ++c) {
        turned = wide.gaussians;
        for (std::size_t i = 0; i < turned.size(); ++i) {
            LatticeGaussian& g = turned[i];
            g.center = 0.5 * glm::dvec3(g.center.z, g.center.y, g.center.x);
            g.s *= 0.5;
            if (c > 0) g.peak *= static_cast<double>(wide.colors[i][static_cast<int>(c) - 1]);
        }
        const glm::ivec3 n = f.coarse.nodes;
        auto sums = sum_at_nodes({n.z, n.y, n.x}, turned, threads, deadline);
        if (!sums.ok()) return sums.error();
        f.coarse.values[c] = *std::move(sums);
    }
    return std::nullopt;
}

}  // namespace

Status fill_bricks(Matter& m, const OnLattice& matter, int threads, const Deadline& deadline) {
    const glm::ivec3 n = m.bricks;
    m.brick.assign(m.column(n.x, 0) * static_cast<std::size_t>(n.z), Brick{});
    if (matter.gaussians.empty()) return std::nullopt;
    Filling f{m, n * kBrick + 1, {}, {}, {}, m.colored ? kColoredChannels : 1};
    OnLattice wide;
    for (std::size_t i = 0; i < matter.gaussians.size(); ++i) {
        const LatticeGaussian g = narrowed(matter.gaussians[i]);
        const bool is_wide = g.s >= kWide;
        (is_wide ? wide.gaussians : f.narrow).push_back(g);
        (is_wide ? wide.colors : f.colors).push_back(matter.colors[i]);
    }
    if (auto error = sum_coarse(f, wide, threads, deadline)) return error;

    const auto slabs = static_cast<std::size_t>(n.x);
    std::vector<std::uint32_t> begin, items;
    make_lists(slabs, f.narrow.size(), begin, items, [&](std::size_t i, const auto& put) {
        const LatticeGaussian& g = f.narrow[i];
        const double reach = g.cut * g.s;
        const Span x = covered(g.center.x / kBrick - 0.5, reach / kBrick + 0.5, 0, n.x - 1);
        for (int b = x.first; b <= x.last; ++b) put(static_cast<std::size_t>(b));
    });
    std::vector<Slab> made(slabs);
    const std::size_t per_slab = m.column(1, 0) * static_cast<std::size_t>(n.z);
    std::atomic<bool> stop{false};
    parallel_for(threads, slabs, [&](std::size_t i) {
        if (stop.load(std::memory_order_relaxed)) return;
        const std::vector<std::uint32_t> near(items.begin() + begin[i],
                                              items.begin() + begin[i + 1]);
        if (!fill_slab(f, near, static_cast<int>(i), m.brick.data() + i * per_slab, made[i], stop,
                       deadline))
            stop = true;
    });
    if (stop) {
        if (auto error = deadline.over()) return error;
        return Error{ErrorCode::kOverDeadline, "", "the reference ran out of time"};
    }

    std::size_t total = 0;
    for (const Slab& slab : made) total += slab.nodes.size();
    m.nodes.reserve(total);
    if (m.colored) m.tints.reserve(total);
    for (std::size_t i = 0; i < slabs; ++i) {
        const auto before = static_cast<std::uint32_t>(m.nodes.size() / kBrickStride);
        for (std::size_t b = i * per_slab; b < (i + 1) * per_slab; ++b)
            if (m.brick[b].nodes != kNoNodes)
                m.brick[b].nodes = (m.brick[b].nodes + before) & kNoNodes;
        m.nodes.insert(m.nodes.end(), made[i].nodes.begin(), made[i].nodes.end());
        m.tints.insert(m.tints.end(), made[i].tints.begin(), made[i].tints.end());
        made[i] = {};
    }
    return std::nullopt;
}

}  // namespace awan::truth
