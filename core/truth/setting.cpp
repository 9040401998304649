// What walks need to know of a scene (walk.h).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/truth/walk.h"

namespace awan::truth {

glm::dvec3 sky_radiance(const Setting& setting, const glm::dvec3& direction) {
    const SkyDome& dome = setting.dome;
    if (!dome.shines) return glm::dvec3(0);
    if (dome.physical) return physical_radiance(dome, direction);
    const double up = std::max(direction.y, 0.0);
    const double share = 1.09 * up * up / (up * up + 0.09);
    return (1 - share) * dome.horizon + share * dome.zenith;
}

int worthwhile_from_sun(double g) {
    const double size = std::abs(g);
    return size < 0.4 ? 0 : size < 0.6 ? 2 : size < 0.8 ? 4 : size < 0.9 ? 7 : 12;
}

Setting setting_of(const Scene& scene, const Matter& matter, const TruthOptions& options) {
    Setting s;
    s.matter = &matter;
    s.phase = phase_law(scene->medium);
    s.albedo = scene->medium.albedo;
    const Outside outside = outside_of(scene);
    s.to_sun = outside.to_sun;
    s.sun_irradiance = outside.sun;
    s.dome = outside.sky;
    const glm::dvec3 aside = std::abs(s.to_sun.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    s.sun_u = glm::normalize(glm::cross(s.to_sun, aside));
    s.sun_v = glm::cross(s.to_sun, s.sun_u);
    s.sky = options.sky;
    if (scene->ground) {
        s.has_ground = true;
        s.ground_height = (scene->ground->height - matter.origin.y) / matter.cell;
        s.ground_albedo = scene->ground->albedo;
        s.relief = relief_walk_of(scene, options.threads);
    }
    s.max_orders = options.max_orders == 0 ? kMaxOrders : std::min(options.max_orders, kMaxOrders);
    // Droplets' peak is steeper than any other.
    s.from_sun = s.phase.droplets ? kMaxFromSun : worthwhile_from_sun(s.phase.g);
    return s;
}

}  // namespace awan::truth
