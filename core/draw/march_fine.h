// Tiles whose rays stand closer than pixels: where matter is narrower than they are (march_levels.h), and where pixels
// change sharply.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/image.h"
#include "core/draw/march_scene.h"
#include "core/draw/march_tile.h"

namespace awan {

struct FineTile {
    TilePlace place;
    std::vector<std::uint32_t> touching;  // places in the block's items, ascending: nearest first
};

// The tiles into which a block's are divided: each so far that its rays are as close as all that touches it asks for.
// Tiles that nothing touches are left out. In the order of Morton's curve. EMPTY where a ray a pixel is enough for the
// whole block; a tile of it for which one is enough is not among them. items: the particles that the block sees.
std::vector<FineTile> fine_tiles(const MarchScene& scene, int block_x, int block_y,
                                 const std::vector<std::uint32_t>& items);

// Up to 16 of them in a row that can be marched together, and all that touches them.
struct FineBatch {
    std::vector<TilePlace> places;
    std::vector<std::uint32_t> items;  // indices into scene.seen, nearest first, each once
};
// items: the block's.
FineBatch batch_from(const std::vector<FineTile>& tiles, std::size_t first,
                     const std::vector<std::uint32_t>& items);

// Squares of 2 x 2 pixels of a block across which, or beside which, alpha or light changes by so much that their
// middles stand badly for them: silhouettes, bright rims. Each as a tile with rays half a pixel apart; at most `most`:
// those that change most, in the order of the picture. image: with the block's pixels in it. tiles: those that are
// divided already (fine_tiles).
std::vector<TilePlace> sharp_places(const Image& image, int left, int top,
                                    const std::vector<FineTile>& tiles, std::size_t most);

// The most light (r + g + b) of a block's pixels.
float brightest_pixel(const Image& image, int left, int top);

// A block's pixels as the means of finer rays.
class FinePixels {
  public:
    // A ray that stands for `area` of pixel (x, y) of the block.
    void add(int x, int y, double area, const float* rgba) {
        Sum& sum = sums_[y * kBlockSide + x];
        sum.area += area;
        sum.widest = std::max(sum.widest, area);
        for (int c = 0; c < 4; ++c) sum.rgba[c] += area * static_cast<double>(rgba[c]);
        const float light = rgba[0] + rgba[1] + rgba[2];
        sum.alpha.take(rgba[3]);
        sum.light.take(light);
    }
    // Pixels of the block whose rays, half a pixel apart, differ by so much that their mean is still a bad one: each as
    // a tile with rays a quarter of a pixel apart; at most `most`, those that differ most, in the order of the picture.
    // brightest: the light (r + g + b) that differences are shares of.
    std::vector<TilePlace> sharp_places(int left, int top, float brightest, std::size_t most) const;
    // To the picture's pixels; what no ray stands for stays as it is there. left, top: of the block.
    void draw(int left, int top, Image& image) const;

  private:
    struct Range {
        float least = INFINITY, greatest = -INFINITY;
        void take(float value) {
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        }
    };
    struct Sum {
        double area = 0, rgba[4] = {};
        double widest = 0;   // area of a ray
        Range alpha, light;  // of its rays
    };
    Sum sums_[kBlockSide * kBlockSide];
};

}  // namespace awan
