// The cubes of Rekawan (Sunar et al. 2005, sections 4.4-4.5) filled with particles, in five ways.
#pragma once

#include <cstdint>

#include "core/generate/particle_set.h"
#include "core/scene/scene.h"

namespace awan {

// One particle in a cube before the cloud is moved: centre in the model's units, radius in (0,
// cube.radius].
struct FilledParticle {
    glm::dvec3 center;
    double radius;
};

// Writes particles first..last-1 of a cube. `key` = keyed(keyed(seed, cloud), cube). Every centre lies in the cube,
// every radius in (0, cube.radius]. A particle does not depend on `first`, `last` or cube.particles.
//
// kUniform: Owen-scrambled Sobol points in position and radius; unbiased and even.
//
// kGardner: the same points, displaced by the phase shifts of Gardner 1985. With x, y, z from the centre and F = 2 pi
// / side,
//   PX = pi/2 sin(FY y) + pi sin(FX z / 2),    PY = pi/2 sin(FX x) + pi sin(FX z / 2).
// A phase P of a wave of frequency F is a displacement P / F; what leaves the cube is reflected at its face. The map
// is odd about the centre, so the cloud stays centred, in clumps and gaps. (Sunar et al. 2005 (4.6) has the phase Px
// in the place of the frequency FX in the third sine.)
//
// kPrinted: equations (4.2)-(4.12) of Sunar et al. 2005 as they stand, one statement after the other, with their
// bias: only the positive octant is filled, the mean is off by +0.2..+0.3 of a side. The radius of (4.12) can leave
// (0, Rmax]; it is clamped to Rmax, and drawn again where it is not positive. At most kMaxPrintedDraws draws a
// particle, then one uniform in the cube (flat cubes accept 0.2% of the draws).
//
// kCumulus, kStratus: the shapes of clouds instead of boxes (shaped_cubes.h); the same points, mapped.
void fill_cube(const Cube& cube, Fill fill, std::uint64_t key, std::uint64_t first,
               std::uint64_t last, FilledParticle* out);

// Draws before a particle is placed uniformly instead: 30 us at worst. Where 3% of the draws are accepted, one
// particle in 6 million needs it.
inline constexpr int kMaxPrintedDraws = 512;

// Position by the printed equations for one draw, by itself so that tests can reach it; may lie outside the cube.
// random3: each uniform in (0, 1).
glm::dvec3 printed_position(const Cube& cube, glm::dvec3 random3);
// Radius by the printed equations for one draw; may leave (0, max_radius]. random1: uniform in (0, 1).
double printed_radius(double max_radius, double random1);

}  // namespace awan
