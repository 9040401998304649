// The cloud's matter as the path tracer walks through it: extinction on a lattice whose third axis is the way that
// sunlight goes, so that the optical depth to the sun is known as exactly as the extinction itself.
//
// The extinction is trilinear between the nodes of a lattice with cubic cells. Every node also holds the depth gathered
// along its row, from the sun's side, by the trapezium rule. Between four rows extinction is bilinear, along them
// linear, so that
//     depth(x, y, z_k + f) = depth_k + sigma_k f + (sigma_(k+1) - sigma_k) f^2 / 2,  each bilinear in x and y,
// is the integral of the very field that free flights are drawn from, whatever the cells' size: no cloud is too wide.
//
// Only bricks of kBrick^3 cells in which there is matter have nodes, so that the cell follows the cloud's volume, not
// its extent. The field has the mass and the widths of the particles (lattice.h); it ripples about their sum by at most
// 1 / (4 s^2) of a narrow particle's peak, s in cells. Of those that this shows in, the most are kept as they are
// ("listed") and summed in closed form, as far as the cost of meeting them allows (choose_listed in matter_build.cpp);
// what is narrower than a cell otherwise is widened to it.
//
// With detail (core/generate/detail.h) all particles are on the lattice, which then holds the smooth extinction. The
// lumps are looked up where a path asks; the depth at the nodes is that of lumps at nodes, good for choosing what to
// try, not as light: light from the sun is found by flights then (sun_through in flight.h).
//
// Places are in cells from `origin`, scene axes ("p"), or in cells of the lattice ("q"); q = axes * p + shift.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/detail.h"
#include "core/generate/particle_set.h"

namespace awan::truth {

// Cells along the side of a brick; it has one node more along each.
inline constexpr int kBrick = 4;
inline constexpr int kBrickNodes = kBrick + 1;
// Nodes from one brick to the next in `nodes`: 125 and 3 of padding, 1 kB.
inline constexpr std::size_t kBrickStride = 128;
inline constexpr std::uint32_t kNoNodes = 0x7ffffffu;
inline constexpr int kMostLevels = 6;

struct Node {
    // Per cell, and gathered from the sun's side.
    float extinction, depth;
};

// A brick, whether there is matter or not. Where there is little of it, flights take many bricks at a time: blocks of
// kBrick 2^level cells a side, at multiples of that, with one majorant.
struct Brick {
    // No lattice extinction in the block that the brick belongs to, detail and all, is above it.
    float most = 0;
    // Of its first node, over kBrickStride; kNoNodes: all are 0.
    std::uint32_t nodes : 27 = kNoNodes;
    // Of its block, 0..kMostLevels.
    std::uint32_t level : 4 = 0;
    // Whether there are listed particles; then it is a block of its own.
    std::uint32_t listed : 1 = 0;
};

struct Matter {
    // No extinction anywhere; nothing below holds then.
    bool empty = true;
    glm::dvec3 origin{0};
    double cell = 1;  // scene units
    // Far corner of the box that holds all matter, cells, scene axes; the near one is 0.
    glm::dvec3 top{1};
    glm::dmat3 axes{1};
    glm::dvec3 shift{0};

    // Bricks along each axis of the lattice; z, along the sun's light, fastest in `brick`, as in a brick's nodes.
    glm::ivec3 bricks{1};
    std::vector<Brick> brick;
    std::vector<Node> nodes;
    // Sums of extinction * colour, r g b, like `nodes`; EMPTY when every particle is white.
    std::vector<glm::vec3> tints;
    bool colored = false;
    // Null: `nodes` is all there is.
    std::shared_ptr<const DetailField> detail;

    struct Listed {
        glm::dvec3 center;  // q
        double s;           // cells
        double peak;        // extinction, per cell
        double reach2;      // cells^2, it is 0 beyond
        glm::vec3 color;
    };
    std::vector<Listed> listed;
    // Of `listed`, by brick and by column of bricks along the light; EMPTY when it is.
    std::vector<std::uint32_t> brick_begin, brick_items, column_begin, column_items;

    glm::dvec3 lattice_top() const { return glm::dvec3(bricks * kBrick); }
    std::size_t column(int x, int y) const {
        return static_cast<std::size_t>(x) * static_cast<std::size_t>(bricks.y) +
               static_cast<std::size_t>(y);
    }
    std::size_t brick_at(const glm::ivec3& b) const {
        return column(b.x, b.y) * static_cast<std::size_t>(bricks.z) +
               static_cast<std::size_t>(b.z);
    }
};

// to_sun: unit. Memory: at most about 100 MB (twice that while it is made, more with colours) and 200 bytes a
// particle. Errors: kOverDeadline, kCancelled.
Result<Matter> make_matter(const ParticleSet& particles, const glm::dvec3& to_sun, int threads,
                           const Deadline& deadline);

// Extinction on the lattice with its detail, from the smooth one. bumps(field): n at the place.
template <typename Bumps>
double with_bumps(const Matter& m, float smooth, const Bumps& bumps) {
    if (!m.detail || !(smooth > 0)) return static_cast<double>(smooth);
    const DetailField& field = *m.detail;
    const auto per_unit = static_cast<float>(static_cast<double>(smooth) / m.cell);
    // Within there are no bumps to look up.
    const float n = per_unit < field.edge ? bumps(field) : 1;
    return m.cell * static_cast<double>(detailed(field, per_unit, n));
}

// The same at q.
inline double with_detail(const Matter& m, float smooth, const glm::dvec3& q) {
    return with_bumps(m, smooth, [&](const DetailField& field) {
        return bumps_at(field, m.origin + m.cell * ((q - m.shift) * m.axes));
    });
}

// Of all particles at p, per cell. 0 outside.
double extinction(const Matter& matter, const glm::dvec3& p);

// Optical depth from p (anywhere, also outside) to the sun; with detail only about.
double depth_to_sun(const Matter& matter, const glm::dvec3& p);

// Mean colour of the matter at p, weighted by extinction: multiplies the albedo.
glm::dvec3 color_at(const Matter& matter, const glm::dvec3& p);

// The same three at q; of the lattice's extinction only what is smooth.
float smooth_extinction_at(const Matter& matter, const glm::dvec3& q);
double depth_to_sun_at(const Matter& matter, const glm::dvec3& q);
glm::dvec3 color_in_lattice(const Matter& matter, const glm::dvec3& q);

// Depth of the listed particles alone, from q to the sun.
double listed_depth_to_sun(const Matter& matter, const glm::dvec3& q);

// Optical depth of one listed particle along o + t d (q, d unit), t in [from, to].
double listed_depth(const Matter::Listed& one, const glm::dvec3& o, const glm::dvec3& d,
                    double from, double to);

// The brick that holds q, or the nearest to it.
glm::ivec3 brick_of(const Matter& matter, const glm::dvec3& q);

}  // namespace awan::truth
