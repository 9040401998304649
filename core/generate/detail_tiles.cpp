#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/generate/detail.h"

namespace awan {
namespace {

constexpr auto kRow = static_cast<std::size_t>(kDetailSide);

// Each word with its neighbours' bytes (DetailTile).
std::vector<std::uint32_t> packed(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint32_t> words(kRow * kRow * (kRow + 1));
    for (std::size_t z = 0; z <= kRow; ++z)
        for (std::size_t y = 0; y < kRow; ++y) {
            const std::uint8_t* const layer = bytes.data() + z % kRow * kRow * kRow;
            const std::uint8_t* const row = layer + y * kRow;
            const std::uint8_t* const next = layer + (y + 1) % kRow * kRow;
            std::uint32_t* const to = words.data() + (z * kRow + y) * kRow;
            const auto word = [&](std::size_t x, std::size_t beside) {
                return static_cast<std::uint32_t>(row[x]) |
                       static_cast<std::uint32_t>(row[beside]) << 8 |
                       static_cast<std::uint32_t>(next[x]) << 16 |
                       static_cast<std::uint32_t>(next[beside]) << 24;
            };
            for (std::size_t x = 0; x + 1 < kRow; ++x) to[x] = word(x, x + 1);
            to[kRow - 1] = word(kRow - 1, 0);
        }
    return words;
}

}  // namespace

DetailTile make_detail_tile(std::uint64_t seed, int threads) {
    return std::make_shared<const std::vector<std::uint32_t>>(
        seed == kShippedTileSeed ? packed(shipped_tile_bytes())
                                 : packed(detail_tile_bytes(seed, threads)));
}

DetailTile DetailTiles::of(std::uint64_t seed, int threads) {
    {
        const std::lock_guard lock(mutex_);
        const auto at = std::find_if(entries_.begin(), entries_.end(),
                                     [&](const Entry& entry) { return entry.seed == seed; });
        if (at != entries_.end()) {
            entries_.splice(entries_.begin(), entries_, at);
            return at->tile;
        }
    }
    // Outside the lock: two threads may make the same tile at once, and it is the same.
    DetailTile tile = make_detail_tile(seed, threads);
    const std::lock_guard lock(mutex_);
    entries_.push_front({seed, tile});
    if (entries_.size() > kKept) entries_.pop_back();
    return tile;
}

}  // namespace awan
