// The field function with which Upchurch 2009 makes a continuous density of cells (after Wyvill, McPheeters & Wyvill
// 1986), and the Gaussian that stands for it.
#pragma once

namespace awan::automaton {

// h(a) = -4/9 a^6 + 17/9 a^4 - 22/9 a^2 + 1, a = r/R from 0 to 1; 0 beyond.
constexpr double metaball(double a) {
    const double b = a * a;
    return a < 1 ? ((-4.0 / 9 * b + 17.0 / 9) * b - 22.0 / 9) * b + 1 : 0;
}

// The integral of h over the ball is kMetaballIntegral R^3: 4 pi (1/3 - 22/45 + 17/63 - 4/81) = 736/2835 pi. Upchurch
// 2009 divides by 748/405 pi R, which is neither: it has the dimension of a length, and at R = 1 is seven times as
// much.
inline constexpr double kMetaballIntegral = 736.0 / 2835 * 3.14159265358979323846;

// Over its mass, the mean of r^2 is 79/253 R^2 (4 pi (1/5 - 22/63 + 17/81 - 4/99) over the integral above); a
// Gaussian's is 3 s^2. So s^2 = kMetaballVariance R^2, and s = .3226 R: for R = 2 cells .645.
inline constexpr double kMetaballVariance = 79.0 / 759;

}  // namespace awan::automaton
