// The cloud's matter as the path tracer walks through it, in units of its own: lengths in cells of the
// density lattice, from that lattice's first node; extinction per cell. Scene axes.
//
// Particles at least about two cells wide (in s) are summed on a lattice (lattice.h) of at most 176 cells a side. Of
// the narrower ones, those that would be seen are kept as they are and summed exactly, by lists of those near each
// brick of the lattice, as many as lists of bounded length hold (of those that misplace an optical depth of .05 some
// ten thousand or more, of the others some hundreds); the rest are widened to about a cell, their mass kept.
//
// Error of the extinction: below .35% of the cloud's largest as long as the lists hold all that would be seen; with
// tens of thousands of narrow, thin particles what is finer than a cell is smoothed. Its mean over a few cells is
// exact in any case. Of a Gaussian's cut tails: 1e-5 of its peak. Optical depth towards the sun: below .5% or .005,
// whichever is larger.
//
// With detail (core/generate/detail.h) all particles are on the lattice, which then holds the smooth extinction; the
// lumps are looked up where a path asks, so they are exact, but for the optical depth to the sun, tabulated by cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/detail.h"
#include "core/generate/particle_set.h"
#include "core/truth/lattice.h"

namespace awan::truth {

// Cells along the side of a brick.
inline constexpr int kBrick = 4;

struct Matter {
    // No extinction anywhere; nothing below holds then.
    bool empty = true;
    glm::dvec3 origin{0};
    double cell = 1;  // scene units
    glm::ivec3 nodes{2};
    // Far corner, cells; the near one is 0.
    glm::dvec3 top{1};
    // Per cell; EMPTY when all particles are listed.
    std::vector<float> extinction;
    // Red, green, blue: sums of extinction * colour; EMPTY when every particle is white.
    std::array<std::vector<float>, 3> color;
    bool colored = false;
    // Null: `extinction` is all there is.
    std::shared_ptr<const DetailField> detail;

    glm::ivec3 bricks{1};
    // No lattice extinction in the brick, detail and all, is above it.
    std::vector<float> most;

    struct Listed {
        glm::dvec3 center;  // cells
        double s;           // cells
        double peak;        // extinction, per cell
        double reach2;      // cells^2, it is 0 beyond
        glm::vec3 color;
    };
    std::vector<Listed> listed;
    // Of `listed`, by brick; EMPTY when it is.
    std::vector<std::uint32_t> brick_begin, brick_items;

    // Optical depth towards the sun on a lattice along its rays: p there = sun_axes * p + sun_origin.
    glm::dmat3 sun_axes{1};
    glm::dvec3 sun_origin{0};
    glm::ivec3 sun_nodes{2};
    // EMPTY when all particles are listed.
    std::vector<float> sun_depth;
    struct ListedToSun {
        glm::dvec3 center;
        // depth: of its whole central line.
        double s, depth, reach2;
    };
    // As `listed`, in the sun's lattice.
    std::vector<ListedToSun> to_sun;
    // Of kBrick x kBrick cells of it.
    glm::ivec2 columns{0};
    std::vector<std::uint32_t> column_begin, column_items;

    std::size_t brick(const glm::ivec3& b) const {
        return static_cast<std::size_t>(b.x) +
               static_cast<std::size_t>(bricks.x) *
                   (static_cast<std::size_t>(b.y) +
                    static_cast<std::size_t>(bricks.y) * static_cast<std::size_t>(b.z));
    }
};

// to_sun: unit. Memory: at most 256 MB and 200 bytes a listed particle. Errors: kOverDeadline, kCancelled.
Result<Matter> make_matter(const ParticleSet& particles, const glm::dvec3& to_sun, int threads,
                           const Deadline& deadline);

// Extinction on the lattice with its detail, from the smooth one, at p (cells).
inline double with_detail(const Matter& m, float smooth, const glm::dvec3& p) {
    if (!m.detail || !(smooth > 0)) return static_cast<double>(smooth);
    const double per_unit = static_cast<double>(smooth) / m.cell;
    const glm::dvec3 place = m.origin + m.cell * p;
    return m.cell * static_cast<double>(detailed(*m.detail, static_cast<float>(per_unit),
                                                 bumps_at(*m.detail, place)));
}

// Of all particles at p (cells), per cell. 0 outside.
double extinction(const Matter& matter, const glm::dvec3& p);

// Optical depth from p (cells; anywhere, also outside) to the sun.
double depth_to_sun(const Matter& matter, const glm::dvec3& p);

// Mean colour of the matter at p, weighted by extinction: multiplies the albedo.
glm::dvec3 color_at(const Matter& matter, const glm::dvec3& p);

// Optical depth of one listed particle along o + t d (cells, d unit), t in [from, to].
double listed_depth(const Matter::Listed& one, const glm::dvec3& o, const glm::dvec3& d,
                    double from, double to);

}  // namespace awan::truth
