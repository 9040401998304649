#include "core/draw/splat_detail.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "core/draw/splats.h"
#include "core/generate/detail.h"
#include "core/generate/gaussian.h"
#include "core/survey/lattice.h"

namespace awan {
namespace {

// Optical depth of matter that the volume may leave outside.
constexpr double kLeftOut = 0.005;
constexpr int kFewestCells = 16;
// Updates of cells (lattice_work), about 0.05 s of one core.
constexpr double kMostWork = 5e7;

// The standard deviation of the particles in the mean over their matter.
double mean_s(const ParticleSet& particles) {
    double mass = 0, sum = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i), own = central_depth(particles, i) * s * s;
        mass += own;
        sum += own * s;
    }
    return mass > 0 ? sum / mass : 0;
}

Lattice lattice_of(const ParticleSet& particles, int threads) {
    const MatterBox box =
        box_around_matter(particles, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kLeftOut, threads);
    const double s = std::max(mean_s(particles), 1e-6 * longest(box.size));
    const int count = static_cast<int>(
        std::clamp(std::ceil(longest(box.size) / s), 1.0 * kFewestCells, 1.0 * kMostDetailCells));
    return within_work(particles, box, count, kMostWork, cubic_cells);
}

// The widest voxels of bumps whose sides are not seen where particles are many, pixels. Pictures of the automata and
// the implicit clouds change by .3% to .5% of their range (root mean square) where volumes are not interpolated, and
// are drawn in 40% to 60% of the time; one of 9,000 particles has ragged edges, and voxels of many pixels are seen.
constexpr double kSmallVoxel = 2;

// Of the bumps' voxels, as seen where the eye is nearest to the box; infinity within it.
double pixels_of_voxel(const DetailField& field, const Lattice& lattice, const View& view,
                       int height) {
    const glm::dvec3 high = lattice.origin + lattice.cell * glm::dvec3(lattice.cells);
    const double distance = glm::length(glm::clamp(view.eye, lattice.origin, high) - view.eye);
    const double voxel = field.bump * kDetailBumps / kDetailSide;
    return voxel * height / (2 * view.tan_half_fov * distance);
}

// Takes a place in the eye's frame (right, up, forward) to `turn` (place - origin).
glm::mat4x3 from_eye(const glm::dmat3& turn, const glm::dvec3& origin, const View& view) {
    return {glm::vec3(turn * view.right), glm::vec3(turn * view.up), glm::vec3(turn * view.forward),
            glm::vec3(turn * (view.eye - origin))};
}

}  // namespace

SplatDetail splat_detail(const ParticleSet& particles, const View& view, int height, int threads) {
    const DetailField& field = *particles.detail;
    const Lattice lattice = lattice_of(particles, threads);
    std::vector<float> extinction = extinction_in(particles, lattice, threads);
    // Half floats end at 65,504; from 1 on the value does not matter.
    for (float& value : extinction) value = std::min(value / field.edge, 16.F);
    std::vector<std::uint8_t> bytes(std::size_t{kDetailSide} * kDetailSide * kDetailSide);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>((*field.tile)[i] & 255u);

    const glm::dvec3 size = lattice.cell * glm::dvec3(lattice.cells);
    const glm::dmat3 to_box(1 / size.x, 0, 0, 0, 1 / size.y, 0, 0, 0, 1 / size.z);
    const glm::dmat3 to_tile = field.to_tile * (1.0 / kDetailSide);
    glm::mat4x3 to_bumps = from_eye(to_tile, field.origin, view);
    // Whole tiles do not matter, but digits do. A voxel's value stands in its middle.
    const glm::dvec3 eye = to_tile * (view.eye - field.origin);
    to_bumps[3] = glm::vec3(eye - glm::floor(eye) + 0.5 / kDetailSide);
    const bool nearest = particles.size() >= kManySplats &&
                         pixels_of_voxel(field, lattice, view, height) <= kSmallVoxel;
    const auto between = nearest ? gl::BetweenVoxels::kNearest : gl::BetweenVoxels::kLinear;
    return {
        gl::VolumeTexture(lattice.cells.x, lattice.cells.y, lattice.cells.z, extinction, between),
        gl::VolumeTexture(kDetailSide, bytes, between),
        from_eye(to_box, lattice.origin, view),
        to_bumps,
        field.keep,
        static_cast<float>(field.bump),
        field.edge,
        nearest ? glm::vec3(1.0 / glm::dvec3(lattice.cells)) : glm::vec3(0)};
}

}  // namespace awan
