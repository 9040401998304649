// Pass 1, from the lights: how much of the sun's and the sky's light reaches each particle.
#pragma once

#include <glm/vec4.hpp>
#include <numbers>
#include <vector>

#include "core/base/deadline.h"
#include "core/gl/device.h"
#include "core/light/ground_light.h"
#include "core/plan/effect_times.h"
#include "core/plan/plan.h"

namespace awan {

// Fractions 0..1 of a light's full strength near one particle: value at its centre (w) and gradient
// over scene units (xyz), so that a fragment can have its own light.
struct ParticleLight {
    glm::vec4 direct;      // sun, not scattered on the way
    glm::vec4 scattered;   // sun, scattered forward on the way (arrives from about the sun, leaves
                           // in all directions)
    glm::vec4 from_above;  // upper half of the sky
    glm::vec4 from_below;  // lower half
};

// View-independent: it may be kept while the camera moves.
struct Lighting {
    // One a particle; EMPTY when no light is shadowed: then direct, from_above and from_below are
    // 1, scattered 0.
    std::vector<ParticleLight> particles;
    GroundLight ground;  // of a scene that has one, its `shadow` only, as the plan's effects say
    EffectTimes took;    // of the passes
};

// Half angles within which forward-scattered light counts as going on, radians. The sources leave them open: the sun's is
// chosen by eye between 45 and 90 degrees, the sky's is the hemisphere it shines from.
inline constexpr double kSunGathering = std::numbers::pi / 3;
inline constexpr double kSkyGathering = std::numbers::pi / 2;

// The classic recurrence (document 000, eq. 3.12; Harris 2001) from the sun and from the zenith, by
// the compute passes light_columns, light_sums and light_samples. Skipped when the plan has no self_shadow.
//
// Forward gain: the part of a particle's scattered light that travels on with the light, albedo
// times the phase function's true fraction (gathering_fraction) within kSunGathering of the beam
// or, since the sky's light comes from a whole hemisphere, kSkyGathering. Sunlight gained so has
// been scattered; it is kept apart from the direct beam, because it no longer has the beam's
// direction. Errors: kOverDeadline, kCancelled, kInternal.
Result<Lighting> light(const Scene& scene, const ParticleSet& particles, const Plan& plan,
                       Device& device, const Deadline& deadline);

// Fraction of scattered light within `half_angle` (radians, 0..pi) of straight on. Error < 1e-4.
// |g| <= .999.
double gathering_fraction(const Medium& medium, double half_angle);

}  // namespace awan
