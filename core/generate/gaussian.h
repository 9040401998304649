// What follows from a particle being a Gaussian of extinction (particle_set.h), once for every room that needs it.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/particle_set.h"

namespace awan {

// The particle's s, scene units: its extinction falls off as exp(-d^2 / (2 s^2)).
inline double gaussian_s(const ParticleSet& particles, std::size_t i) {
    return 0.5 * static_cast<double>(particles.radius[i]);
}

// Optical depth of the whole line through its centre.
inline double central_depth(const ParticleSet& particles, std::size_t i) {
    return static_cast<double>(particles.density[i]) * gaussian_s(particles, i) *
           std::sqrt(2 * std::numbers::pi);
}

// The integral of its extinction over space, unit^2.
inline double gaussian_mass(const ParticleSet& particles, std::size_t i) {
    const double s = gaussian_s(particles, i);
    return static_cast<double>(particles.density[i]) * exact::pow(2 * std::numbers::pi, 1.5) * s *
           s * s;
}

}  // namespace awan
