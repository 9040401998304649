#include "core/draw/march_fine.h"

#include <algorithm>
#include <cmath>

#include "core/survey/projection.h"

namespace awan {
namespace {

// Tiles that are marched together lie within so many of the smallest one's sides: floats tell their rays apart.
constexpr double kTogether = 65536;

// What a particle touches of the picture, pixels.
struct Touched {
    double left, top, right, bottom;
    std::uint32_t item;
    int level;
};

Touched touched_by(const MarchScene& scene, std::uint32_t item) {
    const SeenParticle& one = (*scene.seen)[item];
    const auto reach = static_cast<double>(one.reach);
    const double tan = scene.view.tan_half_fov;
    const PixelSpan x = pixels_between(disc_slopes(one.q.x, one.q.z, reach),
                                       tan * scene.view.aspect, scene.width, false);
    const PixelSpan y =
        pixels_between(disc_slopes(one.q.y, one.q.z, reach), tan, scene.height, true);
    return {x.low + 0.5, y.low + 0.5, x.high + 0.5, y.high + 0.5, item, one.level};
}

// Divides a tile as far as what touches it asks for.
void divide(const TilePlace& place, int level, const std::vector<Touched>& touching,
            std::vector<FineTile>& tiles) {
    if (touching.empty()) return;
    int wanted = 0;
    for (const Touched& one : touching) wanted = std::max(wanted, one.level);
    if (wanted <= level) {
        FineTile& tile = tiles.emplace_back(FineTile{place, {}});
        tile.items.reserve(touching.size());
        for (const Touched& one : touching) tile.items.push_back(one.item);
        return;
    }
    const double side = kTileSide * place.gap / 2;
    std::vector<Touched> part;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const double x = place.x + quarter % 2 * side, y = place.y + quarter / 2 * side;
        part.clear();
        for (const Touched& one : touching)
            if (one.left < x + side && one.right > x && one.top < y + side && one.bottom > y)
                part.push_back(one);
        divide({x, y, place.gap / 2}, level + 1, part, tiles);
    }
}

}  // namespace

std::vector<FineTile> fine_tiles(const MarchScene& scene, int block_x, int block_y,
                                 const std::vector<std::uint32_t>& items) {
    std::vector<FineTile> tiles;
    const auto narrow = [&](std::uint32_t item) { return (*scene.seen)[item].level > 0; };
    if (std::none_of(items.begin(), items.end(), narrow)) return tiles;
    std::vector<Touched> all;
    all.reserve(items.size());
    for (const std::uint32_t item : items) all.push_back(touched_by(scene, item));
    std::vector<Touched> touching;
    for (int t = 0; t < kTiles; ++t) {
        const double x = block_x * kBlockSide + t % 4 * kTileSide,
                     y = block_y * kBlockSide + t / 4 * kTileSide;
        touching.clear();
        bool divided = false;
        for (const Touched& one : all) {
            if (!(one.left < x + kTileSide && one.right > x && one.top < y + kTileSide &&
                  one.bottom > y))
                continue;
            touching.push_back(one);
            divided = divided || one.level > 0;
        }
        if (divided) divide({x, y, 1}, 0, touching, tiles);
    }
    return tiles;
}

FineBatch batch_from(const std::vector<FineTile>& tiles, std::size_t first) {
    FineBatch batch;
    double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300, least = 1e300;
    for (std::size_t t = first; t < tiles.size() && batch.places.size() < kTiles; ++t) {
        const TilePlace& place = tiles[t].place;
        const double side = kTileSide * place.gap;
        low_x = std::min(low_x, place.x);
        low_y = std::min(low_y, place.y);
        high_x = std::max(high_x, place.x + side);
        high_y = std::max(high_y, place.y + side);
        least = std::min(least, side);
        if (t > first && std::max(high_x - low_x, high_y - low_y) > kTogether * least) break;
        batch.places.push_back(place);
        batch.items.insert(batch.items.end(), tiles[t].items.begin(), tiles[t].items.end());
    }
    std::sort(batch.items.begin(), batch.items.end());
    batch.items.erase(std::unique(batch.items.begin(), batch.items.end()), batch.items.end());
    return batch;
}

void FinePixels::draw(int left, int top, Image& image) const {
    for (int y = 0; y < std::min(kBlockSide, image.height - top); ++y)
        for (int x = 0; x < std::min(kBlockSide, image.width - left); ++x) {
            const Sum& sum = sums_[y * kBlockSide + x];
            if (!(sum.area > 0)) continue;
            float* const pixel =
                image.pixels.data() +
                4 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(left + x));
            const double rest = std::max(0.0, 1 - sum.area);
            for (int c = 0; c < 4; ++c)
                pixel[c] = static_cast<float>(sum.rgba[c] + rest * static_cast<double>(pixel[c]));
        }
}

}  // namespace awan
