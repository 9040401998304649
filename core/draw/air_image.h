// The haze over pictures of splats.
#pragma once

#include "core/base/image.h"
#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/draw/splats.h"

namespace awan {

// Shows a splat through the haze between the eye and the splat's centre `q` (in the eye's frame: right, up, forward).
// The haze dims it, and the haze's own light is added to the splat's `other`: the share of that which is the haze's.
float see_through_air(const Air& air, const View& view, const glm::dvec3& q, Splat& splat);

// Puts what is behind the clouds, seen through the haze, under a picture of clouds alone (premultiplied). backdrop: of
// the picture's size; alpha becomes 1, if the picture is opaque. Null: nothing is behind. Else
// alpha becomes 1 - the transmittance of clouds and haze.
void put_air_behind(const Air& air, const Backdrop* backdrop, Image& image);

}  // namespace awan
