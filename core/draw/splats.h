// Particles as seen by the eye: the records of splat.glsl, front to back. Geometry only, no GL.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "core/draw/air.h"
#include "core/gl/tile_lists.h"
#include "core/light/light.h"

namespace awan {

// As in splat.glsl (std430).
struct Splat {
    glm::vec4 place, matter, direct, other, change;
};

struct SplatList {
    std::vector<Splat> splats;       // nearest first when sorted
    std::vector<gl::TileBox> tiles;  // of kTileWidth x kTileHeight pixels, as long as splats
    bool reaches_eye = false;        // one of them is not cut before it gets to the eye
};
inline constexpr int kTileWidth = 8, kTileHeight = 16;  // as in splat.glsl

// Everything in the picture. A Gaussian is cut where its optical depth falls below 5e-4, but not within 3.5 s, and scaled
// so that its mass stays whole; one with s below .6 pixels is widened to it, its optical depth times area kept.
// Sorted (effect view_extinction) by distance from the eye, ties by index; particles of one centre and radius are then
// merged (optical depths add, light and colour are weighted by them), so that no order decides among them.
// air: the haze that they are seen through (air_image.h); null: none.
SplatList make_splats(const Scene& scene, const ParticleSet& particles, const View& view,
                      const Plan& plan, const Lighting& lighting, const Air* air = nullptr);

}  // namespace awan
