#include "core/generate/keyed_random.h"

#include <bit>
#include <cstring>

namespace awan {
namespace {

// Words: one 32-bit word, or a vector of them.
template <typename Words>
constexpr Words reverse_bits(Words x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// Owen's scrambling: every bit is flipped by a hash of the bits above it. x has its bits reversed, so these lie
// below.
template <typename Words>
Words laine_karras(Words x, Words seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Direction numbers: of each of 32 bits, in four dimensions.
using Directions = std::array<std::array<std::uint32_t, 4>, 32>;

// Bit-reversed: v_k of dimension d has its leading bit at position k.
constexpr Directions make_directions() {
    // Degree s, coefficients a and initial m of the primitive polynomials of dimensions 2-4 (the table
    // new-joe-kuo-6.21201 of Joe & Kuo 2008). Dimension 1 is van der Corput's sequence.
    struct Polynomial {
        int s;
        std::uint32_t a;
        std::array<std::uint32_t, 3> m;
    };
    constexpr std::array<Polynomial, 3> kPolynomials = {
        {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};
    Directions reversed{};
    for (std::size_t k = 0; k < 32; ++k) reversed[k][0] = 1u << k;
    for (std::size_t d = 1; d < 4; ++d) {
        const Polynomial& p = kPolynomials[d - 1];
        const std::size_t s = static_cast<std::size_t>(p.s);
        std::array<std::uint32_t, 32> v{};
        for (std::size_t k = 0; k < 32; ++k) {
            if (k < s) {
                v[k] = p.m[k] << (31 - k);
                continue;
            }
            v[k] = v[k - s] ^ (v[k - s] >> s);
            for (std::size_t i = 1; i < s; ++i)
                if ((p.a >> (s - 1 - i)) & 1u) v[k] ^= v[k - i];
        }
        for (std::size_t k = 0; k < 32; ++k) reversed[k][d] = reverse_bits(v[k]);
    }
    return reversed;
}
constexpr Directions kDirections = make_directions();

}  // namespace

ScrambledSobol::ScrambledSobol(std::uint64_t key, std::uint32_t first)
    : index_(first), state_{}, scramble_{} {
    const std::uint32_t gray = first ^ (first >> 1);
    for (std::size_t d = 0; d < 4; ++d) {
        scramble_[d] = static_cast<std::uint32_t>(keyed(key, d) >> 32);
        for (std::size_t k = 0; k < 32; ++k)
            if ((gray >> k) & 1u) state_[d] ^= kDirections[k][d];
    }
}

std::array<double, 4> ScrambledSobol::next() {
    const Lanes bits = reverse_bits(laine_karras(state_, scramble_));
    const auto changed = static_cast<std::size_t>(std::countr_one(index_)) & 31u;
    Lanes direction;
    std::memcpy(&direction, kDirections[changed].data(), sizeof direction);
    state_ ^= direction;
    ++index_;
    return {unit_open(bits[0]), unit_open(bits[1]), unit_open(bits[2]), unit_open(bits[3])};
}

}  // namespace awan
