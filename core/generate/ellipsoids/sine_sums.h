// The two sums of sines of texture.h, shared by its evaluation and the search for its maximum.
#pragma once

#include <array>
#include <cstddef>

#include "core/scene/limits.h"

namespace awan::ellipsoids {

// C(i+1) / Ci as Gardner 1985 prints it.
inline constexpr double kCoefficientRatio = 0.707;

// Two numbers at once. They get the same bits as one by one.
using Pair = double __attribute__((vector_size(16)));

// The integer nearest to x, |x| < 2^51: adding 1.5 * 2^52 and taking it away again rounds, as IEEE 754 has it.
// Number, here and below: a double or a Pair.
template <typename Number>
inline Number nearest(Number x) {
    constexpr double kShift = 0x1.8p52;
    return (x + kShift) - kShift;
}

// The part of a turn that is left beside whole ones, -1/2 .. 1/2; exact. |turns| < 2^51.
template <typename Number>
inline Number part_of_turn(Number turns) {
    return turns - nearest(turns);
}

// sin(2 pi r), |r| <= 1/2, within 1e-9 (the first term left out, at a quarter turn): less than shows in any image or
// float density.
template <typename Number>
inline Number sin_of_part(Number r) {
    // The argument mirrored into -1/4 .. 1/4, where the sine is the same.
    const Number low = r < -0.25 ? -0.5 - r : r;
    const Number folded = r > 0.25 ? 0.5 - r : low;
    const Number x = folded * 6.283185307179586;
    const Number y = x * x;
    Number p = -1.0 / 39916800.0 + y * (1.0 / 6227020800.0);
    p = 1.0 / 362880.0 + y * p;
    p = -1.0 / 5040.0 + y * p;
    p = 1.0 / 120.0 + y * p;
    p = -1.0 / 6.0 + y * p;
    return x + x * y * p;
}

// sin(2 pi turns), |turns| < 2^51.
inline double sin_turns(double turns) {
    return sin_of_part(part_of_turn(turns));
}

// The sines of one term. The half turns, i.e. arguments of half the term's frequency, -1/2 .. 1/2, become those of
// the next term.
struct TermSines {
    double x, z;
};
inline TermSines clean_term(double& half_x, double& half_z, double& half_y) {
    // The phase shift from above, pi sin(FX Z/2), in turns.
    const double height = 0.5 * sin_of_part(half_y);
    const Pair across = {half_z, half_x};
    const Pair phase = 0.25 * sin_of_part(across) + height;
    const Pair half = {half_x, half_z};
    const Pair whole = part_of_turn(2 * half);
    half_x = whole[0];
    half_z = whole[1];
    half_y = part_of_turn(2 * half_y);
    const Pair sines = sin_of_part(part_of_turn(whole + phase));
    return {sines[0], sines[1]};
}

// k = 1 / (the largest value of (A + floor)(B + floor), both factors >= 0), where A and B are the clean sums of
// `terms` terms. Found by a search from coarse to fine that takes a quarter of a millisecond to one. Keeping 25 times
// as many places finds no more, nor does dense sampling (ellipsoids_texture_test).
double scale_to_one(std::size_t terms, double floor, bool in_space,
                    const std::array<double, limits::kMaxTextureTerms>& coefficient);

}  // namespace awan::ellipsoids
