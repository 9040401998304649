// What one block needs while it is marched: its place, and room that is used again for the next block.
#pragma once

#include <iterator>
#include <span>
#include <vector>

#include "core/draw/march_block.h"
#include "core/draw/march_detail.h"
#include "core/draw/march_rays.h"
#include "core/draw/march_tile.h"

namespace awan {

// Light is looked up along rays that are so many pixels apart, and interpolated between them.
inline constexpr int kSpacings[] = {16, 8, 4, 2};
inline constexpr int kSpacingCount = static_cast<int>(std::size(kSpacings));
// Of the finest spacing, in a block.
inline constexpr int kMostCorners = 81;

struct BlockRoom {
    Tile tiles[kTiles];
    TilePlace places[kTiles];
    WideRays wide;
    TileLight light;
    LightAt corners[kMostCorners][kChunk + 2];
    Bilinear of_pixels[kSpacingCount][kTiles];  // of a block of 16 x 16 pixels
    Bilinear of_places[kSpacingCount][kTiles];  // of other tiles
    const Bilinear (*bilinear)[kTiles] = of_pixels;
    simd::Floats middle[3];  // the tiles' middle rays, as the directions of a Tile, a tile a lane
    simd::Floats spread;     // how far a tile's rays are from its middle ray, a tile a lane
    BlockParticles particles;
    std::vector<ActiveParticle> active;
    std::vector<FineInterval> fineness;
    // Of the peak table, tile by tile: a column each, a pixel a lane.
    struct alignas(64) Column {
        simd::Floats value;
    };
    std::vector<Column> rows;
};

// Where a block is and how it is stepped through.
struct PlacedBlock {
    int left = 0, top = 0;              // of the 16 x 16 pixels that it lies in
    double middle_x = 0, middle_y = 0;  // where the middle ray meets the picture, pixels
    int tiles = kTiles;
    bool between = false;  // whether particles may be deposited between rays (WideRays)
    BlockFrame frame{};
    SunInBlock sun{};
    DetailRays detail;
    double reference = 0;  // distance from the eye that the block's distances are counted from
    double longest = 1;    // the longest and the shortest step, scene units
    double shortest = 1;
    double stretch = 1;  // of all steps, where a ray is long
};

// Sets the tiles' rays, and all that does not depend on particles: of a block's pixels, or of 1 to 16 tiles among them
// whose rays stand closer.
PlacedBlock place_block(const MarchScene& scene, int block_x, int block_y, BlockRoom& room);
PlacedBlock place_block(const MarchScene& scene, int block_x, int block_y,
                        std::span<const TilePlace> places, BlockRoom& room);

// Puts the block's particles (indices into scene.seen, nearest first; not empty) into its frame, and chooses its steps.
void place_particles(const MarchScene& scene, const std::vector<std::uint32_t>& items,
                     PlacedBlock& block, BlockRoom& room);

}  // namespace awan
