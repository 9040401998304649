// Pass 1 of the transport rungs: all orders of scattering by discrete ordinates on a grid. No GL.
//
// Two kinds of light are not on the grid: the sun's beam, and sunlight that has only been scattered within the phase
// function's forward peak. The eye pass (core/draw/march.h) computes both exactly, from SunDepth. The grid holds the
// rest: sunlight that was scattered out of the peak at least once before its last scattering, and all light of the sky.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/light/transport_light.h"
#include "core/plan/transport_settings.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// coarser: the same light on a coarser grid, as this function gave it with the settings of fewer cells. Then the solve
// begins from it, and what both differ by is used (nested_grids.h): without it, the light is that of the one grid.
// Null: there is none. Errors: kOverDeadline, kCancelled. The same bytes for every number of threads. Time: cells^3 and
// particles; memory: see transport_bytes (core/plan/forecast.h).
Result<TransportLight> transport_light(const Scene& scene, const ParticleSet& particles,
                                       const Survey& survey, const TransportSettings& settings,
                                       int threads, const Deadline& deadline,
                                       const SharedLight& coarser = nullptr);

}  // namespace awan
