// How closely the rays of the march stand where particles are narrower than a pixel.
//
// Rays a pixel apart would miss such matter, or see too much of it where it is widened: particles that overlap would be
// spread beside each other. So the picture is divided there as a quadtree: where matter asks for level k, rays stand
// 2^-k pixels apart. A cloud far away has few such rays, however small it is. Where there would be too many of them,
// narrow particles are seen at a lower level than they ask for, and widened (survey/narrow.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/draw/march_bins.h"

namespace awan {

inline constexpr int kMostLevel = 20;

// The least level at which a Gaussian of that s (pixels) is at least `width` gaps between rays wide, 0..kMostLevel.
std::uint8_t level_for(double s, double width);

// A particle that asks for a level > 0.
struct NarrowParticle {
    glm::dvec3 q;        // in the eye's frame, q.z > 0
    std::uint8_t level;  // that it asks for
    BlockBox blocks;     // that it touches, widened for rays a pixel apart
};

// The level that each gets. Particles whose blocks touch get levels up to one limit: the highest for which they have no
// more than a bounded number of tiles of rays, `share` times about what a picture of 800 x 600 pixels has without.
std::vector<std::uint8_t> affordable_levels(const std::vector<NarrowParticle>& narrow,
                                            const View& view, int width, int height,
                                            double share = 1);

}  // namespace awan
