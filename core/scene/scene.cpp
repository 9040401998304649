#include "core/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

#include "core/base/exact_math.h"
#include "core/scene/automaton.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

constexpr std::array kEffectNames = {
    "self_shadow",     "multiple_scattering",
    "view_extinction", "sky_light",
    "ground_light",    "ground_shadow",
    "sun_color",       "aerial_perspective",
    "light_shafts",    "detail",
    "interior",        "texture",
};
static_assert(kEffectNames.size() == kEffectCount);

}  // namespace

const char* effect_name(Effect effect) {
    return kEffectNames[static_cast<std::size_t>(effect)];
}

std::optional<Effect> effect_from_name(std::string_view name) {
    for (std::size_t i = 0; i < kEffectNames.size(); ++i)
        if (name == kEffectNames[i]) return static_cast<Effect>(i);
    return std::nullopt;
}

bool in_this_version(Effect effect) {
    return effect != Effect::kTexture;
}

glm::dvec3 sun_direction(const Sun& sun) {
    if (sun.direction) {
        // By the largest component first: the squares of 1e-200 would vanish.
        const glm::dvec3 d = *sun.direction;
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        return glm::normalize(d / largest);
    }
    // Exact at multiples of 90 degrees: a sun at the zenith or on an axis shines along it.
    const SinCos elevation = exact_sincos_degrees(sun.elevation);
    const SinCos azimuth = exact_sincos_degrees(sun.azimuth);
    // + 0.0: no negative zeros, which print as "-0".
    return glm::dvec3(elevation.cos * azimuth.sin, elevation.sin, elevation.cos * azimuth.cos) +
           0.0;
}

bool is_procedural(const Cloud& cloud) {
    return cloud.model != CloudModel::kCubes && cloud.model != CloudModel::kParticles;
}

std::uint64_t most_particles(const Cloud& cloud) {
    if (cloud.automaton) return most_particles(*cloud.automaton);
    if (cloud.spheres) return most_particles(*cloud.spheres);
    if (cloud.implicit) return most_particles(*cloud.implicit);
    if (cloud.ellipsoids) return most_particles(*cloud.ellipsoids);
    return 0;
}

std::uint64_t particle_count(const SceneDraft& scene) {
    // Saturates, so that a sum over a draft nobody has checked cannot wrap to a small number.
    std::uint64_t total = 0;
    const auto add = [&total](std::uint64_t n) {
        total = n > std::numeric_limits<std::uint64_t>::max() - total
                    ? std::numeric_limits<std::uint64_t>::max()
                    : total + n;
    };
    for (const Cloud& cloud : scene.clouds) {
        if (cloud.model == CloudModel::kCubes)
            for (const Cube& cube : cloud.cubes) add(cube.particles);
        else if (cloud.model == CloudModel::kParticles)
            add(cloud.ready.positions.size());
        else
            add(most_particles(cloud));
    }
    return total;
}

}  // namespace awan
