// A random valid cloud of model "automaton" for the random search: every field over its range, small enough for 50 ms.
#pragma once

#include "core/scene/automaton.h"
#include "tests/random_scenes.h"

namespace awan::test {

inline AutomatonSpeed random_speed(Dice& dice) {
    AutomatonSpeed speed;
    if (dice.chance(0.1)) {  // wild
        speed.constant = dice.any(limits::kMaxAutomatonSpeed);
        speed.linear = dice.any(limits::kMaxAutomatonSpeed);
        speed.quadratic = dice.any(limits::kMaxAutomatonSpeed);
    } else {
        speed.constant = dice.between(-2, 2);
        speed.linear = dice.chance(0.5) ? 0 : dice.between(-0.2, 0.2);
        speed.quadratic = dice.chance(0.7) ? 0 : dice.between(-0.01, 0.01);
    }
    if (dice.chance(0.4)) speed.direction = dice.any(limits::kMaxAngle);
    if (dice.chance(0.4)) speed.turn = dice.between(-20, 20);
    return speed;
}

// Of a word "table", a list for it.
inline std::vector<float> random_table(Dice& dice, bool wanted) {
    std::vector<float> table;
    for (int n = wanted ? 2 + dice.below(8) : 0; n > 0; --n)
        table.push_back(static_cast<float>(dice.between(0.01, 1)));
    return table;
}

inline double random_share(Dice& dice, double usual) {
    if (dice.chance(0.15)) return dice.either({0, 1, 1e-300, 0.5, 1 - 0x1p-53});
    return std::min(1.0, usual * dice.log_between(0.1, 10));
}

inline Cloud random_automaton(Dice& dice, const Whereabouts& where) {
    AutomatonCloud a;
    const auto side = [&](double most) {
        if (dice.chance(0.1)) return dice.either({1, 2, most});
        return std::floor(dice.log_between(3, most));
    };
    const double x = side(dice.chance(0.05) ? limits::kMaxAutomatonSide : 100), y = side(24);
    const double z = side(40);
    a.cells = {x, y, z};
    const double longest = std::max({x, y, z});
    a.cell =
        std::clamp(2 * where.size / longest, limits::kMinAutomatonCell, limits::kMaxAutomatonCell);

    const auto radius = [&] {
        return dice.chance(0.05)
                   ? dice.either({limits::kMinAutomatonRadius, limits::kMaxAutomatonRadius})
                   : dice.log_between(1, 30);
    };
    const auto radii = [&] {
        const double rx = radius(), ry = radius(), rz = radius();
        return glm::dvec3(rx, ry, rz);
    };
    for (int n = dice.chance(0.5) ? 0 : 1 + dice.below(5); n > 0; --n) {
        const double cx = x * dice.between(-0.2, 1.2), cy = y * dice.between(-0.2, 1.2),
                     cz = z * dice.between(-0.2, 1.2);
        const glm::dvec3 far = dice.any_vector(limits::kMaxAutomatonPlace);
        a.ellipsoids.push_back({dice.chance(0.05) ? far : glm::dvec3(cx, cy, cz), radii()});
    }
    if (dice.chance(0.7)) {
        RandomEllipsoids random;
        random.count = static_cast<std::uint64_t>(dice.below(12));
        random.smallest = radii();
        random.largest = glm::max(random.smallest, radii());
        if (dice.chance(0.5))
            random.level.reset();
        else
            random.level = y * dice.between(-0.1, 1.1);
        a.random = random;
    }
    a.overlap = dice.chance(0.5) ? AutomatonOverlap::kDeepest : AutomatonOverlap::kFirst;
    a.base = dice.chance(0.3)    ? 0
             : dice.chance(0.05) ? dice.any(limits::kMaxAutomatonPlace)
                                 : y * dice.between(0, 0.5);
    a.humidity = random_share(dice, 0.15);
    a.activation = random_share(dice, 0.01);
    a.extinction = random_share(dice, 0.1);
    a.outside_extinction = random_share(dice, 0.2);
    a.fall_off = static_cast<AutomatonShape>(dice.below(4));
    a.fall_off_table = random_table(dice, a.fall_off == AutomatonShape::kTable);
    a.smooth_weight = static_cast<AutomatonWeight>(dice.below(5));
    a.smooth_weight_table = random_table(dice, a.smooth_weight == AutomatonWeight::kTable);
    if (dice.chance(0.5)) a.wind.direction = dice.between(-360, 360);
    if (dice.chance(0.4)) a.wind.layers = random_speed(dice);
    if (dice.chance(0.3)) a.wind.layer_bands.push_back({0, y, random_speed(dice)});
    for (int n = dice.chance(0.6) ? 0 : 1 + dice.below(3); n > 0; --n) {
        AutomatonWindBand band;
        band.from = dice.chance(0.5) ? -limits::kMaxAutomatonPlace : y * dice.uniform();
        band.to = band.from + y * dice.uniform();
        band.speed = random_speed(dice);
        a.wind.ellipsoids.push_back(band);
    }
    a.wind.mutation = dice.chance(0.2) ? dice.either({0, 1}) : dice.uniform();

    a.warm_up = static_cast<std::uint64_t>(dice.below(30));
    a.steps = a.warm_up + static_cast<std::uint64_t>(dice.below(8));
    a.steps_per_second = dice.chance(0.1) ? dice.either({0, limits::kMaxStepsPerSecond})
                                          : dice.log_between(1e-6, 10);
    for (int axis = 0; axis < 3; ++axis)
        a.smooth[axis] = dice.below(static_cast<int>(limits::kMaxAutomatonSmooth) + 1);
    a.smooth_steps = dice.chance(0.5) ? 1
                                      : 1 + static_cast<std::uint64_t>(dice.below(
                                                static_cast<int>(limits::kMaxAutomatonHistory)));
    a.metaball_radius = dice.chance(0.1)
                            ? dice.either({limits::kMinMetaballRadius, limits::kMaxMetaballRadius})
                            : dice.between(1.5, 4);
    a.threshold = dice.chance(0.6) ? 0 : dice.chance(0.1) ? 1 : dice.log_between(1e-6, 1);
    a.most_particles = dice.chance(0.1) ? 1 + static_cast<std::uint64_t>(dice.below(10))
                                        : static_cast<std::uint64_t>(dice.log_between(20, 2000));

    a.drawing.mode = static_cast<AutomatonMode>(dice.below(4));
    a.drawing.textures = dice.chance(0.5) ? "soft" : "wisp,puff";
    a.drawing.billboard_scale = dice.log_between(0.1, 30);
    a.drawing.color_multiplier = dice.log_between(0.1, 10);
    a.drawing.opacity = dice.log_between(0.1, 10);
    a.drawing.point_size = dice.log_between(0.1, 10);
    a.drawing.hold = dice.chance(0.5);
    if (!a.ellipsoids.empty() && dice.chance(0.3)) a.chosen = a.ellipsoids.size() - 1;

    Cloud cloud;
    cloud.model = CloudModel::kAutomaton;
    cloud.automaton = std::make_shared<const AutomatonCloud>(std::move(a));
    cloud.translate = where.middle;
    cloud.rotate_y = dice.chance(0.5) ? 0 : dice.any(limits::kMaxAngle);
    // Deep or thin by its own size.
    const double depth = dice.chance(0.1) ? 0 : dice.log_between(1e-6, 1e6);
    cloud.density = std::min(depth / (cloud.automaton->cell * longest), limits::kMaxDensity / 2);
    cloud.seed = static_cast<std::uint64_t>(dice.below(1000000));
    return cloud;
}

}  // namespace awan::test
