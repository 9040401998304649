// The matter of ellipsoids and of the sky plane, on cubic cells.
#pragma once

#include <vector>

#include "core/base/deadline.h"
#include "core/generate/ellipsoids/formations.h"
#include "core/generate/ellipsoids/plane.h"
#include "core/generate/ellipsoids/texture.h"
#include "core/generate/lattice_particles.h"

namespace awan::ellipsoids {

// Opacity, 0..1, at the middles of cells, `resolution` of them along the longest side of the ellipsoids' box. Where
// ellipsoids overlap the most opaque one counts: they are joined, not stacked. No ellipsoids give no cells.
// join: that of the cloud.
LatticeField opacity_of(const std::vector<PlacedEllipsoid>& ellipsoids, double join,
                        std::uint64_t resolution, const TextureFunction& texture, int threads,
                        const Deadline& deadline);

// The opacity of a slab around the plane. At its middle height it is as opaque as Gardner's plane, so that the
// largest opacity on a vertical line is the plane's; towards its faces the threshold rises by `range`, which makes
// the sheet thin where its texture is. A cell has the mean over its height, less where the slab is thinner than the
// cell. It fades out over the outer tenth of the square.
LatticeField opacity_of(const SkyPlane& plane, const PlaneTexture& texture, int threads,
                        const Deadline& deadline);

// The mean opacity of the slab over its thickness, on the vertical line through `place`, which has `parts`.
double column_opacity(const SkyPlane& plane, const PlaneParts& parts, const glm::dvec3& place);

// Opacity times `density` as Gaussians. Cells of hardly any opacity are left out, and the blur of a Gaussian is taken
// back (LatticeOptions::sharpen, lattice_particles.h).
ReadyParticles particles_of(LatticeField opacity, double density, int threads);

// What cells and Gaussians lose: the error of the optical depths of vertical lines (8 x 8 of them, through middles of
// cells) against the ellipsoids or the plane themselves, root mean square over root mean square. 0 where there is
// nothing. particles: made of the lattice with `density`.
double sampling_error(const LatticeField& lattice, const ReadyParticles& particles, double density,
                      const std::vector<PlacedEllipsoid>& ellipsoids, double join,
                      const TextureFunction& texture, int threads, const Deadline& deadline);

double sampling_error(const LatticeField& lattice, const ReadyParticles& particles, double density,
                      const SkyPlane& plane, const PlaneTexture& texture, int threads,
                      const Deadline& deadline);

}  // namespace awan::ellipsoids
