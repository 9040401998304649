// The scene's haze as the path tracer meets it: light that it scatters once to the eye, by sampling, and what it
// dims. Its formulas of the layer are its own: the extinction along a ray is one or two exponentials in the distance,
// and their integrals are written and inverted from the ray's start.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "core/scene/scene.h"
#include "core/truth/path_random.h"
#include "core/truth/walk.h"

namespace awan::truth {

// What shines on the haze, and how it scatters. Lengths in scene units.
struct HazeSetting {
    Haze haze;
    glm::dvec3 sun{0};  // irradiance; 0 under a ground
    // Mean radiance of what comes in from everywhere.
    glm::dvec3 ambient{0};
    PhaseLaw phase;
    bool shaded = true;  // by the clouds
};
// None without haze. Means over the sky: as scenes state them (core/scene/outside.h).
std::optional<HazeSetting> haze_of(const Scene& scene, bool shaded);

// A ray through the haze, from the eye.
class HazePath {
  public:
    HazePath(const Haze& haze, double y, double slope);
    double transmittance(double t) const;  // t may be infinite
    // Distance at which the depth is reached; infinite if never.
    double where(double depth) const;
    double depth(double t) const;

  private:
    // From `from` on the extinction is b exp(-rate (t - from)); the second part has none of that.
    struct Part {
        double from = 0, extinction = 0, rate = 0, end = 0;
    };
    static double depth_in(const Part& part, double length);

    Part parts_[2];
};

// One estimate of the light that haze before distance `end` scatters to the eye: unbiased in expectation over `random`.
// o: the eye in cells of the setting's matter.
glm::dvec3 haze_light(const HazeSetting& air, const Setting& setting, const HazePath& path,
                      const glm::dvec3& o, const glm::dvec3& direction, double end,
                      PathRandom& random);

}  // namespace awan::truth
