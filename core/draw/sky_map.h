// A scene's sky all around, for image based lighting.
#pragma once

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/base/result.h"
#include "core/scene/scene.h"

namespace awan {

// width: pixels, even, 2 to limits::kMaxImageSide; the map is half as high. Equirectangular, as OpenEXR's latlong maps:
// the zenith along the top, +y up; +z in the middle, +x a quarter from the left, -z at both sides. So a scene's azimuth
// 0 is in the middle and grows to the left. A pixel has the mean radiance of its part of the sphere: of the sky, and
// where the scene has a ground, below the horizon of that, unshaded. Neither the sun itself nor the clouds are in it.
// The same bytes for every number of threads. Errors: kOverDeadline, kCancelled.
Result<Image> sky_map(const Scene& scene, int width, int threads, const Deadline& deadline);

}  // namespace awan
