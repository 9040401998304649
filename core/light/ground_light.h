// Light on the ground: an infinite level Lambertian plane (Scene's `ground`), under the sun, the sky and the cloud.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/scene/outside.h"

namespace awan {

struct SunDepth;  // core/light/sun_depth.h

inline constexpr double kSunRadius = 0.2665 * 3.14159265358979324 / 180;  // angular, radians

// A share of the sun's light on a raster beside the sun's rays: a place on the ground is looked up by its distances along
// u and v, so that the raster is as fine as the cloud's own however low the sun. Bilinear; 0 outside.
struct SunRaster {
    glm::dvec3 u{1, 0, 0}, v{0, 0, 1};  // unit, at right angles to the sun
    glm::dvec2 origin{0};               // of node (0, 0), along u and v, scene units
    double cell = 0;                    // scene units
    glm::ivec2 nodes{0};
    std::vector<float> share;  // along u fastest; EMPTY: 0 everywhere
};
double share_at(const SunRaster& raster, const glm::dvec3& point);

// What the cloud adds to or takes from the irradiance of the ground, sunlight's own part apart. It falls off with the third
// power of the distance: nodes lie at center + reach * t / (1 - |t|) for t evenly spaced from -1 to 1, both ways. Linear in
// t; 0 at infinity.
struct GroundChange {
    glm::dvec2 center{0};  // x, z
    glm::dvec2 reach{1};   // scene units
    int side = 0;          // nodes
    std::vector<std::array<float, 3>>
        irradiance;  // r g b, side * side, x fastest; EMPTY: 0 everywhere
};
glm::dvec3 change_at(const GroundChange& change, double x, double z);

// View-independent, as the light in the cloud is.
struct GroundLight {
    bool present = false;     // else nothing below holds
    bool into_cloud = false;  // whether the cloud has its light
    double height = 0;
    glm::dvec3 albedo{0};
    // Irradiance far from the cloud, of the sun and of the sky. Exact (the sky's within 1e-3).
    glm::dvec3 sun{0}, sky{0};
    // To the share 1 of `sun`: less what the cloud takes (the sun's disc and its penumbra), plus what goes on in about
    // the same direction, scattered within the forward peak.
    SunRaster shadow, ahead;
    GroundChange change;

    std::size_t bytes() const;  // memory it holds beside its own size
};

// r g b, >= 0.
glm::dvec3 irradiance_at(const GroundLight& ground, double x, double z);
inline glm::dvec3 radiance_at(const GroundLight& ground, double x, double z) {
    return ground.albedo * irradiance_at(ground, x, z) * 0.318309886183790672;
}

// Radiance of the ground as a point above it sees it, mean over all directions below the horizontal.
glm::dvec3 mean_radiance_below(const GroundLight& ground, const glm::dvec3& point);

// Whether the ground is there for a cloud: it is not for one that lies below it.
bool has_ground(const SceneDraft& scene, const Bounds& cloud);

// The ground far from any cloud; `present` is false where the scene has none.
GroundLight bare_ground(const SceneDraft& scene);

// The sun's light on the ground behind a cloud: fills `shadow` with exp(-depth) - 1, averaged over the sun's disc, and,
// where peak_share f > 0 (a cloud whose scattering is split so, core/light/transport.h), `ahead` with
// exp(-(1 - albedo f) depth) - exp(-depth), averaged over the peak's width. Averages take the depth along tilted lines in
// kSlabs slabs of the lattice. Not where the sun is below kLowestShadow.
void cast_shadow(const SunDepth& sun, double albedo, double peak_share, double g, int threads,
                 GroundLight& ground);
inline constexpr double kLowestShadow = 0.01;  // sine of the elevation

}  // namespace awan
