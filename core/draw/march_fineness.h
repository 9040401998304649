// How finely the march steps and looks light up, along a ray: as the light is fine there.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/light/transport.h"

namespace awan {

// Longest step where nothing is deep, scene units: about a cell of the light, or a few to the smallest lattice of the sun's depth.
// mean_s, least_s: of the particles.
double longest_step(const TransportLight& light, double mean_s, double least_s);

// Most distance between rays along which light is looked up, scene units.
double most_apart(const TransportLight& light);

// The ball around an island, in the eye's frame.
struct SeenIsland {
    glm::dvec3 center{0};
    double radius = 0;
    double apart = 0, step = 0;
};

// From `from` to `to` (distances from the eye) neither may be more.
struct FineInterval {
    double from, to, apart, step;
};

struct Allowed {
    double apart, step;
};

// The intervals of the islands that a cone meets: unit axis from the eye, `slope` of its sides. Where there is none: `otherwise`.
void fineness_in_cone(const std::vector<SeenIsland>& islands, const glm::dvec3& axis, double slope,
                      const Allowed& otherwise, std::vector<FineInterval>& intervals);

struct Fineness {
    double apart, step;
    double until;  // where it may change, > the distance asked for
};
Fineness fineness_at(const std::vector<FineInterval>& intervals, double distance);

double finest_step(const std::vector<FineInterval>& intervals);

}  // namespace awan
