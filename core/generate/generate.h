// Scene -> ParticleSet. Pure and seeded: the same scene gives the same bytes on every x86-64
// machine and for every number of threads; a particle depends on its own cloud and cube only.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/scene/scene.h"

namespace awan {

// threads >= 1. coarse: only where clouds lie matters (models.h). Errors: kOverDeadline, kCancelled; kInvalidScene
// when procedural clouds come to more particles than a scene may have.
Result<ParticleSet> generate(const Scene& scene, int threads, const Deadline& deadline,
                             bool coarse = false);

}  // namespace awan
