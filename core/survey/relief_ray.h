// Where rays meet the ground: hills (core/generate/relief.h), or the level plane beside them. Both are there from above
// only: a ray that begins below them leaves them first.
#pragma once

#include <glm/vec3.hpp>
#include <limits>

#include "core/generate/relief.h"

namespace awan {

// Distance along o + t d (d unit), t > 0, at which the ray first comes from above the hills to below; infinite: nowhere
// before `to`. Blocks of the relief that lie below the ray are passed at once; every step goes on to another block, so
// that it ends after some thousand at most.
double hills_ahead(const Relief& relief, const glm::dvec3& o, const glm::dvec3& d,
                   double to = std::numeric_limits<double>::infinity());

// The same of hills and of the level ground beside them.
double ground_ahead(const Relief& relief, const glm::dvec3& o, const glm::dvec3& d);

// A place on the ground, a little above it, so that a ray that begins there is not below it by rounding.
glm::dvec3 lifted(const Relief& relief, const glm::dvec3& place);

}  // namespace awan
