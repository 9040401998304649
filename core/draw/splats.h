// Particles as the eye sees them, front to back: the records that splat.glsl draws. Geometry only, no GL.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/draw/air.h"
#include "core/gl/tile_lists.h"
#include "core/light/light.h"

namespace awan {

inline constexpr int kDepthLevels = 64;
// From the deepest billboard down to what is so many times as thin, in equal ratios: a depth is off by 5.7% at most.
// Thinner ones are the thinnest, and so much less opaque, which is exact for them.
inline constexpr double kDepthRange = 1000;

// The optical depths, through a particle's centre, that textures are made for (billboards.h).
struct DepthLevels {
    double deepest = 0;

    // 0 .. kDepthLevels - 1, the deepest last.
    int level_of(double depth) const;
    double depth_of(int level) const;
};

// Laid out as in splat.glsl (std430), which says what each holds.
struct Splat {
    glm::vec4 place, matter, direct, other, change;
};

// How a splat is painted, laid out as in splat.glsl.
struct PaintedSplat {
    glm::vec4 across{0, 0, 0, -1}, up{0}, tint{0};
};

struct SplatList {
    std::vector<Splat> splats;        // nearest first when sorted
    std::vector<PaintedSplat> paint;  // as long as splats, or EMPTY where none is painted
    std::vector<gl::TileBox> tiles;   // of kTileWidth x kTileHeight pixels, as long as splats
    bool reaches_eye = false;         // the eye is within the reach of one of them
};
inline constexpr int kTileWidth = 8, kTileHeight = 16;  // as in splat.glsl

// A rectangle of the image plane at distance 1 and the pixels that it is divided into: the picture, or a part of it
// whose pixels stand closer (splat_parts.h).
struct SplatWindow {
    glm::dvec2 middle;   // to the right and up
    glm::dvec2 tangent;  // half its width and height
    int width, height;   // pixels
    // Sides of pixels: of this window in the image plane, and of the picture's.
    double gap() const { return 2 * tangent.y / height; }
    double picture_gap;
};
SplatWindow whole_picture(const View& view, const ImageSettings& image);

// Radiance that a white, opaque particle in full light scatters, by where the light comes from.
struct LightSources {
    glm::dvec3 sun;    // sun irradiance / 4 pi
    glm::dvec3 above;  // upper half of the sky: its share of the mean radiance
    glm::dvec3 below;  // lower half
    double albedo;
    glm::dvec3 to_sun;  // unit
    // The mean cosine where light that was scattered forward before is scattered on.
    double g_of_scattered;
};

// What the splats of all windows are made of. It refers to its arguments.
struct SplatSetting {
    const ParticleSet& particles;
    const View& view;
    const Lighting& lighting;
    const Air* air;  // the haze that they are seen through (air_image.h); null: none
    bool sorted;     // nearest first: effect view_extinction
    LightSources sources;
    // The depths that textures are made for; none: particles are not painted.
    std::optional<DepthLevels> levels;
};
SplatSetting splat_setting(const Scene& scene, const ParticleSet& particles, const View& view,
                           const Plan& plan, const Lighting& lighting, const Air* air = nullptr);

// Indices of the particles in the order in which they are drawn: with effect view_extinction by distance from the eye,
// ties by index. Those that the ground hides are left out.
std::vector<std::uint32_t> drawing_order(const Scene& scene, const ParticleSet& particles,
                                         const View& view, const Plan& plan);

// The given particles, as far as they are in the window. A Gaussian is cut off where the optical depth of lines through
// it falls below 5e-4, but not within 3.5 s (of kManySplats and more with detail .01 and 2.6 s), and scaled so that its
// mass stays whole. One whose s is below 0.6 of the
// window's pixels is widened to that, the area that it covers kept (survey/narrow.h): exact where such particles stand
// independently of each other, too much where they overlap. That is why draw() draws such matter in finer windows.
// With effect view_extinction, neighbours in the order with the same centre and radius are merged into one, so that it
// does not matter which of them is drawn over which: optical depths add, light and colour are weighted by them.
//
// A painted particle is a billboard (billboards.h). One that is narrower than the window's pixels is widened to 2 of
// them, and so much less opaque; one that is nearer to the eye than half its side fades, so that none is flown through.
SplatList make_splats(const SplatSetting& setting, const SplatWindow& window,
                      std::span<const std::uint32_t> order);

// Slopes, distances and optical depth of a particle as its splat has them before any widening.
struct Footprint {
    glm::dvec3 q;  // in the eye's frame: right, up, forward
    double distance, s, tau, reach;
    bool seen;  // it has matter
};
Footprint footprint_of(const ParticleSet& particles, std::size_t i, const View& view);

}  // namespace awan
