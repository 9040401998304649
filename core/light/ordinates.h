// Directions of the discrete ordinates and what turns directions into moments and back.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/light/harmonics.h"

namespace awan {

inline constexpr int kOctants = 8;
inline constexpr int kDirections = 16;  // of an octant: one lane each

// Product quadrature: Gauss-Legendre in the cosine to the vertical (8 levels), 16 equal azimuths.
// Integrates harmonics up to degree 15 exactly, so moments up to l = 3 are orthonormal.
struct Ordinates {
    // |cosines| to x, y and z: the same in every octant.
    alignas(64) std::array<std::array<float, kDirections>, 3> cosine;
    struct Octant {
        glm::ivec3 sign{1};  // of the direction's components
        alignas(64) std::array<std::array<float, kDirections>, 16> value;  // [harmonic][direction]
        // [direction][harmonic], times the direction's weight; weights of all sum to 4 pi.
        alignas(64) std::array<std::array<float, 16>, kDirections> weighted;
        std::array<glm::dvec3, kDirections> direction;
    };
    std::array<Octant, kOctants> octants;
};

Ordinates make_ordinates();

}  // namespace awan
