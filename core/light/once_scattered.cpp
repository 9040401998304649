#include "core/light/once_scattered.h"

#include <algorithm>

#include "core/light/transport_part.h"

namespace awan {
namespace {

TransportLight of_one(const TransportLight& light) {
    TransportLight once;
    // Without colours there is nothing on the grid.
    if (!light.albedo.empty()) {
        once.origin = light.origin;
        once.cell = light.cell;
        once.cells = light.cells;
        once.albedo = light.albedo;
    }
    once.sun = light.sun;
    once.ground = light.ground;
    once.sky = false;
    return once;
}

}  // namespace

TransportLight sun_once(const TransportLight& light) {
    TransportLight once = of_one(light);
    once.regions = light.regions;
    for (const LightIsland& island : light.islands)
        once.islands.push_back(
            {island.lit, of_one(island.light), island.low, island.high, island.mean_s});
    return once;
}

Result<TransportLight> sky_once(const Scene& scene, const ParticleSet& particles,
                                const Survey& survey, TransportSettings settings, int threads,
                                const Deadline& deadline) {
    if (particles.size() == 0 || !(survey.total_mass > 0) || settings.cells == 0 || !settings.sky)
        return TransportLight{};
    settings.sky_once = true;
    settings.last = true;
    settings.ground = settings.ground_shadow = false;
    settings.islands = {};
    const double deepest = std::max(survey.optical_depth_sun, survey.optical_depth_zenith);
    return light_of_part(scene, {particles, particles, SunDepth{}, deepest, {}, nullptr}, settings,
                         nullptr, threads, deadline);
}

}  // namespace awan
