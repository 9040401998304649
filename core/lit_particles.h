// From a scene to the light of its particles: planned, lit on a coarse grid, and looked at from the scene's eye.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/climb.h"

namespace awan {

// The scene as its particles are lit: by the rung `transport-*` that it names, else by transport-16; without detail
// and at its own time, whatever its sequence. Error: kInvalidScene, of a look, which has no light.
Result<Scene> scene_of_light(const Scene& scene);

// The light of the particles towards the scene's eye (core/draw/particle_light.h). lit: of scene_of_light(); planned:
// of that, by plan_generated(). particles: the scene's; they may be more than were planned with, where many were
// merged.
// Errors: kOverDeadline, kCancelled.
Result<std::vector<glm::vec3>> light_particles(const Scene& lit, Planned planned,
                                               const ParticleSet& particles,
                                               const ClimbTools& tools, const Deadline& deadline);

}  // namespace awan
