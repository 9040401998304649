#include "core/draw/particle_light.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/draw/march_light.h"
#include "core/draw/march_phase.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// Particles that a thread takes at a time.
constexpr std::size_t kBlock = 1024;

glm::vec3 rgb(const Rgb4& c) {
    return {c[0], c[1], c[2]};
}

}  // namespace

// With S the grid's source function, which leaves out what the forward peak scatters, f the peak's share, a the albedo,
// k = 1 - a f, E the sun's irradiance, p the whole phase function over 4 pi and t the optical depth towards the sun:
//     S / (1 - f) + a E p exp(-k t).
// The first term takes the peak's light to go straight on, as light_volume() does, so that matter which absorbs nothing
// under an even sky is as bright as the sky; the second is exact where matter is thin.
std::vector<glm::vec3> particle_light(const Scene& scene, const ParticleSet& particles,
                                      const TransportLight& light, const glm::dvec3& eye,
                                      int threads) {
    std::vector<glm::vec3> to(particles.size());
    const Outside outside = outside_of(scene);
    const EyeLight towards = source_towards(light, eye, threads);
    const auto even = static_cast<float>(1 / (1 - light.peak_share));
    const auto scaled = static_cast<float>(1 - scene->medium.albedo * light.peak_share);
    const glm::vec3 sun(outside.sun);
    const glm::vec3 usual(static_cast<float>(scene->medium.albedo));
    parallel_for(threads, (to.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
        const std::size_t last = std::min(to.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < last; ++i) {
            const glm::dvec3 away = particles.center[i] - eye;
            const double distance = glm::length(away);
            const glm::dvec3 ahead = distance > 0 ? away / distance : glm::dvec3(0, 0, -1);
            const LightRay ray = light_ray(towards, particles.center[i], ahead);
            LightAt at{};
            light_along(towards, ray, 0, 0, 1, &at);
            const auto phase = static_cast<float>(
                phase_of_chords(scene->medium, glm::length(ahead - outside.to_sun),
                                glm::length(ahead + outside.to_sun)));
            const glm::vec3 albedo = light.albedo.empty() ? usual : rgb(at.albedo);
            const glm::vec3 sum =
                even * rgb(at.source) + albedo * sun * (phase * exact::exp(-scaled * at.depth));
            to[i] = glm::max(sum, glm::vec3(0));
        }
    });
    return to;
}

}  // namespace awan
