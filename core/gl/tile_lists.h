// Which items touch which tile of a raster, in pieces of bounded size. Plain values, no GL in it;
// the compute passes of light and draw both read such lists.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/deadline.h"

namespace awan::gl {

// The tiles that an item may touch, both ends included; none when last < first. z: for rasters of several layers. Of
// these it touches those that reach into an ellipse: ((x - center_x) per_x)^2 + ((y - center_y) per_y)^2 <= 1 at some
// point of the tile, which spans x .. x + 1. By default the ellipse is infinite: every tile of the box.
struct TileBox {
    std::int32_t first_x = 0, first_y = 0, last_x = -1, last_y = -1;
    std::int32_t first_z = 0, last_z = 0;
    float center_x = 0, center_y = 0, per_x = 0, per_y = 0;
};

// A rectangle of tiles in all layers and, for each of them, layer by layer and row by row, the
// items that touch it in ascending order: items[begin[t]] .. items[begin[t + 1] - 1].
struct TileRegion {
    int x = 0, y = 0, width = 0, height = 0;
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> items;

    std::uint32_t longest_list() const;
    // The tiles whose list is not empty, by their index t.
    std::vector<std::uint32_t> filled_tiles() const;
};

// So many entries of a list a shader may walk in one dispatch; the rest wants another. llvmpipe silently ends every
// loop after 65,535 rounds.
inline constexpr std::uint32_t kMaxRun = 60'000;

// Cuts a raster of width x height x layers tiles into regions with at most max_entries list entries
// and max_tiles tiles each (a single tile may have more entries) and calls visit for each of them.
// Neither the lists nor the work between two looks at the deadline can grow without bound, however
// many items cover however many tiles.
Status for_each_region(std::span<const TileBox> boxes, int width, int height, int layers,
                       std::uint64_t max_entries, std::uint64_t max_tiles, const Deadline& deadline,
                       const std::function<Status(const TileRegion&)>& visit);

}  // namespace awan::gl
