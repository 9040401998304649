// How much matter the sun's light has come through, at every point of a cloud.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace awan {

struct Lattice;      // core/survey/lattice.h
struct ParticleSet;  // core/generate/particle_set.h

// Optical depth between the sun and the nodes of a lattice that faces it: of all extinction, that of the
// phase function's forward peak too.
// Node (i, j, k) stands at origin + cell * (i u + j v + k w). Between nodes the depth is interpolated
// trilinearly. Outside of the lattice it is the nearest node's: since the lattice holds the whole cloud, that is
// 0 on the sun's side and, behind the cloud, the depth of the whole way through it.
struct SunDepth {
    glm::dvec3 origin{0};  // scene units
    // Orthonormal. w is the way the light goes.
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
    double cell = 0;  // scene units
    glm::ivec3 nodes{0};
    std::vector<float> depth;  // i fastest, then j, then k; EMPTY: 0 everywhere
};

// The depth at a point (scene units), trilinear.
double depth_at(const SunDepth& sun, const glm::dvec3& point);

// The depth of particles lit from `towards_sun` (unit) on the lattice of sun_lattice, with 0 where the light enters.
SunDepth sun_depth(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                   int threads);

// A lattice around the particles whose w is the way the light goes, with `cells` cells along its longest side; fewer
// where filling it would take more than kMaxSunWork.
Lattice sun_lattice(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                    int threads);

// The depth on such a lattice: the mean extinctions of its cells, summed up from the sun's side. `entry`: the depth
// that the light has already come through where it enters each of the lattice's columns (u fastest).
SunDepth sun_depth_on(const Lattice& lattice, const ParticleSet& particles,
                      std::vector<float> entry, int threads);

// Updates of cells (lattice_work of core/survey/lattice.h), about 0.3 s of one core.
inline constexpr double kMaxSunWork = 3e8;

}  // namespace awan
