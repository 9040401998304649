// Random valid clouds of model "ellipsoids", every field over its range, few enough cells for 50 ms.
#pragma once

#include <algorithm>
#include <memory>

#include "core/scene/ellipsoids.h"
#include "tests/random_scenes.h"

namespace awan::test {
namespace ellipsoids_dice {

inline SineTexture random_texture(Dice& dice, double usual) {
    SineTexture texture;
    texture.form = dice.chance(0.8) ? TextureForm::kClean : TextureForm::kPrinted;
    texture.terms = 1 + static_cast<std::uint64_t>(dice.below(8));
    const auto frequency = [&] {
        return dice.chance(0.1)
                   ? dice.either({limits::kMinTextureFrequency, limits::kMaxTextureFrequency})
                   : std::clamp(usual * dice.log_between(0.1, 10), limits::kMinTextureFrequency,
                                limits::kMaxTextureFrequency);
    };
    texture.frequency_x = frequency();
    texture.frequency_z = dice.chance(0.5) ? texture.frequency_x : frequency();
    texture.offset =
        dice.chance(0.2) ? dice.either({0, limits::kMaxTextureOffset}) : dice.between(0, 3);
    if (dice.chance(0.2))
        for (int i = dice.below(8); i >= 0; --i)
            texture.sines.push_back({dice.log_between(1e-3, 100), frequency(), frequency(),
                                     dice.any(360), dice.any(360)});
    return texture;
}

inline double random_threshold(Dice& dice) {
    return dice.chance(0.1)
               ? dice.either({limits::kMinTextureThreshold, 0, 1, limits::kMaxTextureThreshold})
               : dice.between(-0.5, 1);
}

inline double random_range(Dice& dice) {
    return dice.chance(0.2) ? dice.either({limits::kMinTextureRange, limits::kMaxTextureRange})
                            : dice.log_between(0.01, 1);
}

// A radius about `size`, in its limits.
inline double random_radius(Dice& dice, double size) {
    return std::clamp(
        size * (dice.chance(0.1) ? dice.log_between(1e-3, 10) : dice.between(0.1, 0.6)),
        limits::kMinEllipsoidRadius, limits::kMaxEllipsoidRadius);
}

inline glm::dvec3 random_radii(Dice& dice, double size) {
    const double x = random_radius(dice, size), y = random_radius(dice, size),
                 z = random_radius(dice, size);
    return {x, y, z};
}

inline glm::dvec3 random_place(Dice& dice, double size) {
    if (dice.chance(0.02)) return dice.any_vector(limits::kMaxEllipsoidCoordinate);
    const double x = dice.between(-1, 1), y = dice.between(-1, 1), z = dice.between(-1, 1);
    return glm::dvec3(x, y, z) * size;
}

}  // namespace ellipsoids_dice

inline Cloud random_ellipsoids(Dice& dice, const Whereabouts& where) {
    using namespace ellipsoids_dice;
    Cloud cloud;
    cloud.model = CloudModel::kEllipsoids;
    // The model's own lengths are of middling size (limits.h); the rest is the cloud's scale.
    const double size = std::clamp(where.size, 0.1, 100.0);
    cloud.scale = std::clamp(where.size / size, limits::kMinScale, limits::kMaxScale);
    cloud.translate = where.middle;
    cloud.rotate_y = dice.chance(0.5) ? 0 : dice.any(limits::kMaxAngle);
    if (dice.chance(0.3)) cloud.seed = static_cast<std::uint64_t>(dice.below(1 << 30));

    EllipsoidsCloud model;
    model.texture = random_texture(dice, 5 / size);
    model.shading = {dice.chance(0.2) ? dice.either({0, 1}) : dice.uniform(),
                     dice.chance(0.2) ? dice.either({0, 1}) : dice.uniform(),
                     dice.chance(0.2) ? dice.either({0, 1}) : dice.uniform(),
                     dice.chance(0.2) ? dice.either({1, limits::kMaxShininess})
                                      : dice.log_between(1, limits::kMaxShininess)};
    model.translucence = {random_threshold(dice), random_threshold(dice), random_range(dice),
                          dice.chance(0.8) ? 0 : dice.between(0, 0.5),
                          dice.chance(0.8) ? 1 : dice.between(0.5, 1)};
    if (dice.chance(0.3)) model.join = dice.chance(0.3) ? 1 : dice.uniform();
    if (dice.chance(0.3)) {
        SkyPlane& plane = model.plane.emplace();
        plane.altitude = size * dice.between(-2, 2);
        plane.extent = std::clamp(size * dice.log_between(0.1, 100), limits::kMinPlaneExtent,
                                  limits::kMaxPlaneExtent);
        plane.thickness =
            plane.extent * (dice.chance(0.2) ? dice.either({0, 1}) : dice.between(0, 0.1));
        plane.threshold = random_threshold(dice);
        plane.range = random_range(dice);
        plane.density = dice.chance(0.2) ? 0 : dice.log_between(1e-3, 100);
        plane.resolution = 8 + static_cast<std::uint64_t>(dice.below(16));
        plane.texture = random_texture(dice, 5 / size);
        if (dice.chance(0.3)) plane.horizon = plane.extent;
        if (dice.chance(0.2)) plane.least = 0.25, plane.most = 0.75;
        for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i)
            plane.patterns.push_back({size * dice.between(-2, 2), size * dice.between(-2, 2),
                                      std::max(plane.extent / 4, limits::kMinPlaneExtent),
                                      std::max(plane.extent / 3, limits::kMinPlaneExtent),
                                      dice.uniform(), random_threshold(dice), random_range(dice),
                                      random_texture(dice, 5 / size)});
    }
    for (int i = dice.below(3); i > 0; --i) {
        Formation& one = model.formations.emplace_back();
        one.kind = static_cast<FormationKind>(dice.below(3));
        one.count = static_cast<std::uint64_t>(dice.log_between(1, 30));
        one.center = random_place(dice, size);
        one.radii = random_radii(dice, size);
        one.variation = dice.chance(0.2) ? dice.either({0, limits::kMaxRadiusVariation})
                                         : dice.between(0, limits::kMaxRadiusVariation);
        one.link = dice.chance(0.2) ? dice.either({limits::kMinLink, limits::kMaxLink})
                                    : dice.between(limits::kMinLink, limits::kMaxLink);
        one.heading = dice.any(limits::kMaxAngle);
        one.spread = dice.chance(0.2) ? dice.either({0, 180}) : dice.between(0, 180);
        if (dice.chance(0.3)) one.tilt = dice.between(0, 90);
    }
    for (int i = dice.below(6); i > 0; --i) {
        Ellipsoid& one = model.ellipsoids.emplace_back();
        one.center = random_place(dice, size);
        one.radii = random_radii(dice, size);
        one.rotate_y = dice.any(limits::kMaxAngle);
        if (dice.chance(0.3)) one.rotate_x = dice.any(360), one.rotate_z = dice.any(360);
        if (dice.chance(0.2)) one.threshold = random_threshold(dice);
        if (dice.chance(0.2)) one.threshold_edge = random_threshold(dice);
        if (dice.chance(0.2)) one.range = random_range(dice);
    }
    for (int i = dice.chance(0.3) ? dice.below(3) : 0; i > 0; --i) {
        // A ball, sheared so little that it stays an ellipsoid.
        const double r = random_radius(dice, size);
        Quadric& one = model.quadrics.emplace_back();
        one.q4 = dice.between(-0.5, 0.5);
        one.q5 = dice.between(-0.5, 0.5);
        one.q6 = dice.between(-0.5, 0.5);
        one.q0 = -std::clamp(r * r, 1e-4, 1e4);
    }
    if (dice.chance(0.5)) model.drift = dice.any_vector(limits::kMaxVelocity);
    model.density = dice.chance(0.1) ? 0 : dice.log_between(1e-3, 100);
    model.resolution = 8 + static_cast<std::uint64_t>(dice.below(14));
    cloud.ellipsoids = std::make_shared<const EllipsoidsCloud>(std::move(model));
    return cloud;
}

}  // namespace awan::test
