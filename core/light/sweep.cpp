#include "core/light/sweep.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

// 16 directions of an octant, a lane each.
using Lanes = float __attribute__((vector_size(64)));
static_assert(kDirections == 16);

// By reference: passed by value, a Lanes would change the ABI between the instruction sets.
AWAN_INLINE void load(Lanes& to, const float* from) {
    std::memcpy(&to, from, sizeof to);
}
AWAN_INLINE void store(float* to, const Lanes& from) {
    std::memcpy(to, &from, sizeof from);
}

// Cells along one axis in the order in which the light meets them.
struct Walk {
    int begin, end, step;
    Walk(int count, int sign)
        : begin(sign > 0 ? 0 : count - 1), end(sign > 0 ? count : -1), step(sign) {}
};

struct Task {
    const SweepGrid& grid;
    const Ordinates& ordinates;
    const Ordinates::Octant& octant;
    const float* source;
    const float* inflow;  // 16 directions
    float* moments;       // added to
    float* row;           // radiance into the next cell along y: 16 floats a cell of a row
    float* layer;         // into the next along z: 16 floats a cell of a layer
    // Instead of `inflow`: what enters each cell of the three faces that face the light, 16 floats each. Null: `inflow`
    // everywhere.
    const float *face_x = nullptr, *face_y = nullptr, *face_z = nullptr;
};

AWAN_INLINE void fill(float* to, std::size_t count, const Lanes& value) {
    for (std::size_t i = 0; i < count; ++i) store(to + i * kDirections, value);
}

// |cosines| of the 16 directions to the axes, over the cell's sides.
struct Cosines {
    Lanes x, y, z;
};

// The light's way through one cell. psi_x, psi_y, psi_z: radiance that enters through the faces across x, y and z, and
// on return what leaves through those opposite; psi: the mean over the cell. With c the cosine to an axis over the
// cell's side along it (in units of its shortest), s the depth of the shortest side, q the source:
//     sum over axes of c (psi_out - psi_in) + s psi = q,     psi = theta psi_out + (1 - theta) psi_in along each axis,
//     theta = (3 + tau) / (6 + tau), tau = s / c,     so 1 / theta = (6 c + s) / (3 c + s).
// The factors 1 / theta (tx, ty, tz) share one division. psi_x comes last from the cell before: all that can be is
// computed without it.
AWAN_INLINE void pass_cell(const Cosines& c, float s, const Lanes& q, Lanes& psi_x, Lanes& psi_y,
                           Lanes& psi_z, Lanes& psi) {
    const Lanes ax = 3 * c.x + s, ay = 3 * c.y + s, az = 3 * c.z + s;
    const Lanes inverse = 1 / (ax * ay * az);
    const Lanes tx = (ax + 3 * c.x) * (ay * az) * inverse;
    const Lanes ty = (ay + 3 * c.y) * (ax * az) * inverse;
    const Lanes tz = (az + 3 * c.z) * (ax * ay) * inverse;
    const Lanes wx = c.x * tx, wy = c.y * ty, wz = c.z * tz;
    const Lanes share = 1 / (s + wx + wy + wz);
    const Lanes others = q + wy * psi_y + wz * psi_z;
    psi = (others + wx * psi_x) * share;
    psi_x += (psi - psi_x) * tx;
    psi_y += (psi - psi_y) * ty;
    psi_z += (psi - psi_z) * tz;
}

// Adds the moments of 16 directions' radiance: sum of weight * Y_i * psi.
template <int kHarmonics>
AWAN_INLINE void add_moments(const Ordinates::Octant& octant, const Lanes& psi, float* to) {
    alignas(64) float out[kDirections];
    store(out, psi);
    if constexpr (kHarmonics == 16) {
        Lanes sum;
        load(sum, to);
        for (std::size_t d = 0; d < kDirections; ++d) {
            Lanes weighted;
            load(weighted, octant.weighted[d].data());
            sum += out[d] * weighted;
        }
        store(to, sum);
    } else {
        float sum = 0;
        for (std::size_t d = 0; d < kDirections; ++d) sum += out[d] * octant.weighted[d][0];
        to[0] += sum;
    }
}

// All cells in the order in which an octant's light meets them. kHarmonics: 1 or 16.
template <int kHarmonics>
AWAN_INLINE void walk_octant(const Task& task) {
    const glm::ivec3 n = task.grid.cells;
    const auto nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y);
    Cosines cosines;
    Lanes in;
    load(cosines.x, task.ordinates.cosine[0].data());
    load(cosines.y, task.ordinates.cosine[1].data());
    load(cosines.z, task.ordinates.cosine[2].data());
    // A cell is as if it were cubic and light crossed its longer sides at flatter angles.
    cosines.x /= task.grid.sides.x;
    cosines.y /= task.grid.sides.y;
    cosines.z /= task.grid.sides.z;
    load(in, task.inflow);
    Lanes value[kHarmonics];
    for (std::size_t m = 0; m < kHarmonics; ++m) load(value[m], task.octant.value[m].data());
    if (task.face_z != nullptr)
        std::copy_n(task.face_z, nx * ny * kDirections, task.layer);
    else
        fill(task.layer, nx * ny, in);
    const Walk walk_x(n.x, task.octant.sign.x), walk_y(n.y, task.octant.sign.y),
        walk_z(n.z, task.octant.sign.z);
    for (int k = walk_z.begin; k != walk_z.end; k += walk_z.step) {
        if (task.face_y != nullptr)
            std::copy_n(task.face_y + static_cast<std::size_t>(k) * nx * kDirections,
                        nx * kDirections, task.row);
        else
            fill(task.row, nx, in);
        for (int j = walk_y.begin; j != walk_y.end; j += walk_y.step) {
            const std::size_t across = static_cast<std::size_t>(j) * nx;
            const std::size_t line = static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j);
            Lanes psi_x = in;
            if (task.face_x != nullptr) load(psi_x, task.face_x + line * kDirections);
            for (int i = walk_x.begin; i != walk_x.end; i += walk_x.step) {
                const auto column = static_cast<std::size_t>(i);
                const std::size_t cell = line * nx + column;
                float* const row = task.row + column * kDirections;
                float* const layer = task.layer + (across + column) * kDirections;
                Lanes psi_y, psi_z, psi;
                load(psi_y, row);
                load(psi_z, layer);
                if (task.grid.skip_empty && task.grid.depth[cell] == 0) {
                    pass_cell(cosines, 0, Lanes{}, psi_x, psi_y, psi_z, psi);
                    store(row, psi_y);
                    store(layer, psi_z);
                    continue;
                }
                const float* from = task.source + cell * kHarmonics;
                Lanes q = from[0] * value[0];
                for (std::size_t m = 1; m < kHarmonics; ++m) q += from[m] * value[m];
                pass_cell(cosines, task.grid.depth[cell], q, psi_x, psi_y, psi_z, psi);
                store(row, psi_y);
                store(layer, psi_z);
                add_moments<kHarmonics>(task.octant, psi, task.moments + cell * kHarmonics);
            }
        }
    }
}

AWAN_INLINE void walk_16_body(const Task& task) {
    walk_octant<16>(task);
}
AWAN_INLINE void walk_1_body(const Task& task) {
    walk_octant<1>(task);
}
AWAN_KERNEL(void, walk_16, (const Task& task), (task))
AWAN_KERNEL(void, walk_1, (const Task& task), (task))

// What enters an octant's three faces: along x (y fastest, then z), y (x, then z) and z (x, then y).
struct Faces {
    std::vector<float> x, y, z;
};
Faces faces_of(const glm::ivec3& n, const Ordinates::Octant& octant, const float* inflow,
               const InflowFromBelow& from_below) {
    Faces faces;
    const auto fill_face = [&](std::vector<float>& face, int across, int down, const auto& place) {
        face.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down) *
                    kDirections);
        float* to = face.data();
        for (int b = 0; b < down; ++b)
            for (int a = 0; a < across; ++a)
                for (std::size_t d = 0; d < kDirections; ++d)
                    *to++ = inflow[d] + static_cast<float>(from_below(octant.direction[d],
                                                                      place(a + 0.5, b + 0.5)));
    };
    const glm::dvec3 entry(octant.sign.x > 0 ? 0 : n.x, octant.sign.y > 0 ? 0 : n.y,
                           octant.sign.z > 0 ? 0 : n.z);
    fill_face(faces.x, n.y, n.z, [&](double a, double b) { return glm::dvec3(entry.x, a, b); });
    fill_face(faces.y, n.x, n.z, [&](double a, double b) { return glm::dvec3(a, entry.y, b); });
    fill_face(faces.z, n.x, n.y, [&](double a, double b) { return glm::dvec3(a, b, entry.z); });
    return faces;
}

constexpr std::size_t kGroups = 4;
static_assert(std::tuple_size_v<decltype(SweepSpace::sums)> == kGroups);

AWAN_INLINE void add_groups_body(const SweepSpace& space, std::size_t at, std::size_t count,
                                 float* to) {
    const float *a = space.sums[0].data() + at, *b = space.sums[1].data() + at,
                *c = space.sums[2].data() + at, *d = space.sums[3].data() + at;
    for (std::size_t i = 0; i < count; ++i) to[i] = (a[i] + b[i]) + (c[i] + d[i]);
}
AWAN_KERNEL(void, add_groups,
            (const SweepSpace& space, std::size_t at, std::size_t count, float* to),
            (space, at, count, to))

}  // namespace

void sweep(const SweepGrid& grid, const Ordinates& ordinates, std::span<const float> source,
           const Inflow& inflow, int threads, SweepSpace& space, std::span<float> moments,
           const InflowFromBelow& from_below) {
    const auto harmonics = static_cast<std::size_t>(grid.harmonics);
    assert(harmonics == 1 || harmonics == 16);
    assert(source.size() == harmonics * grid.size() && moments.size() == source.size());
    parallel_for(threads, kGroups, [&](std::size_t group) {
        std::vector<float>&sums = space.sums[group], &row = space.rows[group],
        &layer = space.layers[group];
        sums.assign(moments.size(), 0.F);
        row.resize(static_cast<std::size_t>(grid.cells.x) * kDirections);
        layer.resize(row.size() * static_cast<std::size_t>(grid.cells.y));
        for (std::size_t o = group; o < kOctants; o += kGroups) {
            const Ordinates::Octant& octant = ordinates.octants[o];
            alignas(64) std::array<float, kDirections> in{};
            if (inflow)
                for (std::size_t d = 0; d < kDirections; ++d)
                    in[d] = static_cast<float>(inflow(octant.direction[d]));
            Task task{grid,      ordinates,   octant,     source.data(),
                      in.data(), sums.data(), row.data(), layer.data()};
            Faces faces;
            if (from_below && octant.sign.y > 0) {
                faces = faces_of(grid.cells, octant, in.data(), from_below);
                task.face_x = faces.x.data();
                task.face_y = faces.y.data();
                task.face_z = faces.z.data();
            }
            if (harmonics == 16)
                walk_16(task);
            else
                walk_1(task);
        }
    });
    constexpr std::size_t kBlock = 1u << 14;
    parallel_for(threads, (moments.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
        const std::size_t at = block * kBlock, n = std::min(kBlock, moments.size() - at);
        add_groups(space, at, n, moments.data() + at);
    });
}

}  // namespace awan
