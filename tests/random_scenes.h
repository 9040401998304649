// Random valid scenes: every field over its whole range (core/scene/limits.h), log-uniform where the range spans
// magnitudes, and its ends more often than chance would have them. Small pictures and few particles, so that thousands
// of them take minutes. A seed is a scene, by the generator below alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <numbers>
#include <string>

#include "core/scene/limits.h"
#include "core/scene/scene.h"
#include "tests/scenes.h"

namespace awan::test {

// SplitMix64 (Steele, Lea & Flood 2014); the standard's distributions differ between libraries.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}

    double uniform() {  // 0 <= x < 1
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high) {
        return std::clamp(std::exp(between(std::log(low), std::log(high))), low, high);
    }
    bool chance(double share) { return uniform() < share; }
    int below(int count) { return static_cast<int>(uniform() * count); }
    double either(std::initializer_list<double> values) {
        return values.begin()[below(static_cast<int>(values.size()))];
    }
    double sign() { return chance(0.5) ? 1 : -1; }
    // Of any size up to `most`, of any sign.
    double any(double most) { return chance(0.1) ? 0 : sign() * log_between(most * 1e-12, most); }
    glm::dvec3 any_vector(double most) {
        const double x = any(most), y = any(most), z = any(most);
        return {x, y, z};
    }
    glm::dvec3 on_sphere() {
        const double z = between(-1, 1), turn = between(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(turn), z, r * std::sin(turn)};
    }
    glm::dvec3 color(double most) {
        const auto one = [&] { return chance(0.1) ? 0 : log_between(1e-4, most); };
        const double r = one(), g = one(), b = one();
        return chance(0.3) ? glm::dvec3(r) : glm::dvec3(r, g, b);
    }

  private:
    std::uint64_t state_;
};

// Where a scene happens: everything else is placed and sized after it, so that the picture shows something.
struct Whereabouts {
    glm::dvec3 middle{0};
    double size = 1;
};

inline Cloud random_cloud(Dice& dice, const Whereabouts& where, double& density) {
    Cloud cloud;
    cloud.scale = dice.chance(0.7) ? 1 : dice.log_between(0.1, 10);
    cloud.translate = where.middle;
    cloud.rotate_y = dice.chance(0.5) ? 0 : dice.any(limits::kMaxAngle);
    // Deep or thin by its own size: the optical depth is drawn, the density follows.
    const double radius = std::clamp(
        where.size * (dice.chance(0.1) ? dice.log_between(1e-6, 10) : dice.log_between(0.05, 1)),
        limits::kMinRadius * 20, limits::kMaxRadius / 20);
    const double depth = dice.chance(0.1) ? 0 : dice.log_between(1e-12, 1e12);
    density = std::min(depth / radius, limits::kMaxDensity / 2);
    cloud.density = dice.chance(0.05) ? dice.log_between(1e-12, limits::kMaxDensity / 2) : density;
    const int count = dice.chance(0.05)  ? 0
                      : dice.chance(0.3) ? 1
                                         : static_cast<int>(dice.log_between(1, 400));
    const bool flat = dice.chance(0.2);
    if (dice.chance(0.3)) {
        cloud.fill = static_cast<Fill>(dice.below(3));
        for (int k = 0; k < 1 + dice.below(3); ++k) {
            Cube cube;
            cube.particles = static_cast<std::uint64_t>(count);
            for (int axis = 0; axis < 3; ++axis) {
                cube.size[axis] = std::clamp(where.size * dice.log_between(0.1, 2),
                                             limits::kMinLength, limits::kMaxLength);
                cube.center[axis] = where.size * dice.between(-1, 1);
            }
            if (flat) cube.size[dice.below(3)] = std::max(1e-6 * where.size, limits::kMinLength);
            cube.radius = radius;
            cube.density = dice.chance(0.7) ? 1 : dice.log_between(1e-6, 1);
            cloud.cubes.push_back(cube);
        }
        return cloud;
    }
    cloud.model = CloudModel::kParticles;
    const bool colored = dice.chance(0.25), dense = dice.chance(0.5), together = dice.chance(0.1);
    const bool mixed = dice.chance(0.2);
    for (int i = 0; i < count; ++i) {
        glm::dvec3 at(0);
        if (!together)
            for (int axis = 0; axis < 3; ++axis) at[axis] = where.size * dice.between(-1, 1);
        if (flat) at.y *= 1e-6;
        cloud.ready.positions.push_back(at);
        const double own = mixed ? radius * dice.log_between(1e-3, 10) : radius;
        cloud.ready.radii.push_back(
            static_cast<float>(std::clamp(own, limits::kMinRadius * 20, limits::kMaxRadius / 20)));
        if (dense) cloud.ready.densities.push_back(static_cast<float>(dice.log_between(1e-6, 1)));
        if (colored) {
            const double r = dice.uniform(), g = dice.uniform(), b = dice.uniform();
            cloud.ready.colors.emplace_back(dice.chance(0.2) ? glm::dvec3(0) : glm::dvec3(r, g, b));
        }
    }
    return cloud;
}

inline const char* random_rung(Dice& dice) {
    struct Share {
        const char* rung;
        double share;
    };
    static constexpr Share kShares[] = {
        {"additive", .19},      {"harris", .3},         {"single", .3},
        {"transport-16", .15},  {"transport-24", .015}, {"transport-32", .004},
        {"transport-48", .002}, {"transport-64", .001}, {"truth", 1}};
    double left = dice.uniform();
    for (const Share& share : kShares)
        if ((left -= share.share) < 0) return share.rung;
    return "truth";
}

inline void random_picture(Dice& dice, ImageSettings& image, bool paths) {
    const double most = paths ? 32 : 400;
    image.width = static_cast<int>(dice.log_between(1, most));
    image.height = std::max(1, static_cast<int>(dice.log_between(1, most / image.width)));
    if (dice.chance(0.5)) std::swap(image.width, image.height);
    if (dice.chance(0.01)) image.width = limits::kMaxImageSide, image.height = 1;
    image.background = dice.chance(0.5) ? Background::kSky : Background::kTransparent;
}

inline void random_camera(Dice& dice, const Whereabouts& where, const SceneDraft& draft,
                          Camera& camera) {
    camera.automatic = dice.chance(0.15);
    camera.target = where.middle;
    const double distance = where.size * (dice.chance(0.1)   ? dice.log_between(1e-6, 1e4)
                                          : dice.chance(0.3) ? dice.log_between(0.01, 1)
                                                             : dice.log_between(1, 10));
    glm::dvec3 towards = dice.on_sphere();
    if (dice.chance(0.15))
        towards = dice.sign() * sun_direction(draft.sun);  // with or into the sun
    if (dice.chance(0.05)) towards = {0, dice.sign(), 0};
    camera.eye = where.middle + distance * towards;
    if (dice.chance(0.1) && !draft.clouds.empty() && !draft.clouds[0].ready.positions.empty() &&
        draft.clouds[0].scale == 1 && draft.clouds[0].rotate_y == 0)
        camera.eye = draft.clouds[0].translate + draft.clouds[0].ready.positions[0];
    const double most = limits::kMaxCoordinate;
    for (int axis = 0; axis < 3; ++axis)
        camera.eye[axis] = std::clamp(camera.eye[axis], -most, most);
    if (camera.eye == camera.target)
        camera.target.x += camera.target.x > 0 ? -where.size : where.size;
    const glm::dvec3 up = dice.on_sphere();
    camera.up = dice.chance(0.5) ? glm::dvec3(0, 1, 0) : up * dice.log_between(1e-3, 1e3);
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < 1e-5)
        camera.up = std::abs(view.x) > std::abs(view.y) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    camera.fov = dice.chance(0.1) ? dice.either({limits::kMinFov, limits::kMaxFov})
                                  : dice.log_between(limits::kMinFov * 100, limits::kMaxFov);
}

// A furnace has no sun and a sky of radiance 1 all round: nothing in it may be brighter than 1.
struct RandomScene {
    SceneDraft draft = test::plain_draft();
    bool furnace = false;
};

// Daylight, ground, haze and detail; last, so that the rest of a seed's scene is what it was without them. A furnace
// has a sky of its own, and no ground or haze, which need not be white.
inline void random_surroundings(Dice& dice, const Whereabouts& where, RandomScene& random) {
    SceneDraft& draft = random.draft;
    if (dice.chance(0.2))
        draft.detail = {dice.chance(0.2) ? 1 : dice.uniform(),
                        dice.log_between(limits::kMinDetailSize, limits::kMaxDetailSize)};
    for (const Effect effect : {Effect::kGroundLight, Effect::kGroundShadow, Effect::kSunColor,
                                Effect::kAerialPerspective, Effect::kLightShafts, Effect::kDetail})
        if (dice.chance(0.1))
            draft.effects[static_cast<int>(effect)] = dice.chance(0.5) ? Switch::kOff : Switch::kOn;
    if (random.furnace) return;
    draft.sun.auto_color = dice.chance(0.25);
    if (!draft.sky.none && dice.chance(0.25)) {
        draft.sky.physical = true;
        draft.sky.intensity =
            dice.chance(0.5) ? kPhysicalSkyIntensity : dice.log_between(1e-3, 1e3);
    }
    draft.sky.turbidity = dice.chance(0.2) ? dice.either({2, 10}) : dice.between(2, 10);
    if (!draft.ground && dice.chance(0.15))
        draft.ground = {where.middle.y - where.size * dice.between(-0.5, 3),
                        dice.chance(0.3)
                            ? glm::dvec3(dice.either({0, 1}))
                            : glm::dvec3(dice.uniform(), dice.uniform(), dice.uniform())};
    if (dice.chance(0.15)) {
        Haze& haze = draft.haze.emplace();
        // Thin and thick on the way to the clouds, low and high.
        haze.extinction = std::min(dice.log_between(1e-3, 1e2) / where.size, limits::kMaxDensity);
        haze.scale_height = where.size * dice.log_between(1e-2, 1e2);
        haze.height = where.middle.y + where.size * dice.between(-3, 1);
        haze.albedo = glm::dvec3(dice.chance(0.3) ? 1 : dice.uniform());
        haze.g = dice.between(-limits::kMaxAnisotropy, limits::kMaxAnisotropy);
    }
}

// Apart, so that there may be islands (core/survey/islands.h): particles and cubes go to some of 27 places, near or
// far. Last of all; what was made for one place (camera, ground, haze) stays there.
inline void scatter(Dice& dice, const Whereabouts& where, SceneDraft& draft) {
    const double apart =
        where.size * (dice.chance(0.2) ? dice.log_between(1, 1e4) : dice.between(2, 12));
    const bool level = dice.chance(0.5);
    const int places = 2 + dice.below(26);
    const auto place = [&] {
        const int i = dice.below(places) * 5 % 27;
        return apart * glm::dvec3(i % 3 - 1, level ? 0 : i / 9 - 1, i / 3 % 3 - 1);
    };
    for (Cloud& cloud : draft.clouds) {
        for (glm::dvec3& at : cloud.ready.positions) at += place();
        for (Cube& cube : cloud.cubes) cube.center += place();
        const double most = 0.005 * limits::kMaxCoordinate;  // before scale, beside `middle`
        for (glm::dvec3& at : cloud.ready.positions) at = glm::clamp(at, -most, most);
        for (Cube& cube : cloud.cubes) cube.center = glm::clamp(cube.center, -most, most);
    }
    if (dice.chance(0.5)) draft.camera.automatic = true;
}

// Hills, on some of the grounds; last of all, as scatter().
inline void raise_hills(Dice& dice, const Whereabouts& where, SceneDraft& draft) {
    if (!draft.ground || !dice.chance(0.5)) return;
    Terrain& terrain = draft.ground->terrain.emplace();
    const auto length = [](double size) {
        return std::clamp(size, limits::kMinLength, limits::kMaxLength);
    };
    terrain.height = dice.chance(0.1)
                         ? 0
                         : std::min(where.size * dice.log_between(1e-3, 10), limits::kMaxLength);
    terrain.extent = length(where.size * dice.log_between(0.1, 1e3));
    terrain.center = where.middle;
    terrain.size = length(terrain.extent * dice.log_between(1e-3, 2));
    terrain.roughness = dice.chance(0.2) ? dice.either({0, 1}) : dice.uniform();
    terrain.level = dice.chance(0.5) ? 0 : dice.between(0, limits::kMaxTerrainLevel);
    terrain.seed = static_cast<std::uint64_t>(dice.below(1000));
    if (dice.chance(0.3)) terrain.rock = glm::dvec3(dice.uniform(), dice.uniform(), dice.uniform());
    if (dice.chance(0.3))
        terrain.snow = std::clamp(terrain.height * dice.uniform(), 0.0, limits::kMaxLength);
    if (dice.chance(0.1))
        draft.effects[static_cast<int>(Effect::kTerrain)] =
            dice.chance(0.5) ? Switch::kOff : Switch::kOn;
}

inline RandomScene random_scene(std::uint64_t seed) {
    Dice dice(seed);
    RandomScene random;
    SceneDraft& draft = random.draft;
    draft.top_level_cubes = false;
    draft.seed = seed;
    draft.accuracy.rung = random_rung(dice);
    const bool paths = *draft.accuracy.rung == "truth";

    Whereabouts where;
    where.size = dice.chance(0.7) ? dice.log_between(0.1, 1e3) : dice.log_between(1e-5, 1e6);
    if (dice.chance(0.2)) where.middle = dice.any_vector(0.9 * limits::kMaxCoordinate);

    Medium& medium = draft.medium;
    medium.albedo = dice.chance(0.5)   ? dice.either({0, 0.9999, 1})
                    : dice.chance(0.5) ? dice.uniform()
                                       : 1 - dice.log_between(1e-9, 1);
    medium.g = dice.chance(0.3)
                   ? dice.either({0, -limits::kMaxAnisotropy, limits::kMaxAnisotropy, .85, 1e-9})
                   : dice.between(-limits::kMaxAnisotropy, limits::kMaxAnisotropy);
    medium.phase =
        dice.chance(0.3) ? PhaseFunction::kCornetteShanks : PhaseFunction::kHenyeyGreenstein;

    random.furnace = dice.chance(0.3);
    Sun& sun = draft.sun;
    // Bounds are of light that was scattered.
    sun.disc = SunDisc::kHidden;
    if (dice.chance(0.3))
        sun.direction = dice.on_sphere() * dice.log_between(1e-6, 1e6);
    else if (dice.chance(0.3))
        sun.elevation = dice.either({-90, 90, 0});
    else
        sun.elevation = dice.between(-90, 90), sun.azimuth = dice.any(limits::kMaxAngle);
    sun.color = dice.color(limits::kMaxColor);
    sun.intensity =
        random.furnace || dice.chance(0.1) ? 0 : dice.log_between(1e-6, limits::kMaxIntensity);
    Sky& sky = draft.sky;
    sky.none = !random.furnace && dice.chance(0.3);
    sky.zenith = dice.color(limits::kMaxColor);
    sky.horizon = dice.chance(0.3) ? sky.zenith : dice.color(limits::kMaxColor);
    sky.intensity = dice.chance(0.1) ? 0 : dice.log_between(1e-6, limits::kMaxIntensity);
    if (random.furnace) {
        sky.zenith = sky.horizon = glm::dvec3(1);
        sky.intensity = 1;
    }

    const int clouds = dice.chance(0.9) ? 1 : dice.below(4);
    for (int k = 0; k < clouds; ++k) {
        double density = 1;
        draft.clouds.push_back(random_cloud(dice, where, density));
        draft.density = density;
    }
    // What no rung but truth has, and it only now and then.
    if (paths && !random.furnace && dice.chance(0.3))
        draft.ground = {where.middle.y - where.size * dice.between(0, 3),
                        glm::dvec3(dice.uniform())};
    random_picture(dice, draft.image, paths);
    random_camera(dice, where, draft, draft.camera);
    for (const Effect effect : {Effect::kSelfShadow, Effect::kMultipleScattering,
                                Effect::kViewExtinction, Effect::kSkyLight, Effect::kInterior})
        if (dice.chance(0.15))
            draft.effects[static_cast<int>(effect)] = dice.chance(0.5) ? Switch::kOff : Switch::kOn;
    random_surroundings(dice, where, random);
    if (dice.chance(0.15)) scatter(dice, where, draft);
    raise_hills(dice, where, draft);
    return random;
}

}  // namespace awan::test
