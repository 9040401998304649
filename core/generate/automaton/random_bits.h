// Random events for 64 cells at once, each with its probability at full precision, keyed.
//
// A cell's random number is the binary fraction 0.b0 b1 b2 ..., bit n of which is the cell's bit in the n-th word of
// the key. It is compared with the probability digit by digit, the highest first, for all cells of a word at once.
// Where a cell's digit differs its case is decided, and when all are, no more words are drawn: seven on average for
// 64 cells, fewer for fewer. Dobashi et al. 2000 and Upchurch 2009 look up words of 256 ready-made probabilities
// instead, none of which is 0.001.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/generate/keyed_random.h"

namespace awan::automaton {

// A probability as a binary fraction of 64 digits. 0 never happens, 1 always does.
struct Chance {
    // floor(p 2^64), for p < 1.
    std::uint64_t digits = 0;
    bool always = false;
};

// p: 0..1, any double. Those of 2^-11 and more are represented exactly.
inline Chance chance_of(double p) {
    if (p >= 1) return {0, true};
    return {static_cast<std::uint64_t>(p * 0x1p64), false};
}

// Random word number `plane` (0..63) of the 64 cells of word `word`, which is below 2^57.
inline std::uint64_t random_plane(std::uint64_t key, std::uint64_t word, unsigned plane) {
    return keyed(key, word << 7 | plane);
}

// The cells of `lanes` (a bit a cell) to which it happens: random number < p. A cell's answer does not depend on
// which others are asked.
inline std::uint64_t lanes_that_happen(std::uint64_t lanes, Chance chance, std::uint64_t key,
                                       std::uint64_t word) {
    if (chance.always) return lanes;
    std::uint64_t happen = 0, undecided = lanes, digits = chance.digits;
    for (unsigned plane = 0; undecided != 0 && digits != 0; ++plane, digits <<= 1) {
        const std::uint64_t random = random_plane(key, word, plane);
        // The probability's digit, the same for all cells.
        const std::uint64_t digit = 0 - (digits >> 63);
        happen |= undecided & ~random & digit;
        undecided &= ~(random ^ digit);
    }
    return happen;
}

// Binary digits of a distance (fall_off.h).
inline constexpr unsigned kDistancePlanes = 16;

// The same with a probability of its own for each cell: planes[n] holds digit n of every cell, kDistancePlanes of
// them.
inline std::uint64_t lanes_below(std::uint64_t lanes, const std::uint64_t* planes,
                                 std::uint64_t key, std::uint64_t word) {
    std::uint64_t below = 0, undecided = lanes;
    for (unsigned plane = 0; undecided != 0 && plane < kDistancePlanes; ++plane) {
        const std::uint64_t random = random_plane(key, word, plane);
        below |= undecided & ~random & planes[plane];
        undecided &= ~(random ^ planes[plane]);
    }
    return below;
}

}  // namespace awan::automaton
