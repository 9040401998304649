// Interpolation between four neighbours at equal distances.
#pragma once

#include <array>

namespace awan {

// The neighbours' weights at t = 0..1 from the second to the third: Catmull & Rom 1974.
template <typename Real>
constexpr std::array<Real, 4> catmull_rom(Real t) {
    constexpr auto half = static_cast<Real>(0.5), three_halves = static_cast<Real>(1.5);
    return {t * (-half + t * (1 - half * t)), 1 + t * t * (-5 * half + three_halves * t),
            t * (half + t * (2 - three_halves * t)), t * t * (-half + half * t)};
}

}  // namespace awan
