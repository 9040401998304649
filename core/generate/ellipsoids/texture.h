// The texturing function of Gardner 1985:
//   T(X,Y,Z) = k sum Ci [sin(FXi X + PXi) + T0] * sum Ci [sin(FYi Y + PYi) + T0],   i = 1 .. n
//   F(i+1) = 2 Fi,  C(i+1) = .707 Ci,  C1 = 1,  k so that max T = 1
//   PXi = pi/2 sin(FY(i-1) Y),  PYi = pi/2 sin(FX(i-1) X)            (on a plane)
//   P'  = P + pi sin(FXi Z/2), both                                  (in space)
//
// Z is up there; in our axes X, Y, Z are x, z, y. F0 is F1 / 2, as the rows before would have it. Every argument is
// kept in turns, where doubling is exact: T has the period 4 pi / F1 along each axis, to the last bit of the first
// term's argument.
//
// Where the print falls short:
// * T0 is free, and below what the sines reach (about .8) a factor goes below zero. Two negative factors make a
//   positive T: clouds stand where the sky should be clearest, and at T0 = 0 there are as many of these as of the
//   others. Clean: a factor below 0 is 0.
// * Sunar et al. 2005 (4.6), who quote the phases in space, have pi sin(P Z/2) with the phase P itself, in place of
//   pi sin(F Z/2) with the frequency. Where P is 0 there is then no change with height at all, and fine terms change
//   no faster than coarse ones. TextureForm::kPrinted is T with these phases (one after the other, as printed there)
//   and with negative factors; its k is the safe one, from the sum of the coefficients.
// * k from that sum, 1 / ((1 + T0) sum Ci)^2, gives no maximum of 1: on a plane not all sines are 1 anywhere, and max
//   T would be .64 to .84 for T0 = .5 (2 to 8 terms), .48 for T0 = 0 and 7. In space the height turns them all nearly
//   together, to .93 and up (ellipsoids_texture_test). Ours is searched for.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/scene/ellipsoids.h"
#include "core/scene/limits.h"

namespace awan::ellipsoids {

// By hand (SineTexture::sines) row i has FXi, FYi and Ci as they are given, and its phases are added to PXi and PYi;
// what is printed of P and P' holds with these frequencies. As there is no common period then, k is that of the
// largest T that is found over some of the longest waves: here and there T is up to a tenth more than 1.

// One row of the two sums, by hand. Frequencies in turns a unit, phases in turns.
struct HandSine {
    double x = 0, z = 0;
    // FY(i-1) and FX(i-1).
    double z_before = 0, x_before = 0;
    double phase_x = 0, phase_z = 0;
    // By how much more the blurs of this row are than those of the first.
    double blur_x = 1, blur_z = 1;
};

// T, ready to be evaluated.
struct TextureFunction {
    std::size_t terms = 1;
    // Else on a plane, and the height is unused.
    bool in_space = true;
    bool printed = false;
    // F0 / (2 pi): how many turns half the first frequency makes in a unit.
    double turns_x = 0, turns_z = 0;
    // T0 * sum Ci: what T0 adds to either sum.
    double floor = 0;
    // k, by which the largest T is 1.
    double scale = 1;
    // Subtracted from the place: drift * time, units.
    glm::dvec3 shift{0};
    // Ci, the weights of the terms.
    std::array<double, limits::kMaxTextureTerms> coefficient{};
    // Empty where frequencies are doubled by the rule.
    std::vector<HandSine> by_hand{};
};

// The function of a texture: with its k, which takes up to a millisecond to find.
TextureFunction texture_function(const SineTexture& texture, bool in_space,
                                 const glm::dvec3& shift = glm::dvec3(0));

// T where a pixel or a cell sees more than a point: its mean, and the variance about it of what is too fine to be
// seen.
struct TextureValue {
    double mean = 0;
    double variance = 0;
};

// T at a place (our axes, the cloud's units). blur_x, blur_z: the variance, radians^2, of the argument of the first
// sine of either sum over what is seen; that of term i is 4^(i-1) times as large. A Gaussian of places leaves
// exp(-variance/2) of a sine. Taken is (1 + variance/16)^-8, within .03 of it, in plain arithmetic that is the same
// on every machine. 0: a point.
TextureValue texture_at(const TextureFunction& texture, const glm::dvec3& place, double blur_x = 0,
                        double blur_z = 0);

// The same of a texture by hand, which has as many rows as terms.
TextureValue hand_texture_at(const TextureFunction& texture, const glm::dvec3& place, double blur_x,
                             double blur_z);

// Fills in the rows of a texture by hand, and its k.
void take_by_hand(const SineTexture& texture, TextureFunction& function);

// The share of a sine that is left by a blur of that variance, radians^2.
double kept_of_sine(double variance);

// What one `step` (units) as a standard deviation adds to blur_x or, where along_z, to blur_z. The slopes of the
// phases are in it, by their mean squares. Steps at right angles to each other add up.
double blur_along(const TextureFunction& texture, bool along_z, const glm::dvec3& step);

// The same for a blob: `sigma` (units) along all three axes.
double blur_of_blob(const TextureFunction& texture, bool along_z, double sigma);

// The share of a texel that is opaque: the mean of clamp((T - threshold)/range, 0, 1) over T spread evenly about
// `mean` with `variance`. Without variance it is 1 - TR of Gardner 1985.
double opacity(const TextureValue& value, double threshold, double range);

}  // namespace awan::ellipsoids
