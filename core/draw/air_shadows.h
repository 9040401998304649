// Where the clouds' shadows take sunlight from the haze along the rays of a picture: light shafts.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/light/transport.h"
#include "core/survey/haze_depth.h"

namespace awan {

// The haze between the eye and a point at distance t would scatter so much sunlight to the eye; clouds keep this share
// of it away:
//     lost(t) = integral from 0 to t of (1 - V) dO / O(t),     O = 1 - exp(-depth of the haze from the eye to t),
// V the sun's transmittance through the clouds. It is tabulated along rays that are `spacing` pixels apart, at the ends
// of slices about two cells of the sun's depth long; slices lie only where there can be shadow. In a slice dO is exact
// and V is taken from its middle.
struct AirShadows {
    struct Ray {
        // Shadows lie between `from` and `to`; at `mid` the ray enters or leaves the box of the matter.
        double from = 0, mid = 0, to = 0;
        double per_first = 0, per_second = 0;  // slices per unit of length in from..mid and mid..to
        std::uint32_t first = 0, second = 0;   // how many slices
        std::uint32_t at = 0;                  // index of the ray's first node in `lost`
        // Integral of (1 - V) dO over all of the ray, to the ground or without end.
        double whole = 0;
    };
    int spacing = 0;           // pixels between rays; a power of two <= 16; 0: nothing is shaded
    int across = 0, down = 0;  // rays; ray (i, j) is through the pixel corner (i, j) * spacing
    std::vector<Ray> rays;     // row by row
    std::vector<float> lost;   // at the slices' ends, first + second + 1 a ray; 0..1
};

// A ray's direction (unit) from the eye by the pixel coordinates that it goes through is
// normalize(corner + x * per_x + y * per_y).
struct PictureRays {
    glm::dvec3 eye{0}, corner{0}, per_x{0}, per_y{0};
    int width = 0, height = 0;
};

// ground: height where the haze ends for an eye above it; -infinity: nowhere. The same for every number of threads.
AirShadows air_shadows(const PictureRays& picture, const Haze& haze, double ground,
                       const SunDepth& sun, int threads);

// The share lost before distance t on the ray through a pixel coordinate, bilinear between rays. opacity: O(t).
double lost_at(const AirShadows& shadows, double x, double y, double t, double opacity);
// Integral of (1 - V) dO over all of that ray.
double whole_lost(const AirShadows& shadows, double x, double y);

}  // namespace awan
