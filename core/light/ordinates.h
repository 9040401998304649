// The directions of the discrete ordinates, and what turns radiance in them into moments and back.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/light/harmonics.h"

namespace awan {

inline constexpr int kOctants = 8;
inline constexpr int kDirections = 16;  // of an octant: one lane each

// Product quadrature over the sphere: 8 Gauss-Legendre levels in the cosine to the vertical, 16 even azimuths, in all
// 128 directions. It integrates harmonics up to degree 15 exactly, so those up to l = 3 are orthonormal in it.
struct Ordinates {
    // |cosines| to x, y and z: the same in every octant.
    alignas(64) std::array<std::array<float, kDirections>, 3> cosine;
    struct Octant {
        glm::ivec3 sign{1};  // of the direction's components
        alignas(64)
            std::array<std::array<float, kDirections>, kHarmonics> value;  // [harmonic][direction]
        // [direction][harmonic], times the direction's weight; weights of all sum to 4 pi.
        alignas(64) std::array<std::array<float, kHarmonics>, kDirections> weighted;
        std::array<glm::dvec3, kDirections> direction;
    };
    std::array<Octant, kOctants> octants;
};

Ordinates make_ordinates();

}  // namespace awan
