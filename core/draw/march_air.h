// The haze (air.h) in the march: looked up together with the light.
#pragma once

#include "core/base/float_lanes.h"
#include "core/draw/air.h"
#include "core/draw/march_light.h"
#include "core/draw/march_tile.h"

namespace awan {

// Fills `air` and `lost` of points at distances first, first + step, ... from the eye, on the ray through pixel
// coordinates (x, y). count <= kChunk (march_tile.h).
void air_along(const Air& air, double x, double y, double first, double step, int count,
               LightAt* out);

// The distance up to which the haze may be interpolated linearly between rays whose unit directions differ by `apart`:
// up to there their heights differ by no more than 0.3 scale heights, and the error is below 0.5% of the transmittance.
double farthest_for_air(const Air& air, double apart);

// The haze over a tile's pixels, in floats.
struct AirTile {
    float up, down;            // depth to the end of a vertical ray, as in Air
    float sun[3], ambient[3];  // as in Air
    simd::Floats lost;         // L of the whole rays
};
AirTile air_tile(const Air& air, const TilePlace& place);

}  // namespace awan
