// Looking light up along a ray: the grid's source function towards the eye, and the sun's optical depth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/light/transport.h"

namespace awan {

using Rgb4 = float __attribute__((vector_size(16)));  // r g b and nothing

// The source function of a TransportLight as one eye sees it.
struct EyeLight {
    const TransportLight* light = nullptr;
    // Of each cell, towards the eye, radiance per optical depth. EMPTY where there is no grid, or the eye is `close`.
    // Where there is FineLight, of each of its cells.
    std::vector<Rgb4> source;
    // The eye is in the grid or near it: there is no one direction from a cell to it, so the moments are evaluated
    // along each ray.
    bool close = false;
    // One for each of light->islands; its `light` is null where the island is not lit.
    std::vector<EyeLight> islands;
};
// islands: whether each of light.islands is wanted; those that are not are left with `light` null. EMPTY: all are.
EyeLight source_towards(const TransportLight& light, const glm::dvec3& eye, int threads,
                        std::span<const std::uint8_t> islands = {});

// A ray in the lattices' own units: at distance t from `start` it is at grid + t grid_step in the light grid, and at
// sun + t sun_step in the lattice of the sun's depth.
struct LightRay {
    glm::vec3 grid{0}, grid_step{0};            // cells, 0 = centre of the first
    glm::vec3 fine{0}, fine_step{0};            // the same in FineLight, where there is one
    glm::vec3 sun{0}, sun_step{0};              // nodes of SunDepth
    std::array<float, kHarmonics> harmonics{};  // towards the eye; only where EyeLight is close
    glm::dvec3 start{0}, direction{0};          // scene units; islands have lattices of their own
};
LightRay light_ray(const EyeLight& light, const glm::dvec3& start, const glm::dvec3& direction);

// Light at one point.
struct LightAt {
    Rgb4 source;      // >= 0
    Rgb4 albedo;      // only if light.albedo is not empty
    float depth;      // from the sun, >= 0
    float air, lost;  // O and L of the haze before it (air.h); only in haze
};

// The light at distances first, first + step, ... from the ray's start, each point's that of the island in whose region
// it is.
void light_along(const EyeLight& light, const LightRay& ray, float first, float step, int count,
                 LightAt* out);

}  // namespace awan
