#include "core/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string_view>

namespace awan {
namespace {

constexpr std::array<const char*, kEffectCount> kEffectNames = {
    "self_shadow",     "multiple_scattering",
    "view_extinction", "sky_light",
    "ground_light",    "ground_shadow",
    "sun_color",       "aerial_perspective",
    "light_shafts",    "detail",
    "interior",        "texture",
};

struct SineCosine {
    double sine, cosine;
};

// Exact at multiples of 90 degrees, where sin(pi) would leave 1.2e-16: a sun at the zenith or on an
// axis shines along it exactly, and azimuth 360 is azimuth 0.
SineCosine sine_cosine_degrees(double degrees) {
    const double quarter = std::nearbyint(degrees / 90.0);
    const double rest = (degrees - quarter * 90.0) * (std::numbers::pi / 180.0);
    const double s = std::sin(rest);
    const double c = std::cos(rest);
    switch (static_cast<int>(std::fmod(quarter, 4.0) + 4.0) % 4) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace

const char* effect_name(Effect effect) {
    return kEffectNames[static_cast<std::size_t>(effect)];
}

std::optional<Effect> effect_from_name(std::string_view name) {
    for (std::size_t i = 0; i < kEffectNames.size(); ++i)
        if (name == kEffectNames[i]) return static_cast<Effect>(i);
    return std::nullopt;
}

glm::dvec3 sun_direction(const Sun& sun) {
    if (sun.direction) {
        // By the largest component first: the squares of 1e-200 would vanish.
        const glm::dvec3 d = *sun.direction;
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        return glm::normalize(d / largest);
    }
    const SineCosine elevation = sine_cosine_degrees(sun.elevation);
    const SineCosine azimuth = sine_cosine_degrees(sun.azimuth);
    // + 0.0: no negative zeros, which print as "-0".
    return glm::dvec3(elevation.cosine * azimuth.sine, elevation.sine,
                      elevation.cosine * azimuth.cosine) +
           0.0;
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
        else
            add(cloud.ready.positions.size());
    }
    return total;
}

}  // namespace awan
