#include "core/light/sun_depth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"
#include "core/light/sun_columns.h"
#include "core/plan/transport_settings.h"
#include "core/survey/lattice.h"
#include "core/survey/lattice_detail.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Optical depth of matter that the lattice may leave outside.
constexpr double kLeftOut = 0.01;

// A row of nodes along u, and those before and behind it along v (left, right) and w (front, behind); null: there are
// none.
struct NodeRow {
    const float *at, *left, *right, *front, *behind;
    std::size_t count;
    float* to;
};
AWAN_INLINE void settle_row_body(const NodeRow& row) {
    constexpr float kAcross = 1.F / 24 + 1.F / 12, kAlong = 1.F / 12;
    const float* const at = row.at;
    float* __restrict const to = row.to;
    const std::size_t n = row.count;
    const auto bend = [](float before, float here, float after) {
        return before - 2 * here + after;
    };
    to[0] = to[n - 1] = 0;
    for (std::size_t i = 1; i + 1 < n; ++i) to[i] = bend(at[i - 1], at[i], at[i + 1]);
    if (row.left != nullptr)
        for (std::size_t i = 0; i < n; ++i) to[i] += bend(row.left[i], at[i], row.right[i]);
    for (std::size_t i = 0; i < n; ++i) to[i] *= kAcross;
    if (row.front != nullptr)
        for (std::size_t i = 0; i < n; ++i)
            to[i] += kAlong * bend(row.front[i], at[i], row.behind[i]);
    for (std::size_t i = 0; i < n; ++i) to[i] = std::max(at[i] - to[i], 0.F);
}
AWAN_KERNEL(void, settle_row, (const NodeRow& row), (row))

}  // namespace

SunDepth sun_depth(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                   int threads) {
    if (auto leaning = leaning_sun_depth(particles, towards_sun, cells, threads))
        return *std::move(leaning);
    const Lattice lattice = sun_lattice(particles, towards_sun, cells, threads);
    const auto columns =
        static_cast<std::size_t>(lattice.cells.x) * static_cast<std::size_t>(lattice.cells.y);
    return sun_depth_on(lattice, particles, std::vector<float>(columns), threads);
}

Lattice sun_lattice(const ParticleSet& particles, const glm::dvec3& towards_sun, int cells,
                    int threads) {
    const SideAxes side = side_axes(-towards_sun);
    const MatterBox box =
        box_around_matter(particles, side.u, side.v, -towards_sun, kLeftOut, threads);
    return within_work(particles, box, spread_count(box.size, cells, kMostSunSpread), kMaxSunWork,
                       cubic_cells);
}

SunDepth sun_depth_on(const Lattice& lattice, const ParticleSet& particles,
                      std::vector<float> entry, int threads) {
    SunDepth sun;
    sun.u = lattice.u;
    sun.v = lattice.v;
    sun.w = lattice.w;
    sun.cell = lattice.cell;
    // Nodes stand in the middle of the columns and on the faces between their cells.
    sun.origin = lattice.origin + 0.5 * (sun.cell.x * sun.u + sun.cell.y * sun.v);
    sun.nodes = lattice.cells + glm::ivec3(0, 0, 1);
    std::vector<float> extinction = extinction_in(particles, lattice, threads);
    add_detail(particles, lattice, threads, extinction);
    const std::size_t layer = entry.size();
    sun.depth = std::move(entry);
    sun.depth.resize(layer * static_cast<std::size_t>(sun.nodes.z));
    const auto cell = static_cast<float>(sun.cell.z);
    for (std::size_t i = 0; i < extinction.size(); ++i)
        sun.depth[layer + i] = sun.depth[i] + extinction[i] * cell;
    settle_nodes(sun, threads);
    return sun;
}

glm::dmat3 to_nodes(const SunDepth& sun) {
    const glm::dvec3 across = glm::cross(sun.v, sun.w);
    const double volume = glm::dot(sun.u, across);
    return glm::transpose(glm::dmat3(across / (volume * sun.cell.x),
                                     glm::cross(sun.w, sun.u) / (volume * sun.cell.y),
                                     glm::cross(sun.u, sun.v) / (volume * sun.cell.z)));
}

void settle_nodes(SunDepth& sun, int threads) {
    const std::vector<float> before = sun.depth;
    const auto nx = static_cast<std::size_t>(sun.nodes.x),
               ny = static_cast<std::size_t>(sun.nodes.y),
               nz = static_cast<std::size_t>(sun.nodes.z), layer = nx * ny;
    parallel_for(threads, nz, [&](std::size_t k) {
        // At an end there is no second difference.
        const bool along = k > 0 && k + 1 < nz;
        for (std::size_t j = 0; j < ny; ++j) {
            const bool across = j > 0 && j + 1 < ny;
            const std::size_t row = k * layer + j * nx;
            const float* const at = before.data() + row;
            settle_row({.at = at,
                        .left = across ? at - nx : nullptr,
                        .right = across ? at + nx : nullptr,
                        .front = along ? at - layer : nullptr,
                        .behind = along ? at + layer : nullptr,
                        .count = nx,
                        .to = sun.depth.data() + row});
        }
    });
}

double depth_at(const SunDepth& sun, const glm::dvec3& point) {
    return sun.depth.empty() ? 0 : depth_at(sun, to_nodes(sun), point);
}

double depth_at(const SunDepth& sun, const glm::dmat3& nodes, const glm::dvec3& point) {
    if (sun.depth.empty()) return 0;
    const glm::dvec3 at =
        glm::clamp(nodes * (point - sun.origin), glm::dvec3(0), glm::dvec3(sun.nodes - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(at), glm::max(sun.nodes - 2, glm::ivec3(0)));
    const glm::ivec3 high = glm::min(low + 1, sun.nodes - 1);
    const glm::dvec3 t = at - glm::dvec3(low);
    const auto node = [&](int i, int j, int k) {
        return static_cast<double>(
            sun.depth[(static_cast<std::size_t>(k) * static_cast<std::size_t>(sun.nodes.y) +
                       static_cast<std::size_t>(j)) *
                          static_cast<std::size_t>(sun.nodes.x) +
                      static_cast<std::size_t>(i)]);
    };
    const auto along_u = [&](int j, int k) {
        return glm::mix(node(low.x, j, k), node(high.x, j, k), t.x);
    };
    const auto along_v = [&](int k) {
        return glm::mix(along_u(low.y, k), along_u(high.y, k), t.y);
    };
    return glm::mix(along_v(low.z), along_v(high.z), t.z);
}

}  // namespace awan
