#include "core/draw/splat_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "core/draw/billboards.h"
#include "core/draw/march_levels.h"
#include "core/survey/narrow.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// A window is looked at by squares of so many pixels; each has at most one part.
constexpr int kSquare = 128;
// Pixels of a part at most; those of a square at level 1 are fewer.
constexpr double kMostPixels = 1 << 20;
// What a part costs beside its pixels and particles, as pixels.
constexpr double kPixelsOfPart = 4096;
// Beyond a narrow particle's own reach, in the window's pixels: what it is widened by on pixels an eighth as wide.
constexpr double kMargin = 3.5 * kLeastWidth / 8;

// Pixels, both ends included; none where last < first.
struct PixelBox {
    int left = 0, top = 0, right = -1, bottom = -1;
    bool any() const { return right >= left && bottom >= top; }
};

PixelBox both(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
            std::min(a.bottom, b.bottom)};
}

// The pixels of which a disc covers any part, and `margin` pixels around it.
PixelBox pixels_of(const Footprint& own, const SplatWindow& window, double margin) {
    const auto side = [&](double x, double middle, double tangent, int pixels, bool up) {
        const Interval s = disc_slopes(x, own.q.z, own.reach);
        const PixelSpan span =
            pixels_between({s.low - middle, s.high - middle}, tangent, pixels, up);
        if (span.low > span.high || span.high < -0.5 - margin || span.low > pixels - 0.5 + margin)
            return std::array{0, -1};
        const double last = pixels - 1;
        return std::array{
            static_cast<int>(std::clamp(std::floor(span.low + 0.5 - margin), 0.0, last)),
            static_cast<int>(std::clamp(std::floor(span.high + 0.5 + margin), 0.0, last))};
    };
    const auto x = side(own.q.x, window.middle.x, window.tangent.x, window.width, false);
    const auto y = side(own.q.y, window.middle.y, window.tangent.y, window.height, true);
    return {x[0], y[0], x[1], y[1]};
}

struct Placed {
    PixelBox box;
    std::uint8_t level = 0;  // that a narrow particle asks for
};

Placed place(const ParticleSet& particles, std::size_t i, bool painted, const View& view,
             const SplatWindow& window) {
    Footprint own = footprint_of(particles, i, view);
    if (!own.seen) return {};
    Placed placed;
    const double pixel = window.gap() * own.q.z;
    const bool is_billboard = painted && particles.paint[i].texture != 0;
    if (is_billboard)
        own.reach = std::numbers::sqrt2 * std::max(kBillboardReach * own.s, pixel);
    else if (own.q.z > 0 && own.distance > own.reach && own.s < 3 * pixel)
        placed.level = level_for(own.s / pixel, least_width(own.tau));
    placed.box = pixels_of(own, window, placed.level > 0 ? kMargin : 0);
    return placed;
}

// The window's squares, and what a part in each would be.
struct Square {
    PixelBox box;
    int level = 0;  // that its narrow particles ask for
    // Of the particles that reach into the box: their number, and sums of the area, width and height of what they cover
    // of it, pixels.
    double count = 0, area = 0, width = 0, height = 0;
};

struct Squares {
    int across, down;
    std::vector<Square> list;
    template <typename Visit>
    void visit(const PixelBox& box, const Visit& visit) {
        if (!box.any()) return;
        for (int y = box.top / kSquare; y <= box.bottom / kSquare; ++y)
            for (int x = box.left / kSquare; x <= box.right / kSquare; ++x) {
                const PixelBox own{x * kSquare, y * kSquare, x * kSquare + kSquare - 1,
                                   y * kSquare + kSquare - 1};
                visit(static_cast<std::size_t>(y * across + x), both(box, own));
            }
    }
};

double pixels_at(const Square& square, int level) {
    const PixelBox& box = square.box;
    return std::ldexp(static_cast<double>(box.right - box.left + 1) * (box.bottom - box.top + 1),
                      2 * level);
}

// What a part costs. A rectangle of w x h pixels touches (w / 8 + 1) (h / 16 + 1) tiles of 8 x 16 in the mean over its
// places.
SplatBudget cost_of(const Square& square, int level) {
    const double tiles =
        std::ldexp(square.area, 2 * level) / (kTileWidth * kTileHeight) +
        std::ldexp(square.width / kTileWidth + square.height / kTileHeight, level) + square.count;
    return {pixels_at(square, level) + kPixelsOfPart, tiles};
}

int level_of(const Square& square, int limit) {
    int level = std::min(square.level, limit);
    while (level > 0 && pixels_at(square, level) > kMostPixels) --level;
    return level;
}

// One limit on the levels of all parts, so that no border shows where the work came to its end.
int affordable_limit(const Squares& squares, const SplatBudget& budget) {
    int limit = kMostLevel;
    for (; limit > 0; --limit) {
        SplatBudget cost{0, 0};
        for (const Square& square : squares.list) {
            if (square.level == 0) continue;
            const SplatBudget own = cost_of(square, level_of(square, limit));
            cost.pixels += own.pixels;
            cost.entries += own.entries;
        }
        if (cost.pixels <= budget.pixels && cost.entries <= budget.entries) break;
    }
    return limit;
}

}  // namespace

SplatBudget splat_budget(const ImageSettings& image, std::size_t particles) {
    return {4.0 * image.width * image.height + (1 << 18),
            8.0 * static_cast<double>(particles) + (1 << 14)};
}

SplatParts divide(const ParticleSet& particles, bool painted, const View& view,
                  const SplatWindow& window, std::vector<std::uint32_t> order,
                  const SplatBudget& budget) {
    std::vector<Placed> placed(order.size());
    Squares squares{
        (window.width + kSquare - 1) / kSquare, (window.height + kSquare - 1) / kSquare, {}};
    squares.list.resize(static_cast<std::size_t>(squares.across) *
                        static_cast<std::size_t>(squares.down));
    bool any = false;
    for (std::size_t n = 0; n < order.size(); ++n) {
        placed[n] = place(particles, order[n], painted, view, window);
        if (placed[n].level == 0) continue;
        any = any || placed[n].box.any();
        squares.visit(placed[n].box, [&](std::size_t at, const PixelBox& box) {
            Square& square = squares.list[at];
            if (square.level == 0) square.box = box;
            square.box = {std::min(square.box.left, box.left), std::min(square.box.top, box.top),
                          std::max(square.box.right, box.right),
                          std::max(square.box.bottom, box.bottom)};
            square.level = std::max(square.level, static_cast<int>(placed[n].level));
        });
    }
    if (!any) return {{}, std::move(order)};

    for (const Placed& one : placed)
        squares.visit(one.box, [&](std::size_t at, const PixelBox&) {
            Square& square = squares.list[at];
            if (square.level == 0) return;
            const PixelBox box = both(one.box, square.box);
            if (!box.any()) return;
            const double width = box.right - box.left + 1, height = box.bottom - box.top + 1;
            square.count += 1;
            // At the level of its part a narrow particle is about as wide as the tiles are.
            if (one.level > 0) return;
            square.area += width * height;
            square.width += width;
            square.height += height;
        });
    const int limit = affordable_limit(squares, budget);
    if (limit == 0) return {{}, std::move(order)};

    SplatParts divided;
    std::vector<int> part_of(squares.list.size(), -1);
    SplatBudget spent{0, 0};
    for (std::size_t at = 0; at < squares.list.size(); ++at) {
        const Square& square = squares.list[at];
        if (square.level == 0) continue;
        part_of[at] = static_cast<int>(divided.parts.size());
        const int level = level_of(square, limit);
        const PixelBox& box = square.box;
        const SplatBudget cost = cost_of(square, level);
        spent.pixels += cost.pixels;
        spent.entries += cost.entries;
        divided.parts.push_back({box.left,
                                 box.top,
                                 box.right - box.left + 1,
                                 box.bottom - box.top + 1,
                                 level,
                                 {},
                                 cost});
    }
    // What is left is shared as the cost was.
    for (SplatPart& part : divided.parts) {
        part.left_over.pixels *= budget.pixels / spent.pixels - 1;
        part.left_over.entries *= budget.entries / spent.entries - 1;
    }
    for (std::size_t n = 0; n < order.size(); ++n) {
        if (placed[n].level == 0) divided.rest.push_back(order[n]);
        squares.visit(placed[n].box, [&](std::size_t at, const PixelBox& box) {
            if (part_of[at] < 0 || !both(box, squares.list[at].box).any()) return;
            divided.parts[static_cast<std::size_t>(part_of[at])].order.push_back(order[n]);
        });
    }
    return divided;
}

SplatWindow window_of(const SplatPart& part, const SplatWindow& in) {
    const glm::dvec2 size(in.width, in.height);
    // From the window's middle, in pixels.
    const glm::dvec2 middle(part.left + part.width / 2.0 - size.x / 2,
                            size.y / 2 - (part.top + part.height / 2.0));
    const glm::dvec2 pixel = 2.0 * in.tangent / size;
    return {in.middle + middle * pixel, 0.5 * pixel * glm::dvec2(part.width, part.height),
            part.width << part.level, part.height << part.level, in.picture_gap};
}

void put_mean(const Image& fine, const SplatPart& part, Image& image) {
    const int side = 1 << part.level;
    const double share = std::ldexp(1.0, -2 * part.level);
    std::vector<std::array<double, 4>> sums(static_cast<std::size_t>(part.width));
    const float* from = fine.pixels.data();
    for (int y = 0; y < part.height; ++y) {
        std::fill(sums.begin(), sums.end(), std::array<double, 4>{});
        for (int row = 0; row < side; ++row)
            for (auto& sum : sums)
                for (int column = 0; column < side; ++column, from += 4)
                    for (std::size_t c = 0; c < 4; ++c) sum[c] += static_cast<double>(from[c]);
        float* to = image.pixels.data() + 4 * (static_cast<std::size_t>(part.top + y) *
                                                   static_cast<std::size_t>(image.width) +
                                               static_cast<std::size_t>(part.left));
        for (const auto& sum : sums)
            for (const double channel : sum) *to++ = static_cast<float>(channel * share);
    }
}

}  // namespace awan
