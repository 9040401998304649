#include "core/truth/lattice.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/exact_math.h"
#include "core/base/float_runs.h"
#include "core/base/parallel.h"

namespace awan::truth {
namespace {

// Planes that one thread sums at a time.
constexpr int kSlab = 4;

std::size_t count(const glm::ivec3& n) {
    return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
           static_cast<std::size_t>(n.z);
}

// exp(-(i - c)^2 / 2 s^2) for i = first..last.
void profile(std::vector<float>& out, double c, double s, int first, int last) {
    out.resize(static_cast<std::size_t>(std::max(last - first + 1, 0)));
    const float scale = static_cast<float>(1 / (s * std::sqrt(2.0)));
    for (int i = first; i <= last; ++i) {
        const float x = static_cast<float>(i - c) * scale;
        out[static_cast<std::size_t>(i - first)] = exact::exp(-x * x);
    }
}

struct Range {
    int first, last;
};
Range covered(double c, double reach, int first, int last) {
    return {static_cast<int>(std::clamp(std::ceil(c - reach), static_cast<double>(first),
                                        static_cast<double>(last) + 1)),
            static_cast<int>(std::clamp(std::floor(c + reach), static_cast<double>(first) - 1,
                                        static_cast<double>(last)))};
}

void add_to_slab(float* values, const glm::ivec3& nodes, const LatticeGaussian& g, Range slab,
                 std::vector<float> (&profiles)[3]) {
    const double reach = g.cut * g.s;
    const Range z = covered(g.center.z, reach, slab.first, slab.last);
    if (z.first > z.last) return;
    const Range y = covered(g.center.y, reach, 0, nodes.y - 1);
    profile(profiles[1], g.center.y, g.s, y.first, y.last);
    profile(profiles[2], g.center.z, g.s, z.first, z.last);
    const Range all_x = covered(g.center.x, reach, 0, nodes.x - 1);
    profile(profiles[0], g.center.x, g.s, all_x.first, all_x.last);
    for (int k = z.first; k <= z.last; ++k) {
        const double dz = k - g.center.z;
        for (int j = y.first; j <= y.last; ++j) {
            const double dy = j - g.center.y;
            const double left = reach * reach - dz * dz - dy * dy;
            if (left <= 0) continue;
            const Range x = covered(g.center.x, std::sqrt(left), all_x.first, all_x.last);
            const float scale = static_cast<float>(g.peak) *
                                profiles[1][static_cast<std::size_t>(j - y.first)] *
                                profiles[2][static_cast<std::size_t>(k - z.first)];
            float* row =
                values + static_cast<std::size_t>(nodes.x) *
                             (static_cast<std::size_t>(j) +
                              static_cast<std::size_t>(nodes.y) * static_cast<std::size_t>(k));
            add_scaled(row + x.first, profiles[0].data() + (x.first - all_x.first), scale,
                       static_cast<std::size_t>(x.last - x.first + 1));
        }
    }
}

std::optional<Error> add_level(std::vector<float>& values, const glm::ivec3& nodes,
                               std::span<const LatticeGaussian> gaussians, int threads,
                               const Deadline& deadline) {
    const auto slabs = static_cast<std::size_t>((nodes.z + kSlab - 1) / kSlab);
    std::atomic<bool> stop{false};
    parallel_for(threads, slabs, [&](std::size_t slab) {
        std::vector<float> profiles[3];
        const int first = static_cast<int>(slab) * kSlab;
        const Range planes{first, std::min(first + kSlab, nodes.z) - 1};
        for (std::size_t i = 0; i < gaussians.size(); ++i) {
            if (i % 256 == 0 && (stop.load(std::memory_order_relaxed) || deadline.over())) {
                stop = true;
                return;
            }
            add_to_slab(values.data(), nodes, gaussians[i], planes, profiles);
        }
    });
    return stop ? deadline.over() : std::nullopt;
}

// Adds a lattice of twice the cell to `fine`, one axis after the other. Beyond its edge a lattice is 0.
void refine_axis(const std::vector<float>& from, std::size_t stride, std::size_t length,
                 std::size_t fine_length, std::vector<float>& to) {
    const std::size_t outer = from.size() / (stride * length);
    to.assign(outer * fine_length * stride, 0.0f);
    for (std::size_t o = 0; o < outer; ++o)
        for (std::size_t i = 0; i < fine_length; ++i) {
            float* out = to.data() + (o * fine_length + i) * stride;
            const Refining rule = refining(static_cast<int>(i));
            for (int n = 0; n < rule.count; ++n) {
                const int node = rule.first + n;
                if (node < 0 || node >= static_cast<int>(length)) continue;
                add_scaled(out,
                           from.data() + (o * length + static_cast<std::size_t>(node)) * stride,
                           rule.weight[n], stride);
            }
        }
}

// Along x the rows are too short a stride for add_scaled.
void refine_rows(const std::vector<float>& from, std::size_t length, std::size_t fine_length,
                 std::vector<float>& to) {
    const std::size_t outer = from.size() / length;
    to.assign(outer * fine_length, 0.0f);
    for (std::size_t o = 0; o < outer; ++o)
        add_refined_row(from.data() + o * length, static_cast<int>(length),
                        to.data() + o * fine_length, static_cast<int>(fine_length));
}

void add_refined(const std::vector<float>& coarse, const glm::ivec3& n, std::vector<float>& fine,
                 const glm::ivec3& m) {
    std::vector<float> a, b;
    refine_rows(coarse, static_cast<std::size_t>(n.x), static_cast<std::size_t>(m.x), a);
    const auto row = static_cast<std::size_t>(m.x);
    refine_axis(a, row, static_cast<std::size_t>(n.y), static_cast<std::size_t>(m.y), b);
    refine_axis(b, row * static_cast<std::size_t>(m.y), static_cast<std::size_t>(n.z),
                static_cast<std::size_t>(m.z), a);
    // Cubic weights are partly negative: what undershoots 0 at a steep edge is no matter.
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = std::max(fine[i] + a[i], 0.0f);
}

}  // namespace

LatticeGaussian narrowed(const LatticeGaussian& gaussian) {
    LatticeGaussian g = gaussian;
    const double wide = std::max(g.s, kNarrowest);
    const double narrow = std::sqrt(wide * wide - 1.0 / 6);
    g.peak *= exact::pow(g.s / narrow, 3);
    g.cut *= wide / narrow;
    g.s = narrow;
    return g;
}

Refining refining(int i) {
    if (i % 2 == 0) return {i / 2, 1, {1, 0, 0, 0}};
    return {i / 2 - 1, 4, {-0.0625f, 0.5625f, 0.5625f, -0.0625f}};
}

void add_refined_row(const float* coarse, int length, float* fine, int count) {
    const auto at = [&](int i) { return i >= 0 && i < length ? coarse[i] : 0.0f; };
    for (int i = 0; i < count; ++i) {
        const int c = i / 2;
        fine[i] +=
            i % 2 == 0 ? at(c) : 0.5625f * (at(c) + at(c + 1)) - 0.0625f * (at(c - 1) + at(c + 2));
    }
}

Result<std::vector<float>> sum_at_nodes(const glm::ivec3& nodes,
                                        std::span<const LatticeGaussian> gaussians, int threads,
                                        const Deadline& deadline) {
    std::vector<std::vector<LatticeGaussian>> levels(1);
    for (LatticeGaussian g : gaussians) {
        std::size_t level = 0;
        double scale = 1;
        while (g.s / scale >= kWide && level < 12) {
            scale *= 2;
            ++level;
        }
        g.s /= scale;
        g.center /= scale;
        if (levels.size() <= level) levels.resize(level + 1);
        levels[level].push_back(g);
    }
    // A level's nodes reach at least as far as the finer one's.
    std::vector<glm::ivec3> size{nodes};
    while (size.size() < levels.size()) size.push_back(size.back() / 2 + 1);

    std::vector<float> coarse;
    for (std::size_t level = levels.size(); level-- > 0;) {
        std::vector<float> values(count(size[level]), 0.0f);
        if (auto error = add_level(values, size[level], levels[level], threads, deadline))
            return *error;
        if (auto error = deadline.over()) return *error;
        if (!coarse.empty()) add_refined(coarse, size[level + 1], values, size[level]);
        coarse = std::move(values);
    }
    return coarse;
}

}  // namespace awan::truth
