// Random numbers of one path. Counter-based: which numbers a path gets depends on its key alone, so
// neither threads nor the order of pixels show in a picture.
#pragma once

#include <cstdint>

namespace awan::truth {

// SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
class PathRandom {
  public:
    explicit PathRandom(std::uint64_t key) : state_(key) {}

    // Uniform in (0, 1), 53 bits: never 0 or 1.
    double unit() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52; }

    // Uniform in (0, 1], 32 bits in a float.
    float unit_float() { return (static_cast<float>(bits() >> 32) + 1.0f) * 0x1p-32f; }

    // Of random numbers of another kind.
    std::uint64_t key() { return bits(); }

    struct Pair {
        double a, b;
    };
    // Two numbers uniform in (-1, 1), 32 bits each.
    Pair signed_pair() {
        const std::uint64_t x = bits();
        return {
            static_cast<double>(static_cast<std::int32_t>(x >> 32)) * 0x1p-31 + 0x1p-32,
            static_cast<double>(static_cast<std::int32_t>(x & 0xffffffffu)) * 0x1p-31 + 0x1p-32};
    }

  private:
    std::uint64_t bits() {
        std::uint64_t x = (state_ += 0x9e3779b97f4a7c15u);
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    std::uint64_t state_;
};

}  // namespace awan::truth
