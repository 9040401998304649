// Many particles that overlap, merged into fewer Gaussians of the same matter: what is seen hardly changes, and light,
// measuring and drawing take the time of the fewer.
//
// A Gaussian of standard deviation s is, but for what no picture shows, a sum of Gaussians of s' on the nodes of a
// lattice of cells h, weighted by a quadratic B-spline around its centre: mass and mean are exact, and so is
// the variance if s'^2 + h^2 / 4 = s^2. Particles are merged by classes of size, on a lattice a class; what is wider
// than the narrowest of its class is spread to its own variance by the second difference. Where a part of space has
// fewer particles than nodes, they stay.
//
// How fine that has to be: within matter classes of half an octave and h = 1.2 s do, a sum over a constant field is
// constant within 3e-4. But the edge of a deep cloud lies in the tails of its widest Gaussians, where they are a
// thousandth of their middles, and a sum of compact spreads falls off faster than a Gaussian, the more the wider they
// are: a ball of depth 80 was by 13% off in light that is scattered once. Where that counts the widest have classes of
// a quarter of an octave and h = .9 s, and it is 3%.
#pragma once

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"

namespace awan {

// No fewer particles than this are ever merged: they are quick as they are.
inline constexpr std::size_t kFewParticles = 2048;

// The particles merged, in ParticleSet::whole those that they were made from, and in `error` what it costs at most, of
// a picture's root mean square, where that is at most `most_error`; the particles themselves, where merging is of no
// use or would cost more. Where particles would be more than light and eye are quick with, those that are narrower than
// the lattice are widened to it, as far as `most_error` allows.
//
// to_sun: unit. threads >= 1; the same for every number of them. Particles with colours of their own, or painted ones,
// stay as they are.
// Errors: kOverDeadline, kCancelled.
Result<ParticleSet> merged(ParticleSet particles, const glm::dvec3& to_sun, double most_error,
                           int threads, const Deadline& deadline);

// ParticleSet::whole, or the particles themselves where they are not merged.
inline const ParticleSet& unmerged(const ParticleSet& particles) {
    return particles.whole ? *particles.whole : particles;
}

}  // namespace awan
