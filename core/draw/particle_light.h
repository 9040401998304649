// The light of single particles, for programs that draw them as sprites.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/light/transport_light.h"
#include "core/scene/scene.h"

namespace awan {

// For each particle, the radiance that it sends towards the eye per optical depth of all extinction, linear RGB: of the
// sun, the sky and the ground, scattered any number of times. Laid over each other with exp(-optical depth), particles
// of this light make about the picture that march() makes (core/draw/march_shade.h), where they are thick: at an
// optical depth of 1 to 3 they are up to half too bright. >= 0, finite.
// light: of the scene, with a grid. eye: scene units. threads >= 1; the same for every number of them.
std::vector<glm::vec3> particle_light(const Scene& scene, const ParticleSet& particles,
                                      const TransportLight& light, const glm::dvec3& eye,
                                      int threads);

}  // namespace awan
