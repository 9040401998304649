// Looking up the light of a block's samples: along few rays where that is enough, and interpolated between them.
#pragma once

#include "core/draw/march_room.h"

namespace awan {

// Samples first..last of `count`, at distances base + (k + 1/2) step from the eye.
struct SampleRange {
    double base, step;
    int count;
    int first, last;
};

// Of the spacings, the widest whose rays are at most `apart` (scene units) from each other at a distance from the eye;
// -1: every pixel's ray.
int choose_spacing(const MarchScene& scene, double distance, double apart);
// The distance up to which a spacing will do.
double farthest(const MarchScene& scene, int spacing, double apart);

// Whether a tile has matter in samples 0..count-1.
bool has_matter(const Tile& tile, int count);

// Fills room.corners of the rays that tiles with matter need.
void look_up_corners(const MarchScene& scene, const PlacedBlock& block, const SampleRange& samples,
                     int spacing, BlockRoom& room);

// Fills room.light of one tile, each ray's own.
void look_up_pixels(const MarchScene& scene, int tile, const SampleRange& samples, BlockRoom& room);

// The first sample with matter in which the depth towards the sun changes more than a step may cost, as the block's
// middle ray has it, or kChunk: within such a step the beam is not what it is in its middle, however thin the step is
// towards the eye.
int first_too_shaded(const MarchScene& scene, const PlacedBlock& block, const SampleRange& samples);

}  // namespace awan
