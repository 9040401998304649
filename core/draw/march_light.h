// Looking light up along a ray: the grid's source function towards the eye, and the sun's optical depth.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/light/transport.h"

namespace awan {

using Rgb4 = float __attribute__((vector_size(16)));  // r g b and nothing

// The source function of a TransportLight as one eye sees it.
struct EyeLight {
    const TransportLight* light = nullptr;
    std::vector<Rgb4>
        source;  // of each cell, towards the eye, radiance per optical depth; empty: see `close`
    // The eye is in the grid or near it: a cell has no one direction to it, and the moments are evaluated along each ray.
    bool close = false;
    std::vector<EyeLight> islands;  // one for each of light->islands; `light` null: not lit
};
EyeLight source_towards(const TransportLight& light, const glm::dvec3& eye, int threads);

// A ray in the lattices' own units: at distance t from `start` it is at grid + t grid_step.
struct LightRay {
    glm::vec3 grid{0}, grid_step{0};            // cells, 0 = centre of the first
    glm::vec3 sun{0}, sun_step{0};              // nodes of SunDepth
    std::array<float, kHarmonics> harmonics{};  // of the way from matter to the eye; for `close`
    glm::dvec3 start{0}, direction{0};          // scene units; for islands
};
LightRay light_ray(const EyeLight& light, const glm::dvec3& start, const glm::dvec3& direction);

// Light at one point.
struct LightAt {
    Rgb4 source;      // >= 0
    Rgb4 albedo;      // only if light.albedo is not empty
    float depth;      // from the sun, >= 0
    float air, lost;  // of the haze before it (march_air.h); only in haze
};

// Each point has the light of the island in whose region it is. At distances first, first + step, ... from the ray's start.
void light_along(const EyeLight& light, const LightRay& ray, float first, float step, int count,
                 LightAt* out);

}  // namespace awan
