// How far a picture of the transport rungs is from the truth, measured while it is made: by how much less its light would be with the next
// coarser grid (core/light/nested_grids.h).
#pragma once

#include "core/draw/march.h"

namespace awan {

// Of small pictures of the same view: rms difference over the mean, over pixels whose alpha is at least 5% of the largest (as
// PictureError::nrmse, core/accuracy/error_measures.h, with the first in place of the truth). 0 where nothing is seen.
struct GridDifferences {
    // Of the light and the next coarser grid's, each with what it gains by the grids before it.
    double last = 0;
    // Of that one and the one before. NaN: there is none.
    double before = 0;
};

// Marches the view for each of the grids, with a few thousand pixels at most. Nothing of it depends on the number of threads.
// Errors: kOverDeadline, kCancelled.
Result<GridDifferences> differences_of_grids(const Scene& scene, const ParticleSet& particles,
                                             const View& view, const TransportLight& light,
                                             const MarchSettings& settings, int threads,
                                             const Deadline& deadline);

}  // namespace awan
