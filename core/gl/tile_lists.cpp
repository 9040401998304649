#include "core/gl/tile_lists.h"

#include <algorithm>
#include <numeric>

namespace awan::gl {
namespace {

struct Rectangle {
    int x, y, width, height;
};

TileBox clip(TileBox box, const Rectangle& to) {
    box.first_x = std::max(box.first_x, to.x);
    box.first_y = std::max(box.first_y, to.y);
    box.last_x = std::min(box.last_x, to.x + to.width - 1);
    box.last_y = std::min(box.last_y, to.y + to.height - 1);
    return box;
}

// The square of the distance from `center` to the nearest point of the tile that spans tile .. tile + 1, along one
// axis, in units of 1 / per.
float apart2(std::int32_t tile, float center, float per) {
    const auto low = static_cast<float>(tile);
    const float d = std::max({0.F, low - center, center - low - 1.F}) * per;
    return d * d;
}

std::uint64_t tiles_in(const TileBox& box) {
    if (box.last_x < box.first_x || box.last_y < box.first_y || box.last_z < box.first_z) return 0;
    return static_cast<std::uint64_t>(box.last_x - box.first_x + 1) *
           static_cast<std::uint64_t>(box.last_y - box.first_y + 1) *
           static_cast<std::uint64_t>(box.last_z - box.first_z + 1);
}

TileRegion make_lists(std::span<const TileBox> boxes, const std::vector<std::uint32_t>& candidates,
                      const Rectangle& area, int layers) {
    TileRegion region{area.x, area.y, area.width, area.height, {}, {}};
    const auto width = static_cast<std::size_t>(area.width),
               height = static_cast<std::size_t>(area.height);
    // Calls visit(tile) for every tile of the area that an item touches.
    const auto each_tile = [&](std::uint32_t item, const auto& visit) {
        const TileBox box = clip(boxes[item], area);
        for (int z = box.first_z; z <= box.last_z; ++z)
            for (int y = box.first_y; y <= box.last_y; ++y) {
                const std::size_t row =
                    (static_cast<std::size_t>(z) * height + static_cast<std::size_t>(y - area.y)) *
                    width;
                const float up = apart2(y, box.center_y, box.per_y);
                for (int x = box.first_x; x <= box.last_x; ++x)
                    if (up + apart2(x, box.center_x, box.per_x) <= 1.F)
                        visit(row + static_cast<std::size_t>(x - area.x));
            }
    };
    region.begin.assign(width * height * static_cast<std::size_t>(layers) + 1, 0);
    for (const std::uint32_t i : candidates)
        each_tile(i, [&](std::size_t tile) { ++region.begin[tile + 1]; });
    std::partial_sum(region.begin.begin(), region.begin.end(), region.begin.begin());
    region.items.resize(region.begin.back());
    std::vector<std::uint32_t> next(region.begin.begin(), region.begin.end() - 1);
    for (const std::uint32_t i : candidates)
        each_tile(i, [&](std::size_t tile) { region.items[next[tile]++] = i; });
    return region;
}

struct Cutter {
    std::span<const TileBox> boxes;
    int layers;
    std::uint64_t max_entries, max_tiles;
    const Deadline& deadline;
    const std::function<Status(const TileRegion&)>& visit;

    // Halves the area until its lists are short enough. It calls itself at most log2(number of tiles) deep.
    Status cut(const Rectangle& area, const std::vector<std::uint32_t>& candidates) const {
        if (auto error = deadline.over()) return error;
        std::vector<std::uint32_t> inside;
        std::uint64_t entries = 0;
        for (const std::uint32_t i : candidates) {
            const std::uint64_t tiles = tiles_in(clip(boxes[i], area));
            if (tiles > 0) inside.push_back(i);
            entries += tiles;
        }
        const auto tiles =
            static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
        if (tiles == 1 || (entries <= max_entries && tiles <= max_tiles))
            return visit(make_lists(boxes, inside, area, layers));
        Rectangle first = area, second = area;
        // Halves the height first, so that regions stay whole rows of the raster as long as they can.
        if (area.height > 1) {
            first.height = area.height / 2;
            second.y += first.height;
            second.height -= first.height;
        } else {
            first.width = area.width / 2;
            second.x += first.width;
            second.width -= first.width;
        }
        if (auto error = cut(first, inside)) return error;
        return cut(second, inside);
    }
};

}  // namespace

std::uint32_t TileRegion::longest_list() const {
    std::uint32_t longest = 0;
    for (std::size_t tile = 0; tile + 1 < begin.size(); ++tile)
        longest = std::max(longest, begin[tile + 1] - begin[tile]);
    return longest;
}

std::vector<std::uint32_t> TileRegion::filled_tiles() const {
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile + 1 < begin.size(); ++tile)
        if (begin[tile + 1] > begin[tile]) tiles.push_back(tile);
    return tiles;
}

Status for_each_region(std::span<const TileBox> boxes, int width, int height, int layers,
                       std::uint64_t max_entries, std::uint64_t max_tiles, const Deadline& deadline,
                       const std::function<Status(const TileRegion&)>& visit) {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0u);
    return Cutter{boxes, layers, max_entries, max_tiles, deadline, visit}.cut({0, 0, width, height},
                                                                              all);
}

}  // namespace awan::gl
