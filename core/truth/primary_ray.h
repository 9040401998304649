// A pixel's ray before its first scattering: where it meets matter, known beforehand instead of walked.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/truth/matter.h"

namespace awan::truth {

// Optical depth along o + t d (p in matter.h), t from 0 to `end` (may be infinite), tabulated at every cell's border
// and at steps of .1 of depth as far as a depth of 24: exact for what stands on the lattice, in closed form for the
// listed. With detail in steps of a twentieth of the largest bumps.
class PrimaryRay {
  public:
    PrimaryRay(const Matter& matter, const glm::dvec3& o, const glm::dvec3& d, double end);

    // Of the whole ray, or at least a depth of 24.
    double depth() const { return depth_.empty() ? 0 : depth_.back(); }
    bool meets() const { return !depth_.empty() && depth_.back() > 0; }
    // t of the first scattering of light that has one; share in (0, 1): of such light, met before t.
    double first_meeting(double share) const;

  private:
    // As long as each other; t and depth rise. Extinction of the lattice at t.
    std::vector<double> t_, depth_, extinction_;
};

// Those particles, in order, that a ray from the eye may meet whose direction is between four corners' (unit); farther
// than 9 s they do not count. No colours.
ParticleSet particles_near(const ParticleSet& particles, const glm::dvec3& eye,
                           const std::array<glm::dvec3, 4>& corners);

}  // namespace awan::truth
