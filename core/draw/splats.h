// Particles as the eye sees them, front to back: the records that splat.glsl draws. Geometry only, no GL.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "core/draw/air.h"
#include "core/gl/tile_lists.h"
#include "core/light/light.h"

namespace awan {

// Laid out as in splat.glsl (std430), which says what each holds.
struct Splat {
    glm::vec4 place, matter, direct, other, change;
};

struct SplatList {
    std::vector<Splat> splats;       // nearest first when sorted
    std::vector<gl::TileBox> tiles;  // of kTileWidth x kTileHeight pixels, as long as splats
    bool reaches_eye = false;        // the eye is within the reach of one of them
};
inline constexpr int kTileWidth = 8, kTileHeight = 16;  // as in splat.glsl

// All particles in the picture. A Gaussian is cut off where the optical depth of lines through it falls below 5e-4, but
// not within 3.5 s, and scaled so that its mass stays whole. One whose s is below 0.6 pixels is widened to that, the
// area that it covers kept (survey/narrow.h): exact where such particles stand independently of each other, too much
// where they overlap, as in a cloud that is small beside a pixel.
// With effect view_extinction they are sorted by distance from the eye, ties by index.
// Neighbours in that order with the same centre and radius are merged into one, so that it does not matter which of
// them is drawn over which: optical depths add, light and colour are weighted by them. air: the haze that they are seen
// through (air_image.h); null: none.
SplatList make_splats(const Scene& scene, const ParticleSet& particles, const View& view,
                      const Plan& plan, const Lighting& lighting, const Air* air = nullptr);

}  // namespace awan
