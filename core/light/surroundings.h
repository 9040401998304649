// What an island sees of the others.
#pragma once

#include <vector>

#include "core/light/transport_part.h"

namespace awan {

// An island as its neighbours see it: an ellipsoid with the mass of its particles.
struct Neighbour {
    glm::dvec3 center{0}, half{0};  // half axes along x, y, z, scene units
    double extinction = 0;          // mean, 1/unit
};

// Mass-weighted mean and spread of the particles: a uniform ellipsoid has the same.
Neighbour neighbour_of(const ParticleSet& particles);

// Light that reaches the middle of island `self` past and from the others, which shine as `whole` (a solve of the whole scene)
// says where a ray has come one mean free path into them. `neighbours` and `whole` must outlive it.
Surroundings surroundings_of(const Scene& scene, const std::vector<Neighbour>& neighbours,
                             std::size_t self, const TransportLight& whole);

}  // namespace awan
