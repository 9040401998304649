// Random valid clouds of model "spheres" (core/scene/spheres.h): every field over its range, the ends more often.
#pragma once

#include <algorithm>
#include <memory>

#include "core/scene/spheres.h"
#include "tests/random_scenes.h"

namespace awan::test {

inline Cloud random_spheres(Dice& dice, const Whereabouts& where) {
    const auto spheres = std::make_shared<SpheresCloud>();
    spheres->kind = dice.chance(0.5) ? SpheresKind::kCumulus : SpheresKind::kCirrus;
    // 15,625 spheres take some 5 ms; the deepest trees are for tests of their own.
    spheres->levels =
        dice.chance(0.1) ? 0 : static_cast<std::uint64_t>(1 + dice.below(dice.chance(0.1) ? 6 : 4));
    for (int axis = 0; axis < 3; ++axis)
        spheres->size[axis] = std::clamp(
            where.size * (dice.chance(0.1) ? dice.log_between(1e-5, 2) : dice.log_between(0.2, 2)),
            limits::kMinSpheresSide, limits::kMaxSpheresSide);
    if (dice.chance(0.5))
        spheres->visual_range =
            dice.chance(0.2) ? dice.either({limits::kMinVisualRange, limits::kMaxVisualRange})
                             : std::clamp(where.size * dice.log_between(1e-3, 1e3),
                                          limits::kMinVisualRange, limits::kMaxVisualRange);
    const auto range = [&](double low, double high, std::optional<double>& from,
                           std::optional<double>& to) {
        const double a = dice.chance(0.3) ? low : dice.between(low, high);
        const double b = dice.chance(0.3) ? high : dice.between(low, high);
        from = std::min(a, b);
        to = dice.chance(0.2) ? from : std::max(a, b);
    };
    if (dice.chance(0.5)) {
        range(0, limits::kMaxSphereRatio, spheres->ratio_min, spheres->ratio_max);
        spheres->ratio_max = std::max(*spheres->ratio_max, limits::kLeastUpperRatio);
    }
    if (dice.chance(0.5)) range(0, 1, spheres->shift_min, spheres->shift_max);
    spheres->scaling = dice.chance(0.5) ? SpheresScaling::kFirst : SpheresScaling::kEvery;
    spheres->growth = dice.chance(0.5) ? SpheresGrowth::kUp : SpheresGrowth::kDown;
    if (dice.chance(0.3)) {
        SpheresMorph& morph = spheres->morph.emplace();
        morph.seed =
            dice.chance(0.1) ? UINT64_MAX : static_cast<std::uint64_t>(dice.log_between(1, 1e18));
        morph.duration = dice.chance(0.2)
                             ? dice.either({limits::kMinMorphDuration, limits::kMaxTime})
                             : dice.log_between(0.1, 100);
        morph.steps = dice.chance(0.2) ? limits::kMaxMorphSteps
                                       : static_cast<std::uint64_t>(dice.log_between(1, 100));
    }
    // Few spheres, whatever the parts.
    if (dice.chance(0.5)) {
        spheres->parts = limits::kMinSphereParts + static_cast<std::uint64_t>(dice.below(11));
        if (spheres->parts > 5) spheres->levels = std::min<std::uint64_t>(spheres->levels, 3);
    }
    spheres->places = static_cast<SpheresPlaces>(dice.below(5));
    spheres->ratio_law = static_cast<SpheresLaw>(dice.below(5));
    spheres->shift_law = static_cast<SpheresLaw>(dice.below(5));
    if (dice.chance(0.3))
        spheres->turning =
            dice.chance(0.2) ? limits::kMaxSphereTurning : dice.log_between(0.1, 100);
    if (dice.chance(0.3)) {
        double time = dice.between(-10, 10);
        for (int i = dice.below(4); i >= 0; --i, time += dice.log_between(0.1, 10)) {
            SpheresPose& pose = spheres->poses.emplace_back();
            pose.time = time;
            pose.shift = where.size * dice.any_vector(1);
            pose.turn = dice.any_vector(dice.chance(0.1) ? limits::kMaxAngle : 360);
            for (int axis = 0; axis < 3; ++axis)
                pose.scale[axis] = std::clamp(dice.log_between(0.3, 3),
                                              limits::kMinSpheresSide / spheres->size[axis],
                                              limits::kMaxSpheresSide / spheres->size[axis]);
        }
    }
    if (dice.chance(0.3)) {
        SpheresBump& bump = spheres->bump.emplace();
        bump.height = dice.chance(0.2) ? dice.either({0, limits::kMaxBumpHeight}) : dice.uniform();
        for (int i = dice.below(4); i > 0; --i)
            bump.waves.push_back({dice.between(-1, 1), static_cast<std::uint64_t>(dice.below(65)),
                                  dice.between(-64, 64), dice.uniform()});
        if (dice.chance(0.3)) bump.texture = dice.chance(0.5) ? "puff" : "none";
        bump.repeat = 1 + static_cast<std::uint64_t>(dice.below(64));
    }
    Cloud cloud;
    cloud.model = CloudModel::kSpheres;
    cloud.translate = where.middle;
    const double depth = dice.chance(0.1) ? 0 : dice.log_between(1e-6, 1e6);
    cloud.density = std::min(depth / where.size, limits::kMaxDensity);
    if (dice.chance(0.5)) cloud.rotate_y = dice.any(limits::kMaxAngle);
    if (dice.chance(0.3)) cloud.scale = dice.log_between(0.1, 10);
    cloud.spheres = spheres;
    return cloud;
}

}  // namespace awan::test
