// Free flights through matter: delta tracking (Woodcock et al. 1965) through bricks with majorants of their own.
// Places and directions are those of the lattice (q in matter.h).
#pragma once

#include <glm/vec3.hpp>

#include "core/truth/matter.h"
#include "core/truth/path_random.h"

namespace awan::truth {

// Flights that meet more than this many points to look at end as if nothing stood there; only a walk along a steep edge
// of optical depth > 1e6 comes near it.
inline constexpr std::uint32_t kMaxTentative = 1u << 20;

struct Meeting {
    glm::dvec3 at{0};
    // To the sun from there; with detail about.
    double depth = 0;
};

// One free flight from o, in the box, along d (unit) as far as `to` cells (may be infinite). True: it met matter.
// Unbiased.
bool fly(const Matter& matter, const glm::dvec3& o, const glm::dvec3& d, double to,
         PathRandom& random, Meeting& meeting);

// The same from anywhere, t in [from, to]. t: where it was met.
bool fly_from(const Matter& matter, const glm::dvec3& o, const glm::dvec3& d, double from,
              double to, PathRandom& random, Meeting& meeting, double& t);

// Of the sunlight on its way to a meeting, what comes through: exact, or, with detail, by a flight towards the sun
// (unit): 0 or 1, right on average.
double sun_through(const Matter& matter, const Meeting& meeting, const glm::dvec3& to_sun,
                   PathRandom& random);

}  // namespace awan::truth
