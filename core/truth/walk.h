// Random walks of light through matter, from the eye backwards.
#pragma once

#include <cstdint>
#include <limits>

#include "core/scene/outside.h"
#include "core/truth/flight.h"
#include "core/truth/matter.h"
#include "core/truth/path_random.h"
#include "core/truth/path_tracer.h"
#include "core/truth/phase_law.h"

namespace awan::truth {

// Everything that a walk needs to know of a scene. Positions in cells, scene axes (p in matter.h).
struct Setting {
    const Matter* matter = nullptr;
    PhaseLaw phase;
    double albedo = 1;
    glm::dvec3 to_sun{0, 1, 0};
    glm::dvec3 sun_u{1, 0, 0}, sun_v{0, 0, 1};  // unit, at right angles to it
    glm::dvec3 sun_irradiance{0};
    SkyDome dome;
    SkySampling sky = SkySampling::kEscape;
    bool has_ground = false;
    double ground_height = 0;  // cells
    glm::dvec3 ground_albedo{0};
    std::uint32_t max_orders = kMaxOrders;  // 1..kMaxOrders
    // Directions drawn from the sun's side, at most (walk.cpp); 0..kMaxFromSun. Changes the noise only.
    int from_sun = 0;
};
inline constexpr int kMaxFromSun = 12;

// Fills all but `matter`'s own; cells and axes are the matter's.
Setting setting_of(const Scene& scene, const Matter& matter, const TruthOptions& options);

// How many directions from the sun's side are worth their time.
int worthwhile_from_sun(double g);

// What became of a path, for laws that tests hold it to. Weights, mean over r g b.
struct Tally {
    double scatterings = 0;
    // Cut off: by max_orders or kMaxTentative.
    double absorbed = 0, escaped = 0, cut_off = 0;
};

// The sky's radiance from a direction (unit). A gradient, by a second opinion on core/shaders/sky.glsl: zenith and
// horizon mixed by 1.09 u^2 / (u^2 + .09), u the sine of its elevation; the horizon's colour below it.
glm::dvec3 sky_radiance(const Setting& setting, const glm::dvec3& direction);

struct Flight {
    bool collided = false;
    double t = 0;  // cells from o, when it did
};
// One free flight along o + t d, t in (from, to); d unit. Unbiased. `to` may be infinite.
Flight free_flight(const Matter& matter, const glm::dvec3& o, const glm::dvec3& d, double from,
                   double to, PathRandom& random);

// t of the ground ahead, infinite when there is none: it is there from above only.
inline double ground_ahead(const Setting& setting, const glm::dvec3& o, const glm::dvec3& d) {
    if (!setting.has_ground || !(d.y < 0) || o.y <= setting.ground_height)
        return std::numeric_limits<double>::infinity();
    return (setting.ground_height - o.y) / d.y;
}

// Radiance that a path brings back which meets matter at p, coming along d (the way the path goes, away
// from the eye).
glm::dvec3 walk_from_matter(const Setting& setting, const glm::dvec3& p, const glm::dvec3& d,
                            PathRandom& random, Tally& tally);

// The same for a path that meets the ground at p.
glm::dvec3 walk_from_ground(const Setting& setting, const glm::dvec3& p, PathRandom& random,
                            Tally& tally);

}  // namespace awan::truth
