// How light turns at a scattering: values and exact samples of the phase functions, in double.
// Stated here again, apart from core/shaders/phase.glsl, so that an error there is seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>

#include "core/scene/scene.h"
#include "core/truth/droplet_law.h"
#include "core/truth/path_random.h"

namespace awan::truth {

struct PhaseLaw {
    double g = 0;  // -1 < g < 1
    bool cornette_shanks = false;
    // Of droplets, then `g` is not of account; else null.
    std::shared_ptr<const DropletLaw> droplets{};
};

inline PhaseLaw phase_law(const Medium& medium) {
    if (medium.droplets) return {0, false, std::make_shared<const DropletLaw>(*medium.droplets)};
    return {medium.g, medium.phase == PhaseFunction::kCornetteShanks, nullptr};
}

// Mean 1 over the sphere; cosine of the angle between the ways light goes before and after.
// Henyey & Greenstein 1941: (1 - g^2) / (1 + g^2 - 2 g cos)^(3/2), its base written as
// (1 - |g|)^2 + 2 |g| (1 -+ cos), which loses no digits at the peak. Cornette & Shanks 1992: times
// 3 (1 + cos^2) / (2 (2 + g^2)).
inline double phase_value(const PhaseLaw& law, double cosine) {
    if (law.droplets) return value(*law.droplets, 1 - std::abs(cosine), cosine < 0);
    const double size = std::abs(law.g);
    if (size == 0 && !law.cornette_shanks) return 1;
    const double apart = std::max(1 - (law.g >= 0 ? cosine : -cosine), 0.0);
    const double base = (1 - size) * (1 - size) + 2 * size * apart;
    const double hg = (1 - size) * (1 + size) / (base * std::sqrt(base));
    return law.cornette_shanks ? 1.5 * (1 + cosine * cosine) / (2 + law.g * law.g) * hg : hg;
}

// A cosine with Henyey & Greenstein's density, u uniform in (0, 1): their cumulative distribution
// inverted. Below |g| = 1e-6, where the inverse divides rounding by g, its first order in g, exact to g^2.
inline double henyey_greenstein_cosine(double g, double u) {
    const double v = 2 * u - 1;
    if (std::abs(g) < 1e-6) return std::clamp(v + 1.5 * g * (1 - v * v), -1.0, 1.0);
    const double q = (1 - g * g) / (1 + g * v);
    return std::clamp((1 + g * g - q * q) / (2 * g), -1.0, 1.0);
}

// A cosine with the density of droplets: an interval by its light, and within it a place where p rises evenly.
inline double droplet_cosine(const DropletLaw& law, PathRandom& random) {
    const std::size_t count = law.keep.size();
    std::size_t i =
        std::min(static_cast<std::size_t>(random.unit() * static_cast<double>(count)), count - 1);
    if (random.unit() > static_cast<double>(law.keep[i])) i = law.other[i];
    const auto low = static_cast<double>(law.p_from[i]);
    const double high = low + static_cast<double>(law.p_rise[i]), u = random.unit();
    const double part =
        u * (low + high) / (low + std::sqrt(low * low + u * (high * high - low * low)));
    const double w =
        static_cast<double>(law.from[i]) + std::min(part, 1.0) * static_cast<double>(law.width[i]);
    return i < law.half ? 1 - w : w - 1;
}

// `direction` (unit) turned by the angle of `cosine`, towards the azimuth (cos, sin).
// Basis: Duff et al. 2017, "Building an orthonormal basis, revisited".
inline glm::dvec3 turned(const glm::dvec3& direction, double cosine, double cos_azimuth,
                         double sin_azimuth) {
    const double sign = std::copysign(1.0, direction.z);
    const double a = -1 / (sign + direction.z);
    const double b = direction.x * direction.y * a;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    const double x = sine * cos_azimuth, y = sine * sin_azimuth;
    return {x * (1 + sign * direction.x * direction.x * a) + y * b + cosine * direction.x,
            x * sign * b + y * (sign + direction.y * direction.y * a) + cosine * direction.y,
            -x * sign * direction.x - y * direction.y + cosine * direction.z};
}

// Where light that came along `direction` goes on. A point in the unit disc gives both the azimuth and,
// by its squared radius, which is uniform, the cosine (Marsaglia 1972).
inline glm::dvec3 scattered(const PhaseLaw& law, const glm::dvec3& direction, PathRandom& random) {
    // A draw fails with probability .22 (disc) and at most .5 (Cornette-Shanks): 128 never all do.
    for (int draw = 0; draw < 128; ++draw) {
        const PathRandom::Pair p = random.signed_pair();
        const double r2 = p.a * p.a + p.b * p.b;
        if (r2 >= 1) continue;
        if (law.g == 0 && !law.cornette_shanks && !law.droplets) {
            // Even over the sphere, by the same point of the disc.
            const double aside = 2 * std::sqrt(1 - r2);
            return {aside * p.a, aside * p.b, 1 - 2 * r2};
        }
        const double cosine = law.droplets ? droplet_cosine(*law.droplets, random)
                                           : henyey_greenstein_cosine(law.g, r2);
        if (law.cornette_shanks && 2 * random.unit() > 1 + cosine * cosine) continue;
        const double per_r = 1 / std::sqrt(r2);
        return turned(direction, cosine, p.a * per_r, p.b * per_r);
    }
    return direction;
}

}  // namespace awan::truth
