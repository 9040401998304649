#include "core/light/sweep_layer.h"

#include <algorithm>
#include <cstring>

#include "core/base/instruction_sets.h"

namespace awan {
namespace {

// 16 directions of an octant, a lane each.
using Lanes = float __attribute__((vector_size(64)));
static_assert(kDirections == 16 && kHarmonics == 16);
constexpr std::size_t kLanes = 16;
// Floats of a cell: four octants of 16 directions; as many for tx, ty, tz and share.
constexpr std::size_t kOfCell = kSide * kLanes;

// Of each harmonic (harmonics.h), whether its sign changes with that of x (1) and of y (2).
constexpr std::array<std::size_t, kHarmonics> kParity = {0, 1, 2, 0, 1, 3, 0, 2,
                                                         0, 1, 3, 1, 2, 0, 2, 0};

// By reference: passed by value, a Lanes would change the ABI between the instruction sets.
AWAN_INLINE void load(Lanes& to, const float* from) {
    std::memcpy(&to, from, sizeof to);
}
AWAN_INLINE void store(float* to, const Lanes& from) {
    std::memcpy(to, &from, sizeof from);
}

// With c the cosine to an axis over the cell's side along it (in units of its shortest), s the depth of the shortest
// side, q the source:
//     sum over axes of c (psi_out - psi_in) + s psi = q,     psi = theta psi_out + (1 - theta) psi_in along each axis,
//     theta = (3 + tau) / (6 + tau), tau = s / c,     so 1 / theta = (6 c + s) / (3 c + s).
// The factors 1 / theta (tx, ty, tz) share one division; share = 1 / (s + sum of c / theta).
struct Cosines {
    Lanes x, y, z;
};
AWAN_INLINE void put_factors(const Cosines& c, float s, float* to) {
    const Lanes ax = 3 * c.x + s, ay = 3 * c.y + s, az = 3 * c.z + s;
    const Lanes inverse = 1 / (ax * ay * az);
    const Lanes tx = (ax + 3 * c.x) * (ay * az) * inverse;
    const Lanes ty = (ay + 3 * c.y) * (ax * az) * inverse;
    const Lanes tz = (az + 3 * c.z) * (ax * ay) * inverse;
    const Lanes share = 1 / (s + c.x * tx + c.y * ty + c.z * tz);
    store(to, tx);
    store(to + kLanes, ty);
    store(to + 2 * kLanes, tz);
    store(to + 3 * kLanes, share);
}
AWAN_INLINE void load_cosines(const SideSweep& side, Cosines& c) {
    load(c.x, side.cosine[0].data());
    load(c.y, side.cosine[1].data());
    load(c.z, side.cosine[2].data());
}

template <std::size_t kCount>
AWAN_INLINE void expand(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end) {
    const SweepGrid& grid = side.grid;
    const SweepSource& source = side.source;
    const std::size_t layer = k * grid.layer_size();
    Cosines cosines;
    load_cosines(side, cosines);
    Lanes value[kCount], first;
    for (std::size_t m = 0; m < kCount; ++m) load(value[m], side.value[m].data());
    load(first, side.first.data());
    // What an empty cell has.
    alignas(64) float empty[kOfCell];
    put_factors(cosines, 0, empty);
    for (std::size_t c = begin; c < end; ++c) {
        const std::size_t cell = layer + c;
        float* const factors = side.space.factors.data() + c * kOfCell;
        float* const to = side.space.radiance.data() + c * kOfCell;
        const float depth = grid.depth[cell];
        if (depth == 0)
            std::memcpy(factors, empty, sizeof empty);
        else
            put_factors(cosines, depth, factors);
        if (grid.skip_empty && depth == 0) {
            std::memset(to, 0, kOfCell * sizeof(float));
            continue;
        }
        const float* const from = source.moments.data() + cell * kCount;
        Lanes sum[kSide] = {};
        sum[0] = from[0] * value[0];
        if constexpr (kCount == kHarmonics) {
            // By parity (kParity).
            sum[0] = sum[0] + from[3] * value[3] + from[6] * value[6] + from[8] * value[8] +
                     from[13] * value[13] + from[15] * value[15];
            sum[1] =
                from[1] * value[1] + from[4] * value[4] + from[9] * value[9] + from[11] * value[11];
            sum[2] = from[2] * value[2] + from[7] * value[7] + from[12] * value[12] +
                     from[14] * value[14];
            sum[3] = from[5] * value[5] + from[10] * value[10];
        }
        if (!source.scale.empty())
            for (Lanes& one : sum) one *= source.scale[cell];
        if (!source.even.empty()) sum[0] += source.even[cell] * first;
        const Lanes a = sum[0] + sum[1], b = sum[0] - sum[1], e = sum[2] + sum[3],
                    h = sum[2] - sum[3];
        store(to, a + e);
        store(to + kLanes, b + h);
        store(to + 2 * kLanes, a - e);
        store(to + 3 * kLanes, b - h);
    }
}

// The light's way through one cell. psi_x, psi_y, psi_z: radiance that enters through the faces across x, y and z, and
// on return what leaves through those opposite; psi: the source, and on return the mean over the cell. psi_x comes last
// from the cell before: all that can be is computed without it.
AWAN_INLINE void pass_cell(const Cosines& c, const float* factors, Lanes& psi_x, Lanes& psi_y,
                           Lanes& psi_z, Lanes& psi) {
    Lanes tx, ty, tz, share;
    load(tx, factors);
    load(ty, factors + kLanes);
    load(tz, factors + 2 * kLanes);
    load(share, factors + 3 * kLanes);
    const Lanes wx = c.x * tx, wy = c.y * ty, wz = c.z * tz;
    const Lanes others = psi + wy * psi_y + wz * psi_z;
    psi = (others + wx * psi_x) * share;
    psi_x += (psi - psi_x) * tx;
    psi_y += (psi - psi_y) * ty;
    psi_z += (psi - psi_z) * tz;
}

template <std::size_t kCount>
AWAN_INLINE void walk(const SideSweep& side, std::size_t k, std::size_t octant) {
    const auto nx = static_cast<std::size_t>(side.grid.cells.x),
               ny = static_cast<std::size_t>(side.grid.cells.y);
    Cosines cosines;
    load_cosines(side, cosines);
    float* const row = side.space.row.data();
    for (std::size_t o = octant; o < octant + kCount; ++o) {
        const OctantInflow& inflow = side.inflow[o];
        for (std::size_t i = 0; i < nx; ++i)
            std::memcpy(
                row + (i * kSide + o) * kLanes,
                inflow.y.empty() ? inflow.in.data() : inflow.y.data() + (k * nx + i) * kLanes,
                sizeof(Lanes));
    }
    for (std::size_t j = 0; j < ny; ++j) {
        Lanes psi_x[kCount];
        std::size_t line[kCount];
#pragma GCC unroll 4
        for (std::size_t n = 0; n < kCount; ++n) {
            const OctantInflow& inflow = side.inflow[octant + n];
            line[n] = ((octant + n) & 2) != 0 ? ny - 1 - j : j;
            load(psi_x[n], inflow.x.empty() ? inflow.in.data()
                                            : inflow.x.data() + (k * ny + line[n]) * kLanes);
        }
        for (std::size_t i = 0; i < nx; ++i) {
#pragma GCC unroll 4
            for (std::size_t n = 0; n < kCount; ++n) {
                const std::size_t o = octant + n;
                const std::size_t column = (o & 1) != 0 ? nx - 1 - i : i;
                const std::size_t cell = line[n] * nx + column;
                float* const along_y = row + (column * kSide + o) * kLanes;
                float* const along_z = side.space.layer.data() + (cell * kSide + o) * kLanes;
                float* const radiance = side.space.radiance.data() + (cell * kSide + o) * kLanes;
                Lanes psi_y, psi_z, psi;
                load(psi_y, along_y);
                load(psi_z, along_z);
                load(psi, radiance);
                pass_cell(cosines, side.space.factors.data() + cell * kOfCell, psi_x[n], psi_y,
                          psi_z, psi);
                store(along_y, psi_y);
                store(along_z, psi_z);
                store(radiance, psi);
            }
        }
    }
}

// A quarter of a Lanes, which every instruction set can reorder.
using Quarter = float __attribute__((vector_size(16)));

// to[m] = the sum of the lanes of x[m], in an order that is the same for both: within quarters lanes 0 and 2, 1 and 3,
// then these; then the quarters in the same way as pairs.
AWAN_INLINE void add_lanes_in_quarters(const Lanes* x, Lanes& to) {
    Quarter sums[4];
    for (std::size_t g = 0; g < 4; ++g) {
        Quarter part[4];
        for (std::size_t p = 0; p < 4; ++p) {
            Quarter a[4];
            for (std::size_t i = 0; i < 4; ++i)
                std::memcpy(&a[i],
                            reinterpret_cast<const char*>(&x[4 * g + i]) + p * sizeof(Quarter),
                            sizeof(Quarter));
            const Quarter b = __builtin_shufflevector(a[0], a[1], 0, 4, 1, 5) +
                              __builtin_shufflevector(a[0], a[1], 2, 6, 3, 7);
            const Quarter d = __builtin_shufflevector(a[2], a[3], 0, 4, 1, 5) +
                              __builtin_shufflevector(a[2], a[3], 2, 6, 3, 7);
            part[p] = __builtin_shufflevector(b, d, 0, 1, 4, 5) +
                      __builtin_shufflevector(b, d, 2, 3, 6, 7);
        }
        sums[g] = (part[0] + part[1]) + (part[2] + part[3]);
    }
    std::memcpy(&to, sums, sizeof to);
}
AWAN_INLINE void add_lanes_whole(const Lanes* x, Lanes& to) {
    Lanes b[8], c[4], d[2];
    for (std::size_t i = 0; i < 8; ++i)
        b[i] = __builtin_shufflevector(x[2 * i], x[2 * i + 1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9,
                                       25, 12, 28, 13, 29) +
               __builtin_shufflevector(x[2 * i], x[2 * i + 1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26,
                                       11, 27, 14, 30, 15, 31);
    for (std::size_t i = 0; i < 4; ++i)
        c[i] = __builtin_shufflevector(b[2 * i], b[2 * i + 1], 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24,
                                       25, 12, 13, 28, 29) +
               __builtin_shufflevector(b[2 * i], b[2 * i + 1], 2, 3, 18, 19, 6, 7, 22, 23, 10, 11,
                                       26, 27, 14, 15, 30, 31);
    for (std::size_t i = 0; i < 2; ++i)
        d[i] = __builtin_shufflevector(c[2 * i], c[2 * i + 1], 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18,
                                       19, 24, 25, 26, 27) +
               __builtin_shufflevector(c[2 * i], c[2 * i + 1], 4, 5, 6, 7, 12, 13, 14, 15, 20, 21,
                                       22, 23, 28, 29, 30, 31);
    to = __builtin_shufflevector(d[0], d[1], 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26,
                                 27) +
         __builtin_shufflevector(d[0], d[1], 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30,
                                 31);
}

// What of the moments `own` of one side becomes of a cell's result, and of `first`, the first of them.
AWAN_INLINE void put_moments(const SweepResult& result, bool second, std::size_t cell, Lanes& own) {
    float* const to = result.to.data() + cell * kHarmonics;
    if (second) {
        Lanes before;
        load(before, to);
        own += before;
        if (!result.from.empty()) {
            Lanes from;
            load(from, result.from.data() + cell * kHarmonics);
            if (!result.addition.empty()) from[0] += result.addition[cell];
            own = from - own;
        }
    }
    store(to, own);
}
AWAN_INLINE void put_moment(const SweepResult& result, bool second, std::size_t cell, float own) {
    float& to = result.to[cell];
    if (second) {
        own += to;
        if (!result.from.empty()) {
            float from = result.from[cell];
            if (!result.addition.empty()) from += result.addition[cell];
            own = from - own;
        }
    }
    to = own;
}

template <std::size_t kCount, bool kWide>
AWAN_INLINE void gather(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end,
                        bool second, const SweepResult& result) {
    const SweepGrid& grid = side.grid;
    const std::size_t layer = k * grid.layer_size();
    Lanes weighted[kCount];
    for (std::size_t m = 0; m < kCount; ++m) load(weighted[m], side.weighted[m].data());
    for (std::size_t c = begin; c < end; ++c) {
        const std::size_t cell = layer + c;
        const bool empty = grid.skip_empty && grid.depth[cell] == 0;
        const float* const from = side.space.radiance.data() + c * kOfCell;
        Lanes p[kSide];
        for (std::size_t o = 0; o < kSide; ++o) load(p[o], from + o * kLanes);
        const Lanes a = p[0] + p[1], b = p[0] - p[1], e = p[2] + p[3], h = p[2] - p[3];
        if constexpr (kCount == kHarmonics) {
            Lanes own = {};
            if (!empty) {
                const Lanes sum[kSide] = {a + e, b + h, a - e, b - h};
                Lanes x[kHarmonics];
#pragma GCC unroll 16
                for (std::size_t m = 0; m < kHarmonics; ++m) x[m] = sum[kParity[m]] * weighted[m];
                if constexpr (kWide)
                    add_lanes_whole(x, own);
                else
                    add_lanes_in_quarters(x, own);
            }
            put_moments(result, second, cell, own);
        } else {
            float own = 0;
            if (!empty) {
                const Lanes x = (a + e) * weighted[0];
                for (std::size_t d = 0; d < kLanes; ++d) own += x[d];
            }
            put_moment(result, second, cell, own);
        }
    }
}

AWAN_INLINE void expand_16_body(const SideSweep& side, std::size_t k, std::size_t begin,
                                std::size_t end) {
    expand<kHarmonics>(side, k, begin, end);
}
AWAN_INLINE void expand_1_body(const SideSweep& side, std::size_t k, std::size_t begin,
                               std::size_t end) {
    expand<1>(side, k, begin, end);
}
AWAN_INLINE void walk_4_body(const SideSweep& side, std::size_t k, std::size_t octant) {
    walk<4>(side, k, octant);
}
AWAN_INLINE void walk_2_body(const SideSweep& side, std::size_t k, std::size_t octant) {
    walk<2>(side, k, octant);
}
AWAN_INLINE void walk_1_body(const SideSweep& side, std::size_t k, std::size_t octant) {
    walk<1>(side, k, octant);
}
template <std::size_t kFloats>
AWAN_INLINE void gather_16_body(const SideSweep& side, std::size_t k, std::size_t begin,
                                std::size_t end, bool second, const SweepResult& result) {
    gather<kHarmonics, kFloats == kLanes>(side, k, begin, end, second, result);
}
AWAN_INLINE void gather_1_body(const SideSweep& side, std::size_t k, std::size_t begin,
                               std::size_t end, bool second, const SweepResult& result) {
    gather<1, false>(side, k, begin, end, second, result);
}

AWAN_KERNEL(void, expand_16,
            (const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end),
            (side, k, begin, end))
AWAN_KERNEL(void, expand_1,
            (const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end),
            (side, k, begin, end))
AWAN_KERNEL(void, walk_4, (const SideSweep& side, std::size_t k, std::size_t octant),
            (side, k, octant))
AWAN_KERNEL(void, walk_2, (const SideSweep& side, std::size_t k, std::size_t octant),
            (side, k, octant))
AWAN_KERNEL(void, walk_1, (const SideSweep& side, std::size_t k, std::size_t octant),
            (side, k, octant))
AWAN_KERNEL_BY_WIDTH(void, gather_16,
                     (const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end,
                      bool second, const SweepResult& result),
                     (side, k, begin, end, second, result))
AWAN_KERNEL(void, gather_1,
            (const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end, bool second,
             const SweepResult& result),
            (side, k, begin, end, second, result))

}  // namespace

void expand_cells(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end) {
    if (side.grid.harmonics == kHarmonics)
        expand_16(side, k, begin, end);
    else
        expand_1(side, k, begin, end);
}

void walk_layer(const SideSweep& side, std::size_t k, std::size_t octant, std::size_t count) {
    if (count == 4)
        walk_4(side, k, octant);
    else if (count == 2)
        walk_2(side, k, octant);
    else
        walk_1(side, k, octant);
}

void gather_cells(const SideSweep& side, std::size_t k, std::size_t begin, std::size_t end,
                  bool second, const SweepResult& result) {
    if (side.grid.harmonics == kHarmonics)
        gather_16(side, k, begin, end, second, result);
    else
        gather_1(side, k, begin, end, second, result);
}

}  // namespace awan
