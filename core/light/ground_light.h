// Light on the ground: an infinite level Lambertian plane (Scene's `ground`), under the sun, the sky and the cloud.
// Where there are hills on it (its `terrain`), this plane of their mean albedo stands for them in what the ground
// sends up to the cloud; what is seen of the hills themselves is lit in core/light/relief_light.h.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/generate/relief.h"
#include "core/scene/outside.h"

namespace awan {

struct SunDepth;  // core/light/sun_depth.h

// Of the sun's disc as seen from the ground, radians.
inline constexpr double kSunRadius = 0.2665 * 3.14159265358979324 / 180;

// A share of the sun's light, on a raster that faces the sun: a place on the ground is looked up by its distances along
// u and v. A shadow on the ground gets long under a low sun, its image on this raster does not. Bilinear; 0 outside.
struct SunRaster {
    // At right angles to the sun: a place's products with them are its coordinates, scene units.
    glm::dvec3 u{1, 0, 0}, v{0, 0, 1};
    glm::dvec2 origin{0};  // of node (0, 0)
    double cell = 0;       // between nodes, scene units
    glm::ivec2 nodes{0};
    std::vector<float> share;  // along u fastest; EMPTY: 0 everywhere
};
double share_at(const SunRaster& raster, const glm::dvec3& point);

// What the cloud adds to the irradiance of the ground or takes from it, other than direct sunlight. Far away it falls
// off with the third power of the distance, so nodes thin out: along x and along z they lie at
//     center + reach * t / (1 - |t|),     t evenly spaced from -1 to 1.
// Bilinear in t; 0 at infinity.
struct GroundChange {
    glm::dvec2 center{0};  // x, z
    glm::dvec2 reach{1};   // scene units
    int side = 0;          // nodes
    // r g b, side * side, x fastest; EMPTY: 0 everywhere.
    std::vector<std::array<float, 3>> irradiance;
};
glm::dvec3 change_at(const GroundChange& change, double x, double z);

// All light on the ground. It does not depend on the view, as the light in the cloud does not.
struct GroundLight {
    bool present = false;     // false: there is no ground, and nothing below holds
    bool into_cloud = false;  // whether the cloud has its light
    double height = 0;
    glm::dvec3 albedo{0};
    // Irradiance far from the cloud, of the sun (exact) and of the sky (within 1e-3).
    glm::dvec3 sun{0}, sky{0};
    // Shares of `sun`, added to 1: what the cloud takes (negative; with the penumbra of the sun's disc), and what comes
    // through although it was scattered, within the forward peak (positive).
    SunRaster shadow, ahead;
    GroundChange change;

    // Null: it is level, and nothing below holds.
    std::shared_ptr<const Relief> relief;
    // The clouds' depth for sunlight, without the shadows of hills; null: no cloud. And whether they shade the hills.
    std::shared_ptr<const SunDepth> clouds;
    bool clouds_shade = false;
    // The same as `change` at greater heights (y), rising.
    struct ChangeAbove {
        double y;
        GroundChange change;
    };
    std::vector<ChangeAbove> above;

    std::size_t bytes() const;  // memory it holds beside its own size
};

// What the cloud adds at a place above the ground's own height, linear between the heights at which it is known.
glm::dvec3 change_above(const GroundLight& ground, const glm::dvec3& place);

// r g b, >= 0.
glm::dvec3 irradiance_at(const GroundLight& ground, double x, double z);
inline glm::dvec3 radiance_at(const GroundLight& ground, double x, double z) {
    return ground.albedo * irradiance_at(ground, x, z) * 0.318309886183790672;
}

// Mean radiance of the ground, as a point above it sees it in all directions below the horizontal.
glm::dvec3 mean_radiance_below(const GroundLight& ground, const glm::dvec3& point);

// Whether the ground matters to a cloud: not to one that lies below it.
bool has_ground(const SceneDraft& scene, const Bounds& cloud);

// The ground far from any cloud; `present` is false where the scene has none.
GroundLight bare_ground(const SceneDraft& scene);

// The sun's light on the ground behind a cloud. Fills
//     shadow = mean of exp(-depth) - 1 over lines towards the sun's disc,
// and, where the forward peak is split off (f = peak_share > 0, core/light/delta_m.h),
//     ahead = mean of exp(-(1 - albedo f) depth) - exp(-depth) over lines within the peak's width.
// Leaves both as they are where the sun is below kLowestShadow. With hills, it keeps `sun` for them.
// turning: as peak_turning (core/light/delta_m.h); of no account where there is no peak.
void cast_shadow(const SunDepth& sun, double albedo, double peak_share, double turning, int threads,
                 GroundLight& ground);
inline constexpr double kLowestShadow = 0.01;  // sine of the elevation

}  // namespace awan
