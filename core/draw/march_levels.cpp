#include "core/draw/march_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/base/morton.h"
#include "core/draw/march_tile.h"

namespace awan {
namespace {

// Tiles of 4 x 4 rays that narrow matter may ask for beside the picture's own: in the whole picture, and a block in
// which there is such matter.
constexpr double kMostTiles = 32768, kTilesOfBlock = 16;
// The most of them for one group of blocks that touch: a cloud of thousands of particles has some hundred; one of small
// spheres that fills a picture of 200 pixels some thousand.
constexpr double kMostOfGroup = 8192;

// Blocks that touch, by the particles that lie in several: a forest, each tree's root its group.
class Groups {
  public:
    explicit Groups(int across, int down)
        : across_(across),
          above_(static_cast<std::size_t>(across) * static_cast<std::size_t>(down)) {
        std::iota(above_.begin(), above_.end(), 0u);
    }
    std::uint32_t of(std::uint32_t block) {
        while (above_[block] != block) block = above_[block] = above_[above_[block]];
        return block;
    }
    std::uint32_t of(const BlockBox& box) { return of(block_at(box.first_x, box.first_y)); }
    void join(const BlockBox& box) {
        const std::uint32_t first = of(box);
        for (int y = box.first_y; y <= box.last_y; ++y)
            for (int x = box.first_x; x <= box.last_x; ++x) above_[of(block_at(x, y))] = first;
    }

  private:
    std::uint32_t block_at(int x, int y) const {
        return static_cast<std::uint32_t>(y * across_ + x);
    }
    int across_;
    std::vector<std::uint32_t> above_;
};

// The tile of the finest level that holds a particle's centre, as a place on Morton's curve: two bits a level.
std::uint64_t place_on_curve(const glm::dvec3& q, const View& view, int width, int height) {
    const auto tile = [](double slope, double tangent, int pixels) {
        const double at = (slope / tangent + 1) / 2 * pixels / kTileSide;
        const double most = std::ceil(static_cast<double>(pixels) / kTileSide);
        return static_cast<std::uint32_t>(
            std::clamp(std::ldexp(std::clamp(at, 0.0, most), kMostLevel), 0.0, 4294967295.0));
    };
    return morton_place(tile(q.x / q.z, view.tan_half_fov * view.aspect, width),
                        tile(-q.y / q.z, view.tan_half_fov, height));
}

struct Group {
    double blocks = 0;
    std::array<double, kMostLevel + 1> tiles{};  // that hold a centre, by level
    std::uint64_t last = 0;                      // place on the curve of the particle before
    bool any = false;
    std::uint8_t limit = 0;
};

// The highest level at which a group's tiles are not too many. Matter reaches beyond the tiles of its centres, into all
// eight around them where they stand alone (a level more then makes no more tiles), into few more where they touch (it
// makes four times as many).
std::uint8_t limit_of(const Group& group, double allowed) {
    std::size_t level = kMostLevel;
    for (; level > 0; --level) {
        const double tiles = group.tiles[level];
        const double alone = (4 - tiles / group.tiles[level - 1]) / 3;
        if (tiles * (1 + 8 * std::clamp(alone, 0.0, 1.0)) <= allowed) break;
    }
    return static_cast<std::uint8_t>(level);
}

}  // namespace

std::uint8_t level_for(double s, double width) {
    int level = 0;
    for (double gap = 1; level < kMostLevel && s < width * gap; gap /= 2) ++level;
    return static_cast<std::uint8_t>(level);
}

std::vector<std::uint8_t> affordable_levels(const std::vector<NarrowParticle>& narrow,
                                            const View& view, int width, int height, double share) {
    std::vector<std::uint8_t> levels(narrow.size());
    if (narrow.empty()) return levels;
    const int across = blocks_in(width), down = blocks_in(height);
    Groups groups(across, down);
    for (const NarrowParticle& one : narrow) groups.join(one.blocks);

    std::vector<std::pair<std::uint64_t, std::uint32_t>> curve(narrow.size());
    for (std::size_t i = 0; i < narrow.size(); ++i)
        curve[i] = {place_on_curve(narrow[i].q, view, width, height),
                    static_cast<std::uint32_t>(i)};
    std::sort(curve.begin(), curve.end());

    const auto blocks = static_cast<std::uint32_t>(across * down);
    std::vector<Group> all(blocks);
    for (std::uint32_t block = 0; block < blocks; ++block) all[groups.of(block)].blocks += 1;
    double count = 0;
    for (const auto& [place, i] : curve) {
        Group& group = all[groups.of(narrow[i].blocks)];
        // Places that differ in this level's bits, or in a coarser one's, are in different tiles of it.
        const int same = group.any ? std::countl_zero(place ^ group.last) : 0;
        if (!group.any) count += 1;
        for (int level = 0; level <= kMostLevel; ++level)
            if (!group.any || 64 - same > 2 * (kMostLevel - level))
                group.tiles[static_cast<std::size_t>(level)] += 1;
        group.any = true;
        group.last = place;
    }
    for (Group& group : all)
        if (group.any)
            group.limit = limit_of(group, std::min(kMostOfGroup, kMostTiles * share / count) +
                                              kTilesOfBlock * group.blocks);
    for (std::size_t i = 0; i < narrow.size(); ++i)
        levels[i] = std::min(narrow[i].level, all[groups.of(narrow[i].blocks)].limit);
    return levels;
}

}  // namespace awan
