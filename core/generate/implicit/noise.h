// Gradient noise on a keyed lattice, and its octaves. It is that of Perlin 2002, with his twelve gradients, each as
// often as the others, and his fade; the lattice's hash is our own and has no period but 2^32.
#pragma once

#include <array>
#include <cstdint>

#include "core/generate/implicit/lanes.h"

namespace awan::implicit {

// 2^22. Coordinates farther out see what is here: a float has no digits left for a place in a cell there.
inline constexpr float kNoiseReach = 4194304.0f;
// The mean of |noise| and its root mean square, over all places and keys (measured, implicit_noise_test).
inline constexpr float kMeanAbsNoise = 0.2195f, kRmsNoise = 0.2694f;

// One lattice. Coordinates are shifted by whole cells and a place in a cell, which is exact however far that is.
struct NoiseLattice {
    std::uint32_t key = 0;
    std::uint32_t shift_x = 0, shift_y = 0, shift_z = 0;
    float part_x = 0, part_y = 0, part_z = 0;
};

namespace noise_detail {

using lanes::Bits;
using lanes::Floats;
using lanes::Ints;

// Perlin's quintic: 0 at 0, 1 at 1, with its first two derivatives 0 at both.
AWAN_INLINE Floats fade(const Floats& t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// The dot product of (x, y, z) with one of the twelve edges of a cube, chosen by the low ten bits. Perlin 2002 takes
// four bits and four of the edges twice; gradients then have 1.2 times the variance along y that they have along x
// and z.
AWAN_INLINE Floats edge(const Bits& hash, const Floats& x, const Floats& y, const Floats& z) {
    const Bits ten = hash & 1023u;
    // An edge, 0 .. 11.
    const Bits h = ((ten << 3) + (ten << 2)) >> 10;
    const Floats u = h < 4u ? y : x;
    const Floats v = h < 8u ? z : y;
    return lanes::floats(lanes::bits(u) ^ (h << 31)) +
           lanes::floats(lanes::bits(v) ^ ((h & 2u) << 30));
}

// The cell of the lattice that a point lies in.
struct Cell {
    // The place within the cell, 0 .. 1.
    Floats x, y, z;
    // The hashes of the cell's low corner.
    Bits hx, hy, hz;
    // The place faded: the weights of the interpolation.
    Floats fx, fy, fz;
};

inline constexpr std::uint32_t kX = 0x8da6b343u, kY = 0xd8163841u, kZ = 0xcb1ab31fu;

AWAN_INLINE void place(const Floats& at, float part, std::uint32_t shift, std::uint32_t factor,
                       Floats& within, Bits& hash) {
    const Floats x = lanes::clamp(at, -kNoiseReach, kNoiseReach) + part;
    const Ints cell = lanes::floor_int(x);
    within = x - lanes::to_floats(cell);
    hash = (reinterpret_cast<const Bits&>(cell) + shift) * factor;
}

AWAN_INLINE Cell cell_of(const NoiseLattice& lattice, const lanes::Vec& p) {
    Cell c;
    place(p.x, lattice.part_x, lattice.shift_x, kX, c.x, c.hx);
    place(p.y, lattice.part_y, lattice.shift_y, kY, c.y, c.hy);
    place(p.z, lattice.part_z, lattice.shift_z, kZ, c.z, c.hz);
    c.fx = fade(c.x), c.fy = fade(c.y), c.fz = fade(c.z);
    return c;
}

AWAN_INLINE Bits mixed(const Bits& sum) {
    Bits h = sum;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    return h ^ (h >> 15);
}

AWAN_INLINE Floats mix(const Floats& a, const Floats& b, const Floats& t) {
    return a + t * (b - a);
}

}  // namespace noise_detail

// Continuous with its first two derivatives, 0 at lattice points, within +-1.05.
AWAN_INLINE lanes::Floats noise(const NoiseLattice& lattice, const lanes::Vec& p) {
    using namespace noise_detail;
    const Cell c = cell_of(lattice, p);
    Floats row[4];
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const bool up_y = (corner & 1u) != 0, up_z = (corner & 2u) != 0;
        const Bits base = c.hy + (up_y ? kY : 0u) + c.hz + (up_z ? kZ : 0u) + lattice.key;
        const Floats y = up_y ? c.y - 1.0f : c.y, z = up_z ? c.z - 1.0f : c.z;
        const Floats low = edge(mixed(base + c.hx), c.x, y, z);
        const Floats high = edge(mixed(base + c.hx + kX), c.x - 1.0f, y, z);
        row[corner] = mix(low, high, c.fx);
    }
    return mix(mix(row[0], row[1], c.fy), mix(row[2], row[3], c.fy), c.fz);
}

// Three noises that have nothing to do with each other, by other bits of one hash.
AWAN_INLINE lanes::Vec noise3(const NoiseLattice& lattice, const lanes::Vec& p) {
    using namespace noise_detail;
    const Cell c = cell_of(lattice, p);
    Floats row[3][4];
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const bool up_y = (corner & 1u) != 0, up_z = (corner & 2u) != 0;
        const Bits base = c.hy + (up_y ? kY : 0u) + c.hz + (up_z ? kZ : 0u) + lattice.key;
        const Floats y = up_y ? c.y - 1.0f : c.y, z = up_z ? c.z - 1.0f : c.z;
        const Bits low = mixed(base + c.hx), high = mixed(base + c.hx + kX);
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            row[axis][corner] = mix(edge(low >> (10 * axis), c.x, y, z),
                                    edge(high >> (10 * axis), c.x - 1.0f, y, z), c.fx);
    }
    const auto total = [&](const Floats(&r)[4]) __attribute__((always_inline)) {
        return mix(mix(r[0], r[1], c.fy), mix(r[2], r[3], c.fy), c.fz);
    };
    return {total(row[0]), total(row[1]), total(row[2])};
}

inline constexpr int kMostOctaves = 10;

// Octave o has features 2^o times as small as the first and is `weight[o]` strong; a gain of .5 makes 1/f noise.
struct Octaves {
    int count = 0;
    std::array<NoiseLattice, kMostOctaves> lattice;
    std::array<float, kMostOctaves> frequency{};
    std::array<float, kMostOctaves> weight{};
    // What the octaves that are too fine for the lattice would add to the turbulence: the mean, and the root mean
    // square of what varies.
    float rest = 0, rest_rms = 0;
};

// Turbulence of Perlin 1985: the sum of |noise| over the octaves, >= 0.
AWAN_INLINE lanes::Floats turbulence(const Octaves& octaves, const lanes::Vec& p) {
    lanes::Floats sum = lanes::all(octaves.rest);
    for (int o = 0; o < octaves.count; ++o) {
        const auto i = static_cast<std::size_t>(o);
        const float f = octaves.frequency[i];
        sum +=
            octaves.weight[i] * lanes::abs(noise(octaves.lattice[i], {p.x * f, p.y * f, p.z * f}));
    }
    return sum;
}

// Fractional Brownian motion: the sum of noise over the octaves, around 0. Three of them.
AWAN_INLINE lanes::Vec brownian3(const Octaves& octaves, const lanes::Vec& p) {
    lanes::Vec sum{lanes::Floats{}, lanes::Floats{}, lanes::Floats{}};
    for (int o = 0; o < octaves.count; ++o) {
        const auto i = static_cast<std::size_t>(o);
        const float f = octaves.frequency[i], w = octaves.weight[i];
        const lanes::Vec n = noise3(octaves.lattice[i], {p.x * f, p.y * f, p.z * f});
        sum.x += w * n.x, sum.y += w * n.y, sum.z += w * n.z;
    }
    return sum;
}

// The octaves of `key` that a lattice of cells of `cell` can show, seen from a place moved by (x, y, z), all lengths
// in sizes of the largest octave. An octave fades out while its size comes down from 3 cells to 1.5.
Octaves octaves_of(std::uint64_t key, int count, double gain, double cell, double x, double y,
                   double z);

}  // namespace awan::implicit
