// The particles as the eye sees them, and which blocks of pixels each one touches.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/survey/survey.h"

namespace awan {

inline constexpr int kBlockSide = 16;  // pixels

// Blocks, both ends included.
struct BlockBox {
    std::int16_t first_x, first_y, last_x, last_y;
};

// A particle in the eye's frame (right, up, forward), ready to be sampled.
struct SeenParticle {
    glm::dvec3 q;
    double nearest;    // no matter of it lies closer to the eye than this
    float s;           // widened to kMinWidthPixels
    float extinction;  // at its centre; what lies beyond `reach` is put back in
    float reach;       // matter beyond is left out; scene units
    BlockBox blocks;
};

// Those in the picture, nearest first (ties: the set's order). A Gaussian is cut where the optical depth across it falls
// below 3e-5, but neither within 3.8 s nor beyond 9, and scaled so that its mass stays whole; one with s below .6 pixels is widened to
// that, its optical depth times area kept.
std::vector<SeenParticle> see_particles(const ParticleSet& particles, const View& view, int width,
                                        int height, int threads);

// Calls work(block x, block y, indices into `seen`) for every block of pixels, in no order, on several threads. Lists are made for a few rows of blocks at a time: memory is bounded by kMaxEntries or the particles of one row.
using BlockWork = std::function<void(int, int, const std::vector<std::uint32_t>& items)>;
void for_each_block(const std::vector<SeenParticle>& seen, int width, int height, int threads,
                    const BlockWork& work);

}  // namespace awan
