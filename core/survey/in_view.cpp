#include "core/survey/in_view.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"

namespace awan {
namespace {

// In units of s: the reach of a particle that can be seen.
constexpr double kReach = 4;

}  // namespace

std::size_t particles_in_view(const ParticleSet& particles, const View& view) {
    const double across = view.tan_half_fov * view.aspect, up = view.tan_half_fov;
    // Lengths of the normals (1, across) and (1, up) of the four sides.
    const double across_length = exact::hypot(1, across), up_length = exact::hypot(1, up);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 p = particles.center[i] - view.eye;
        const double reach = kReach * gaussian_s(particles, i);
        const double x = std::abs(glm::dot(p, view.right)), y = std::abs(glm::dot(p, view.up)),
                     z = glm::dot(p, view.forward);
        const bool within =
            z > -reach && x - across * z < reach * across_length && y - up * z < reach * up_length;
        seen += within ? 1 : 0;
    }
    return seen;
}

}  // namespace awan
