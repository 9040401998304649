#include "core/draw/march_fine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/survey/projection.h"

namespace awan {
namespace {

// Tiles that are marched together lie within so many of the smallest one's sides: floats tell their rays apart.
constexpr double kTogether = 65536;

// What a particle touches of the picture, pixels.
struct Touched {
    double left, top, right, bottom;
    std::uint32_t place;  // in the block's items
    int level;
};

Touched touched_by(const MarchScene& scene, const std::vector<std::uint32_t>& items,
                   std::size_t i) {
    const SeenParticle& one = (*scene.seen)[items[i]];
    const auto reach = static_cast<double>(one.reach);
    const double tan = scene.view.tan_half_fov;
    const PixelSpan x = pixels_between(disc_slopes(one.q.x, one.q.z, reach),
                                       tan * scene.view.aspect, scene.width, false);
    const PixelSpan y =
        pixels_between(disc_slopes(one.q.y, one.q.z, reach), tan, scene.height, true);
    return {x.low + 0.5, y.low + 0.5, x.high + 0.5, y.high + 0.5, static_cast<std::uint32_t>(i),
            one.level};
}

// Divides a tile as far as what touches it asks for.
void divide(const TilePlace& place, int level, const std::vector<Touched>& touching,
            std::vector<FineTile>& tiles) {
    if (touching.empty()) return;
    int wanted = 0;
    for (const Touched& one : touching) wanted = std::max(wanted, one.level);
    if (wanted <= level) {
        FineTile& tile = tiles.emplace_back(FineTile{place, {}});
        tile.touching.reserve(touching.size());
        for (const Touched& one : touching) tile.touching.push_back(one.place);
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

// A change from pixel to pixel that is looked at more closely: of alpha, and of light in shares of the block's
// brightest.
constexpr float kSharp = 0.12f;
// Of a pixel: rays so close fill one with a tile.
constexpr double kQuarter = 1.0 / kTileSide;

// Alpha and light of a block's pixels; beyond the picture those at its rim.
struct BlockPixels {
    float alpha[kBlockSide][kBlockSide], light[kBlockSide][kBlockSide];
    float brightest = 0;
};
BlockPixels pixels_of(const Image& image, int left, int top) {
    BlockPixels block;
    for (int y = 0; y < kBlockSide; ++y)
        for (int x = 0; x < kBlockSide; ++x) {
            const auto row = static_cast<std::size_t>(std::min(top + y, image.height - 1)),
                       column = static_cast<std::size_t>(std::min(left + x, image.width - 1));
            const float* const pixel =
                image.pixels.data() + 4 * (row * static_cast<std::size_t>(image.width) + column);
            block.alpha[y][x] = pixel[3];
            block.light[y][x] = pixel[0] + pixel[1] + pixel[2];
            block.brightest = std::max(block.brightest, block.light[y][x]);
        }
    return block;
}

// The largest change within a square of 2 x 2 pixels and to those beside it.
float change_at(const float (&pixels)[kBlockSide][kBlockSide], int x, int y) {
    float change = 0;
    for (int j = y; j < y + 2; ++j)
        for (int i = x; i < x + 2; ++i) {
            const float here = pixels[j][i];
            change = std::max({change, std::abs(here - pixels[j][std::max(i - 1, 0)]),
                               std::abs(here - pixels[j][std::min(i + 1, kBlockSide - 1)]),
                               std::abs(here - pixels[std::max(j - 1, 0)][i]),
                               std::abs(here - pixels[std::min(j + 1, kBlockSide - 1)][i])});
        }
    return change;
}

struct Sharp {
    float change;
    TilePlace place;
};

// The places of the `most` that change most, in their order.
std::vector<TilePlace> sharpest(std::vector<Sharp> sharp, std::size_t most) {
    if (sharp.size() > most) {
        std::stable_sort(sharp.begin(), sharp.end(),
                         [](const Sharp& a, const Sharp& b) { return a.change > b.change; });
        sharp.resize(most);
        std::sort(sharp.begin(), sharp.end(), [](const Sharp& a, const Sharp& b) {
            return a.place.y != b.place.y ? a.place.y < b.place.y : a.place.x < b.place.x;
        });
    }
    std::vector<TilePlace> places;
    places.reserve(sharp.size());
    for (const Sharp& one : sharp) places.push_back(one.place);
    return places;
}

}  // namespace

float brightest_pixel(const Image& image, int left, int top) {
    return pixels_of(image, left, top).brightest;
}

std::vector<TilePlace> sharp_places(const Image& image, int left, int top,
                                    const std::vector<FineTile>& tiles, std::size_t most) {
    std::uint32_t divided = 0;
    for (const FineTile& tile : tiles)
        divided |= 1u << ((static_cast<int>(tile.place.y) - top) / kTileSide * 4 +
                          (static_cast<int>(tile.place.x) - left) / kTileSide);
    const BlockPixels block = pixels_of(image, left, top);
    std::vector<Sharp> sharp;
    for (int y = 0; y < kBlockSide; y += 2)
        for (int x = 0; x < kBlockSide; x += 2) {
            if (top + y >= image.height || left + x >= image.width) continue;
            if ((divided >> (y / kTileSide * 4 + x / kTileSide) & 1u) != 0) continue;
            const float change =
                std::max(change_at(block.alpha, x, y),
                         change_at(block.light, x, y) / std::max(block.brightest, 1e-30f));
            if (change > kSharp)
                sharp.push_back(
                    {change, {static_cast<double>(left + x), static_cast<double>(top + y), 0.5}});
        }
    return sharpest(std::move(sharp), most);
}

std::vector<TilePlace> FinePixels::sharp_places(int left, int top, float brightest,
                                                std::size_t most) const {
    std::vector<Sharp> sharp;
    for (int y = 0; y < kBlockSide; ++y)
        for (int x = 0; x < kBlockSide; ++x) {
            const Sum& sum = sums_[y * kBlockSide + x];
            if (!(sum.widest > kQuarter * kQuarter)) continue;
            const float change =
                std::max(sum.alpha.greatest - sum.alpha.least,
                         (sum.light.greatest - sum.light.least) / std::max(brightest, 1e-30f));
            if (change > kSharp)
                sharp.push_back(
                    {change,
                     {static_cast<double>(left + x), static_cast<double>(top + y), kQuarter}});
        }
    return sharpest(std::move(sharp), most);
}

std::vector<FineTile> fine_tiles(const MarchScene& scene, int block_x, int block_y,
                                 const std::vector<std::uint32_t>& items) {
    std::vector<FineTile> tiles;
    const auto narrow = [&](std::uint32_t item) { return (*scene.seen)[item].level > 0; };
    if (std::none_of(items.begin(), items.end(), narrow)) return tiles;
    std::vector<Touched> all;
    all.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) all.push_back(touched_by(scene, items, i));
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

FineBatch batch_from(const std::vector<FineTile>& tiles, std::size_t first,
                     const std::vector<std::uint32_t>& items) {
    FineBatch batch;
    std::vector<bool> touching(items.size());
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
        for (const std::uint32_t one : tiles[t].touching) touching[one] = true;
    }
    for (std::size_t i = 0; i < items.size(); ++i)
        if (touching[i]) batch.items.push_back(items[i]);
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
