// Light of a scene that falls apart into islands (core/survey/islands.h): each has a grid and a SunDepth of its own, as fine as
// it is large in the picture.
//
// What islands do to each other: the sun's beam is dimmed by all matter before an island, exactly (island_sun.h). Of
// the sky and of what the others scatter, an island gets what its middle sees: the others as ellipsoids of their
// mass, which hide the sky and shine with the source function of a coarse solve of the whole scene (surroundings.h). The
// light that crosses a cut through thin matter is lost.
//
// Measured, nine clouds of depth 12 at 3 to 5 times their size from each other, transport-24 (islands_test): 5.7% nrmse, bias
// -3%; were the others not seen, 9.2% and -7%; with one grid, 20% and -10%.
#pragma once

#include "core/light/transport.h"

namespace awan {

// As transport_light, of which this is a part. Precondition: settings.islands and survey.islands.list are of one length, not 0.
// Islands are solved side by side, each on one thread where there are more of them than threads.
Result<TransportLight> light_in_islands(const Scene& scene, const ParticleSet& particles,
                                        const Survey& survey, const TransportSettings& settings,
                                        int threads, const Deadline& deadline);

}  // namespace awan
