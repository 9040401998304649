// Small pictures of a view, and by how much two of them differ: what the error that is stated for a picture is measured
// with.
#pragma once

#include "core/draw/march.h"

namespace awan {

// The scene with a picture of a few thousand pixels at most, over nothing.
Result<Scene> in_small(const Scene& scene);
// The same, such that a small pixel's middle is that of a pixel of the scene's picture: every third, fifth, ...,
// from the second, third, ... on.
Result<Scene> in_small_aligned(const Scene& scene);

// Root of the mean squared difference over the mean of `truth`, over all pixels whose alpha in `truth` is at least 5%
// of the largest, as PictureError::nrmse (core/accuracy/error_measures.h). 0 where there is no light. Of one size, both
// over nothing.
double picture_difference(const Image& x, const Image& truth);

}  // namespace awan
