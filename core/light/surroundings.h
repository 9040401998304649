// What an island sees of the others (islands.h).
#pragma once

#include <vector>

#include "core/light/transport_part.h"

namespace awan {

// An island as its neighbours see it: an ellipsoid with the mass of its particles.
struct Neighbour {
    glm::dvec3 center{0}, half{0};  // half axes along x, y, z, scene units
    double extinction = 0;          // mean, 1/unit
};

// The uniform ellipsoid with the same mass, centre and spread along the axes as the particles.
Neighbour neighbour_of(const ParticleSet& particles);

// The light that reaches the middle of island `self`: what the others let through, and what they send. They shine by
// the source function that `whole`, a coarse solve of the whole scene, has where a ray has come one mean free path into
// them, or in the middle of what is thinner. `scene`, `neighbours` and `whole` must outlive the result.
Surroundings surroundings_of(const Scene& scene, const std::vector<Neighbour>& neighbours,
                             std::size_t self, const TransportLight& whole);

}  // namespace awan
