// Randomness by key, never by a shared stream: a number depends on the seed and on what it is for,
// so editing one cube leaves the particles of all others as they were.
#pragma once

#include <array>
#include <cstdint>

namespace awan {

// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): a bijection in which every bit of x changes half of the
// result's.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Makes one key out of another and a number. Chains: keyed(keyed(seed, cloud), cube).
constexpr std::uint64_t keyed(std::uint64_t key, std::uint64_t number) {
    return mix_bits(key + 0x9e3779b97f4a7c15u * (number + 1));
}

// 32 random bits as a number uniform in (0, 1): never 0 or 1.
constexpr double unit_open(std::uint32_t bits) {
    return (bits + 0.5) * 0x1p-32;
}

// Points of a low-discrepancy sequence in the open unit 4-cube: Sobol's (direction numbers of Joe & Kuo 2008,
// dimensions 1-4, in Gray-code order), scrambled as in Owen 1995 by the hash of Laine & Karras 2011 with the
// constants of Vegdahl 2021. Any run of the sequence fills the cube evenly, every key gives another realisation, and
// each point is uniform over realisations. Valid for 2^32 points.
class ScrambledSobol {
  public:
    // Starts at point `first` of the realisation `key`.
    ScrambledSobol(std::uint64_t key, std::uint32_t first);
    std::array<double, 4> next();

  private:
    // One lane a dimension. Integers only, so vectors of every width give the same bits.
    using Lanes = std::uint32_t __attribute__((vector_size(16)));

    std::uint32_t index_;
    // The current point, its bits reversed, as the scrambling wants them.
    Lanes state_;
    Lanes scramble_;
};

}  // namespace awan
