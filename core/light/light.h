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

// So many particles cover each other's edges: passes take less care of each.
inline constexpr std::size_t kManySplats = 4096;

// Fractions 0..1 of a light's full strength near one particle: the value at its centre (w) and its gradient per scene
// unit (x y z), so that every fragment of the particle can have its own light.
struct ParticleLight {
    glm::vec4 direct;  // of the sun, not scattered on the way
    // Of the sun, scattered forward on the way: it arrives from about the sun, and is scattered on in all directions.
    glm::vec4 scattered;
    // Of the sun, scattered out of that way, and about within the cloud since: from all sides. In bright matter there
    // is more of it than of what arrives, up to four times.
    glm::vec4 diffuse{0};
    // Upper half of the sky; what the matter behind sends back makes it twice as much at most.
    glm::vec4 from_above;
    glm::vec4 from_below;  // lower half
};

// It does not depend on the view: it may be kept while the camera moves.
struct Lighting {
    // One a particle. EMPTY where nothing shadows light: then direct, from_above and from_below are 1, scattered is 0.
    std::vector<ParticleLight> particles;
    GroundLight ground;  // of a scene that has one; of what the cloud does to it only the shadow
    EffectTimes took;    // of the passes
};

// Of the light that is scattered about in a layer, the share that a cloud of about the same width all round keeps.
inline constexpr double kKeptBetweenSides = 0.5;

// Half angles, radians, within which light that is scattered forward counts as going on. The papers leave them open.
// The sun's is chosen by eye between 45 and 90 degrees; the sky's is the hemisphere that it shines from.
inline constexpr double kSunGathering = std::numbers::pi / 3;
inline constexpr double kSkyGathering = std::numbers::pi / 2;

// The light that reaches each particle past those before it, from the sun and from the zenith. The recurrence is
// Harris's (2001; Rekawan's eq. 3.12): with T_k the transmittance of particle k and g_k the light that it scatters
// forward,
//     I_1 = I_0,     I_k = g_(k-1) + T_(k-1) I_(k-1).
// It is evaluated on a grid by the compute passes light_columns, light_sums and light_samples; not at all where the
// plan has no self_shadow.
//
// As printed, the gain g can make light grow. Here the light that a particle scatters goes on by the albedo times the
// phase function's true fraction (gathering_fraction) within kSunGathering of the beam; of the sky's light, which comes
// from a whole hemisphere, within kSkyGathering. Sunlight that was gained so is kept apart from the direct beam,
// because it no longer has the beam's direction.
//
// The papers stop there: what leaves the cone is lost, and the far sides of deep clouds are black. Here it goes on as
// light does that is scattered about in a layer (diffusion, by Eddington's closure), for which each column is taken.
// Where t is the depth that turns light, (1 - a g) tau, up to the particle, and w that of the whole column, the fluence
// in a layer under a beam from above is
//     F = 5 - 2 C - 3 C t - 2 e^-t,     C = (5 - e^-w) / (4 + 3 w)
// where nothing is absorbed, and `diffuse` is what of it I does not hold, times kKeptBetweenSides, since a cloud loses
// light through its sides: less where it is wide, more where it is long. Of the sky's light, which comes from a whole
// hemisphere, with x = w - t,
//     from_above = 2 (2 + 3 x) / (4 + 3 w),     from_below = 2 (2 + 3 t) / (4 + 3 w):
// in a furnace, where both are as bright, a white cloud cannot be seen. Without effect multiple_scattering all that
// scatters is lost. light_samples.glsl says what absorption does.
// Errors: kOverDeadline, kCancelled, kInternal.
Result<Lighting> light(const Scene& scene, const ParticleSet& particles, const Plan& plan,
                       Device& device, const Deadline& deadline);

// Fraction of scattered light within `half_angle` (radians, 0..pi) of straight on. Error < 1e-4.
// |g| <= .999.
double gathering_fraction(const Medium& medium, double half_angle);

}  // namespace awan
