// A block of pixels in the march, as its inner loops see it: tiles of 4 x 4 pixels, a pixel a lane.
//
// A block's middle ray is the axis of its frame: places are (x, y) across it and a distance along it. Distances are
// counted from a reference near the block's first particle, so that floats are fine enough for a cloud far away.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/float_lanes.h"
#include "core/draw/march_bins.h"

namespace awan {

inline constexpr int kTileSide = 4;  // pixels
inline constexpr int kTiles = 16;    // of a block
inline constexpr int kChunk = 32;    // samples that are taken at a time

// Where a tile's rays are, in picture coordinates (pixels): 4 x 4 of them, `gap` from each other, and half of that
// within the corner (x, y).
struct TilePlace {
    double x = 0, y = 0, gap = 1;

    double ray_x(int lane) const { return x + (lane % kTileSide + 0.5) * gap; }
    double ray_y(int lane) const { return y + (lane / kTileSide + 0.5) * gap; }
};

// The particles of a block in its frame, scene units.
struct BlockParticles {
    std::vector<float> x, y;   // of the centre, across the middle ray
    std::vector<float> along;  // of the centre, distance from the eye along the middle ray
    std::vector<float> place;  // `along` less the reference
    std::vector<float> near;   // no matter is closer to the eye than this, less the reference
    std::vector<float> s, extinction, reach;  // as in SeenParticle
    std::vector<std::uint8_t> wide;           // whether it may be deposited between rays (WideRays)

    void resize(std::size_t n) {
        wide.resize(n);
        for (auto member : {&BlockParticles::x, &BlockParticles::y, &BlockParticles::along,
                            &BlockParticles::place, &BlockParticles::near, &BlockParticles::s,
                            &BlockParticles::extinction, &BlockParticles::reach})
            (this->*member).resize(n);
    }
};

// Where one particle has matter in each tile, a tile a lane: from center - half to center + half, distances from the
// reference.
struct alignas(64) ActiveParticle {
    simd::Floats center;
    simd::Floats half;    // < 0: none
    simd::Floats shift;   // center - place
    std::uint32_t index;  // into BlockParticles
    float end;            // no matter beyond
    float ratio;          // exp(-(step / s)^2)
    bool direct;          // its closest points differ too much within a tile for a recurrence
};

// Samples k = 0..count-1 at from + (k + 1/2) step, distances from the reference.
struct Chunk {
    float from, step;
    // The step of the samples that end at `from`. 0: their sum is exact up to there, or there are none (the eye).
    float before;
    int count;    // <= kChunk
    bool joined;  // whether the samples before `from` were stepped differently, or end there
};

// Light on the samples of one tile. [k + 1] is that of sample k: there is one more at either end, for slopes.
struct TileLight {
    simd::Floats depth[kChunk + 2];      // optical, from the sun
    simd::Floats source[3][kChunk + 2];  // of the light grid, radiance per optical depth
    simd::Floats albedo[3][kChunk + 2];  // only where cells have their own
    simd::Floats air[kChunk + 2], lost[kChunk + 2];  // O and L of air.h; only in haze
};

struct alignas(64) Tile {
    simd::Floats x, y, z;           // of the lanes' directions, less the middle ray, in its frame
    simd::Floats profile[kChunk];   // optical depth of each sample
    int first, last;                // samples with matter
    bool alive;                     // some pixel still sees something
    bool started;                   // rest_phase and the peak table's rows are set
    simd::Floats depth;             // optical, so far
    simd::Floats left;              // exp(-depth)
    simd::Floats scaled_left;       // exp(-scaled depth)
    simd::Floats red, green, blue;  // radiance so far
    simd::Floats rest_phase;        // p1 of march_phase.h
    simd::Floats seen_air, seen_lost;  // in haze: sums of alpha weight * O and * L (air.h)
};

// Rays kWideApart pixels apart, from corner to corner of a block: matter that is far wider than that is deposited along
// them, and interpolated to the pixels' rays between them. Like tiles, a ray a lane, row by row.
inline constexpr int kWideApart = kTileSide;  // pixels
inline constexpr int kWideSide = kTiles / kTileSide + 1;
struct WideRays {
    static constexpr int kRows = 2;  // of lanes: room for 5 x 5 rays
    struct alignas(64) Row {
        simd::Floats x, y, z;          // as of a Tile
        simd::Floats profile[kChunk];  // as of a Tile
    };
    Row rows[kRows];
};

// Light at four corners, interpolated to a tile's pixels.
struct Bilinear {
    int corner[4];
    simd::Floats weight[4];
};

}  // namespace awan
