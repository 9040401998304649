// The haze over pictures of splats.
#pragma once

#include "core/base/image.h"
#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/draw/splats.h"

namespace awan {

// A splat as haze shows it: dimmed by, and with the light of, what stands before its centre `q` (eye's frame: right, up,
// forward). That light joins the splat's `other`.
void see_through_air(const Air& air, const View& view, const glm::dvec3& q, Splat& splat);

// Puts what is behind the clouds, and the haze before it, under a picture over nothing (premultiplied). backdrop: of
// the picture's size; null, nothing is behind: alpha is then 1 - transmittance of clouds and haze, else 1.
void put_air_behind(const Air& air, const Backdrop* backdrop, Image& image);

}  // namespace awan
