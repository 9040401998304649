// Rekawan's cubes filled with particles (document 000, sections 4.4-4.5), in three ways.
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

// Writes particles first..last-1 of a cube. `key` = keyed(keyed(seed, cloud), cube). Every centre
// lies in the cube, every radius in (0, cube.radius]. A particle does not depend on `first`, `last`
// or cube.particles.
//
// kUniform: Owen-scrambled Sobol points in position and radius; unbiased and even.
//
// kGardner: the same points, displaced by Gardner's phase shifts (document 002; there the frequency
// FX stands
//   in the third sine, which document 000 eq. 4.6 misprints as the phase Px). With x, y, z from the
//   centre and F = 2 pi / side, PX = pi/2 sin(FY y) + pi sin(FX z / 2), PY = pi/2 sin(FX x) + pi
//   sin(FX z / 2); a phase P of a wave of frequency F is a displacement P / F; what leaves the cube
//   is reflected at its face. The map is odd about the centre, so the cloud stays centred, in
//   clumps and gaps.
//
// kPrinted: eq. 4.2-4.12 as they stand, one statement after the other, with their bias (only the
// positive octant
//   is filled, mean offset +0.2..+0.3 of a side). Eq. 4.12's radius can leave (0, Rmax]; it is
//   clamped to Rmax and drawn again when not positive. At most kMaxPrintedDraws draws a particle,
//   then one uniform in the cube (flat cubes accept 0.2% of draws).
void fill_cube(const Cube& cube, Fill fill, std::uint64_t key, std::uint64_t first,
               std::uint64_t last, FilledParticle* out);

// 30 us a particle at worst; fails once in 6 million at 3% acceptance.
inline constexpr int kMaxPrintedDraws = 512;

// The printed equations for one draw, kept testable. random3 / random1: uniform in (0, 1).
// May lie outside the cube.
glm::dvec3 printed_position(const Cube& cube, glm::dvec3 random3);
// May leave (0, max_radius].
double printed_radius(double max_radius, double random1);

}  // namespace awan
