#include "core/draw/march_bins.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/draw/march_levels.h"
#include "core/generate/gaussian.h"
#include "core/survey/narrow.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Where a Gaussian is cut off: at this optical depth of lines through it, within these limits in standard deviations.
constexpr double kFaintDepth = 3e-5;
constexpr double kLeastCut = 3.8, kMostCut = 9;
constexpr std::size_t kMaxEntries = 1u << 23;  // of the lists, 4 bytes each
constexpr std::size_t kShare = 4096;           // particles that a thread takes at a time

// Blocks that see slopes low..high: those whose pixels' middles do, or with `all` those that have any of it.
bool blocks_along(Interval slopes, double tangent, int pixels, bool up, bool all,
                  std::int16_t& first, std::int16_t& last) {
    const PixelSpan seen = pixels_between(slopes, tangent, pixels, up);
    int low = seen.first, high = seen.last;
    if (all) {
        if (seen.low > seen.high || seen.high < -0.5 || seen.low > pixels - 0.5) return false;
        low = std::max(static_cast<int>(std::floor(seen.low + 0.5)), 0);
        high = std::min(static_cast<int>(std::floor(seen.high + 0.5)), pixels - 1);
    }
    if (low > high) return false;
    first = static_cast<std::int16_t>(low / kBlockSide);
    last = static_cast<std::int16_t>(high / kBlockSide);
    return true;
}

// A particle as it is, before it is decided how closely rays stand.
struct Own {
    SeenParticle seen{};
    double s = 0;      // scene units
    double depth = 0;  // through its centre
};

// Widens it to what rays at its level see, and finds where it is seen. False: it is not in the picture.
bool place(const Own& own, const View& view, int width, int height, SeenParticle& seen) {
    const double pixel = 2 * view.tan_half_fov / height;
    const double gap = std::ldexp(pixel * std::max(0.0, seen.q.z), -seen.level);
    const double s = std::max({own.s, kLeastWidth * gap, 1e-12});
    const double depth = widened_depth(own.depth, s / own.s);
    if (!(depth > 0)) return false;
    const double cut = std::clamp(std::sqrt(2 * exact::log(std::max(1.0, depth / kFaintDepth))),
                                  kLeastCut, kMostCut);
    seen.s = static_cast<float>(s);
    seen.reach = static_cast<float>(s * cut);
    seen.nearest = glm::length(seen.q) - s * cut;
    // On a line through the centre exp(-cut^2 / 2) of the mass beside it lies beyond the cut.
    seen.extinction = static_cast<float>(depth / (s * std::sqrt(2 * std::numbers::pi)) /
                                         -exact::expm1(-cut * cut / 2));
    const Interval x = disc_slopes(seen.q.x, seen.q.z, s * cut);
    const Interval y = disc_slopes(seen.q.y, seen.q.z, s * cut);
    const bool all = seen.level > 0;
    return blocks_along(x, view.tan_half_fov * view.aspect, width, false, all, seen.blocks.first_x,
                        seen.blocks.last_x) &&
           blocks_along(y, view.tan_half_fov, height, true, all, seen.blocks.first_y,
                        seen.blocks.last_y);
}

// With rays a pixel apart, and the level that it asks for. False: it is not in the picture.
bool see(const ParticleSet& particles, std::size_t i, const View& view, int width, int height,
         Own& own) {
    const glm::dvec3 p = particles.center[i] - view.eye;
    own.seen.q = {glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward)};
    own.s = gaussian_s(particles, i);
    own.depth = central_depth(particles, i);
    if (!(own.s > 0) || !(own.depth > 0)) return false;
    own.seen.level = 0;
    if (!place(own, view, width, height, own.seen)) return false;
    const double pixel = 2 * view.tan_half_fov / height * std::max(0.0, own.seen.q.z);
    own.seen.level = level_for(own.s / pixel, least_width(own.depth));
    return true;
}

std::vector<NarrowParticle> narrow_of(const std::vector<std::vector<Own>>& parts) {
    std::vector<NarrowParticle> narrow;
    for (const std::vector<Own>& part : parts)
        for (const Own& own : part)
            if (own.seen.level > 0) narrow.push_back({own.seen.q, own.seen.level, own.seen.blocks});
    return narrow;
}

}  // namespace

int blocks_in(int pixels) {
    return (pixels + kBlockSide - 1) / kBlockSide;
}

std::vector<SeenParticle> see_particles(const ParticleSet& particles, const View& view, int width,
                                        int height, int threads, double share_of_work) {
    const std::size_t shares = (particles.size() + kShare - 1) / kShare;
    std::vector<std::vector<Own>> parts(shares);
    parallel_for(threads, shares, [&](std::size_t share) {
        const std::size_t end = std::min(particles.size(), (share + 1) * kShare);
        for (std::size_t i = share * kShare; i < end; ++i) {
            Own own;
            if (see(particles, i, view, width, height, own)) parts[share].push_back(own);
        }
    });
    const std::vector<std::uint8_t> levels =
        affordable_levels(narrow_of(parts), view, width, height, share_of_work);
    std::vector<SeenParticle> all;
    std::size_t narrow = 0;
    for (auto& part : parts) {
        for (Own& own : part) {
            if (own.seen.level > 0) {
                own.seen.level = levels[narrow++];
                if (!place(own, view, width, height, own.seen)) continue;
            }
            all.push_back(own.seen);
        }
        std::vector<Own>().swap(part);
    }
    std::stable_sort(all.begin(), all.end(), [](const SeenParticle& a, const SeenParticle& b) {
        return a.nearest < b.nearest;
    });
    return all;
}

void for_each_block(const std::vector<SeenParticle>& seen, int width, int height, int threads,
                    const BlockWork& work, std::span<const std::uint8_t> wanted) {
    const int across = blocks_in(width), down = blocks_in(height);
    std::vector<std::size_t> of_row(static_cast<std::size_t>(down) + 1);
    for (const SeenParticle& particle : seen) {  // differences, then sums
        ++of_row[static_cast<std::size_t>(particle.blocks.first_y)];
        --of_row[static_cast<std::size_t>(particle.blocks.last_y) + 1];
    }
    for (std::size_t y = 1; y < of_row.size(); ++y) of_row[y] += of_row[y - 1];

    for (int top = 0; top < down;) {
        int end = top;
        std::vector<std::vector<std::uint32_t>> rows;
        for (std::size_t entries = 0; end < down; ++end) {
            const std::size_t more = of_row[static_cast<std::size_t>(end)];
            if (end > top && entries + more > kMaxEntries) break;
            entries += more;
            rows.emplace_back().reserve(more);
        }
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const BlockBox& box = seen[i].blocks;
            for (int y = std::max<int>(top, box.first_y); y <= std::min<int>(end - 1, box.last_y);
                 ++y)
                rows[static_cast<std::size_t>(y - top)].push_back(static_cast<std::uint32_t>(i));
        }
        const auto count = static_cast<std::size_t>(end - top) * static_cast<std::size_t>(across);
        parallel_for(threads, count, [&](std::size_t block) {
            if (!wanted.empty() &&
                wanted[static_cast<std::size_t>(top) * static_cast<std::size_t>(across) + block] ==
                    0)
                return;
            const std::size_t row = block / static_cast<std::size_t>(across);
            const int x = static_cast<int>(block % static_cast<std::size_t>(across));
            std::vector<std::uint32_t> items;
            for (const std::uint32_t i : rows[row])
                if (seen[i].blocks.first_x <= x && seen[i].blocks.last_x >= x) items.push_back(i);
            work(x, top + static_cast<int>(row), items);
        });
        top = end;
    }
}

std::vector<std::uint8_t> sample_blocks(const std::vector<SeenParticle>& seen, int width,
                                        int height, int count) {
    const int across = blocks_in(width), down = blocks_in(height);
    const auto columns = static_cast<std::size_t>(across) + 1;
    // How many particles touch each block: differences along both axes, then sums.
    std::vector<std::int32_t> touching(columns * (static_cast<std::size_t>(down) + 1));
    const auto at = [&](int x, int y) -> std::int32_t& {
        return touching[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)];
    };
    for (const SeenParticle& particle : seen) {
        const BlockBox& box = particle.blocks;
        ++at(box.first_x, box.first_y);
        --at(box.last_x + 1, box.first_y);
        --at(box.first_x, box.last_y + 1);
        ++at(box.last_x + 1, box.last_y + 1);
    }
    for (int y = 0; y < down; ++y)
        for (int x = 1; x < across; ++x) at(x, y) += at(x - 1, y);
    for (int y = 1; y < down; ++y)
        for (int x = 0; x < across; ++x) at(x, y) += at(x, y - 1);
    struct Touched {
        std::uint64_t place;
        std::size_t block;
    };
    std::vector<Touched> touched;
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x)
            if (at(x, y) > 0)
                touched.push_back(
                    {morton_place(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                     static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                         static_cast<std::size_t>(x)});
    std::sort(touched.begin(), touched.end(),
              [](const Touched& a, const Touched& b) { return a.place < b.place; });
    std::vector<std::uint8_t> chosen(static_cast<std::size_t>(across) *
                                     static_cast<std::size_t>(down));
    // One of each share of the curve, in none at the same place: the curve repeats itself, and clouds might.
    const std::size_t most = std::min(touched.size(), static_cast<std::size_t>(count));
    const double share = static_cast<double>(touched.size()) / static_cast<double>(most);
    constexpr double kGolden = 0.618033988749895;
    for (std::size_t i = 0; i < most; ++i) {
        const double within = kGolden * static_cast<double>(i) + 0.5;
        const double at = share * (static_cast<double>(i) + within - std::floor(within));
        chosen[touched[std::min(static_cast<std::size_t>(at), touched.size() - 1)].block] = 1;
    }
    return chosen;
}

}  // namespace awan
