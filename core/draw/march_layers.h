// A frame of a flight by the march, cloud by cloud: those that have a picture (core/plan/impostor_runs.h) are laid by
// it, the others are marched, and what stands behind them is made anew.
#pragma once

#include <cstdint>
#include <vector>

#include "core/draw/laid_layers.h"
#include "core/draw/march.h"

namespace awan {

// Some of a scene's clouds by themselves: their particles, and the boxes that hold them.
struct CloudsAlone {
    const ParticleSet* particles = nullptr;
    std::vector<Bounds> boxes;
};

// A cloud's picture: over nothing, through no haze, not even lit from behind through the phase function's peak, which
// hangs on what stands behind. Errors: as of march().
Result<CloudPicture> march_picture(const Scene& scene, const CloudsAlone& cloud,
                                   const FacingPicture& facing, const TransportLight& light,
                                   const MarchSettings& settings, int threads,
                                   const Deadline& deadline);

// One layer: a picture, or else clouds that are marched.
struct CloudLayer {
    const CloudPicture* picture = nullptr;
    CloudsAlone clouds;
};

// The frame of these layers, front to back. particles: all of the scene. Errors: as of march(). The same for every
// number of threads.
Result<Image> march_layers(const Scene& scene, const ParticleSet& particles, const View& view,
                           const TransportLight& light, const MarchSettings& settings,
                           const std::vector<CloudLayer>& layers, int threads,
                           const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
