// How much matter the sun's light has come through, at every point of a cloud.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace awan {

struct Lattice;      // core/survey/lattice.h
struct ParticleSet;  // core/generate/particle_set.h

// Optical depth between the sun and the nodes of a lattice that faces it: of all extinction, that of the phase
// function's forward peak too. Node (i, j, k) stands at origin + i cell.x u + j cell.y v + k cell.z w. Between nodes
// the depth is interpolated trilinearly, and nodes hold what makes that right in the mean (settle_nodes). Outside of
// the lattice it is the nearest node's: since the lattice holds the whole cloud, that is 0 on the sun's side and,
// behind the cloud, the depth of the whole way through it.
struct SunDepth {
    glm::dvec3 origin{0};  // scene units
    // Unit. w is the way the light goes. u and v are orthogonal to each other, but to w only where the lattice faces
    // the sun: that of flat matter lies in the matter, and its columns lean.
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
    glm::dvec3 cell{0};  // between nodes along u, v and w, scene units
    glm::ivec3 nodes{0};
    std::vector<float> depth;  // i fastest, then j, then k; EMPTY: 0 everywhere
};

// The matrix that makes nodes of scene units: its product with a place relative to the origin counts nodes along u, v
// and w. Precondition: the lattice has nodes.
glm::dmat3 to_nodes(const SunDepth& sun);

// The depth at a point (scene units), trilinear.
double depth_at(const SunDepth& sun, const glm::dvec3& point);
// The same for many points: `nodes` as to_nodes gives it. The lattice may be empty.
double depth_at(const SunDepth& sun, const glm::dmat3& nodes, const glm::dvec3& point);

// The depth of particles lit from `towards_sun` (unit), with 0 where the light enters: on the lattice of sun_lattice,
// or, where the matter is flat, on one of as many nodes that lies in the matter (sun_columns.h).
SunDepth sun_depth(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                   int threads);

// A lattice around the particles whose w is the way the light goes, with `cells` cells along its longest side; more
// where that is flat or long (spread_count), fewer where filling it would take more than kMaxSunWork.
Lattice sun_lattice(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                    int threads);

// The depth on such a lattice: the mean extinctions of its cells, summed up from the sun's side. `entry`: the depth
// that the light has already come through where it enters each of the lattice's columns (u fastest).
SunDepth sun_depth_on(const Lattice& lattice, const ParticleSet& particles,
                      std::vector<float> entry, int threads);

// From the depth at nodes, the mean over each column's cross-section, to values between which trilinear interpolation
// is right in the mean: a mean over a cell's width h exceeds the value in its middle by h^2/24 times the second
// derivative, and a line between two points exceeds the curve by h^2/12 times that, in the mean. Without this, where a
// deep cloud begins, a light that falls off within a cell would be too dark by a tenth.
void settle_nodes(SunDepth& sun, int threads);

// Updates of cells (lattice_work of core/survey/lattice.h), about 0.3 s of one core.
inline constexpr double kMaxSunWork = 3e8;

}  // namespace awan
