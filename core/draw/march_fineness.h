// How finely the march steps and looks up light along a ray: as finely as the light is resolved there.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/light/transport.h"

namespace awan {

// The longest step, scene units, where optical depth does not ask for shorter ones: about a cell of the light grid;
// without a grid a thirty-second of the sun lattice's longest side; without that, too, least_s. mean_s, least_s: mean
// and least standard deviation of the particles.
double longest_step(const TransportLight& light, double mean_s, double least_s);

// The widest gap between rays along which light is looked up, scene units.
double most_apart(const TransportLight& light);

// The ball around an island, in the eye's frame, and the widest gap and the longest step in it.
struct SeenIsland {
    glm::dvec3 center{0};
    double radius = 0;
    double apart = 0, step = 0;
};

// Between two distances from the eye, the widest gap and the longest step.
struct FineInterval {
    double from, to, apart, step;
};

struct Allowed {
    double apart, step;
};

// The intervals of the islands that a cone from the eye meets, and one of `otherwise` that is everywhere. axis: unit;
// slope: of the cone's sides. Where intervals overlap, the finest counts.
void fineness_in_cone(const std::vector<SeenIsland>& islands, const glm::dvec3& axis, double slope,
                      const Allowed& otherwise, std::vector<FineInterval>& intervals);

struct Fineness {
    double apart, step;
    double until;  // up to where this holds, > the distance asked for
};
Fineness fineness_at(const std::vector<FineInterval>& intervals, double distance);

double finest_step(const std::vector<FineInterval>& intervals);

}  // namespace awan
