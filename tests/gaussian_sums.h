// What particles come to at a point, by their definition.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/scene/scene.h"

namespace awan::test {

inline double extinction_at(const ReadyParticles& particles, const glm::dvec3& p) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.positions.size(); ++i) {
        const double s = static_cast<double>(particles.radii[i]) / 2;
        const glm::dvec3 d = p - particles.positions[i];
        sum +=
            static_cast<double>(particles.densities[i]) * std::exp(-glm::dot(d, d) / (2 * s * s));
    }
    return sum;
}

}  // namespace awan::test
