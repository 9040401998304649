// The particles as the eye sees them, and which blocks of pixels each one touches.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/survey/survey.h"

namespace awan {

inline constexpr int kBlockSide = 16;  // pixels
// That hold so many pixels in a row.
int blocks_in(int pixels);
// Whether a pixel is in a block that is wanted. wanted: 1 for each that is, row by row; EMPTY: all are. width: of the
// picture, pixels.
inline bool is_wanted(std::span<const std::uint8_t> wanted, int width, std::size_t x,
                      std::size_t y) {
    return wanted.empty() ||
           wanted[y / kBlockSide * static_cast<std::size_t>(blocks_in(width)) + x / kBlockSide] !=
               0;
}

// Blocks, both ends included.
struct BlockBox {
    std::int16_t first_x, first_y, last_x, last_y;
};

// A particle in the eye's frame (right, up, forward), ready to be sampled.
struct SeenParticle {
    glm::dvec3 q;
    double nearest;  // no matter of it lies closer to the eye than this
    float s;  // standard deviation, scene units; widened to what rays can see (survey/narrow.h)
    float extinction;  // at its centre, 1/unit; what lies beyond `reach` is put back in
    float reach;       // where it is cut off, scene units
    BlockBox blocks;
    std::uint8_t level;  // rays that see it stand at most 2^-level pixels apart
};

// The particles in the picture, nearest first (ties: in the set's order). A Gaussian is cut off where the optical depth
// of lines through it falls below 3e-5, but at no less than 3.8 s and no more than 9 s, and scaled so that its mass
// stays whole. Where rays a pixel apart would miss matter of one that is narrower than that, they are to stand closer
// (`level`), as far as a picture's work allows (march_levels.h), and for what is narrower still it is widened, the area
// that it covers kept. share_of_work: of what a picture may take for that, for one that is a part of another.
std::vector<SeenParticle> see_particles(const ParticleSet& particles, const View& view, int width,
                                        int height, int threads, double share_of_work = 1);

// Calls work(block x, block y, indices into `seen`) for every block of pixels, in no order, on several threads. Lists
// are made for a few rows of blocks at a time: they hold at most 2^23 entries, or those of one row. wanted: of each
// block, row by row, whether it is called for; EMPTY: all are.
using BlockWork = std::function<void(int, int, const std::vector<std::uint32_t>& items)>;
void for_each_block(const std::vector<SeenParticle>& seen, int width, int height, int threads,
                    const BlockWork& work, std::span<const std::uint8_t> wanted = {});

// `count` > 0 of the blocks that particles touch, or all where they are fewer; evenly along Morton's curve, so that
// every part of a cloud is among them: 1 for each, row by row.
std::vector<std::uint8_t> sample_blocks(const std::vector<SeenParticle>& seen, int width,
                                        int height, int count);

}  // namespace awan
