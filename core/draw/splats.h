// Particles as seen by the eye: the records of splat.glsl, front to back. Geometry only, no GL.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "core/gl/tile_lists.h"
#include "core/light/light.h"

namespace awan {

// As in splat.glsl (std430).
struct Splat {
    glm::vec4 place, matter, direct, red, green, blue;
};

struct SplatList {
    std::vector<Splat> splats;       // nearest first when sorted
    std::vector<gl::TileBox> tiles;  // of kTileWidth x kTileHeight pixels, as long as splats
};
inline constexpr int kTileWidth = 8, kTileHeight = 16;  // as in splat.glsl

// Radiance that a white, opaque particle in full light scatters, by where the light comes from.
struct LightSources {
    glm::dvec3 sun;    // sun irradiance / 4 pi
    glm::dvec3 above;  // upper half of the sky: its share of the mean radiance
    glm::dvec3 below;  // lower half
    double albedo;
};
LightSources light_sources(const Scene& scene, const Plan& plan);

// Everything in the picture. A Gaussian is cut where its optical depth falls below a thousandth,
// but not within 4 s (0.03% of the mass); one with s below .6 pixels is widened to it, its
// optical depth times area kept. sorted (effect view_extinction): by distance from the eye, ties by
// index; particles of one centre and radius are merged (optical depths add, light and colour are
// weighted by them), so that no order decides among them.
SplatList make_splats(const Scene& scene, const ParticleSet& particles, const View& view,
                      const Plan& plan, const Lighting& lighting);

}  // namespace awan
