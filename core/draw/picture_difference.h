// By how much two pictures of a view differ, and the pictures for that: what the error that is stated for a picture is
// measured with.
#pragma once

#include "core/draw/march.h"

namespace awan {

// The scene with its picture over nothing. A picture of too many pixels (kMostMeasuredPixels of plan/forecast.h) is one
// of fewer, whose pixels' middles are those of every third, fifth, ... of the scene's own, from the second, third, ...
// on.
Result<Scene> for_measuring(const Scene& scene);

// Root of the mean squared difference over the mean of `truth`, over all pixels whose alpha in `truth` is at least 5%
// of the largest, as PictureError::nrmse (core/accuracy/error_measures.h). 0 where there is no light. Of one size, both
// over nothing.
double picture_difference(const Image& x, const Image& truth);

}  // namespace awan
