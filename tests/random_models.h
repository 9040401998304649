// The random search's scenes with clouds of every model, that move.
#pragma once

#include "core/scene/validate.h"
#include "tests/random_models_automaton.h"
#include "tests/random_models_ellipsoids.h"
#include "tests/random_models_implicit.h"
#include "tests/random_models_spheres.h"
#include "tests/random_scenes.h"

namespace awan::test {

// random_scene(seed), in which now and then a procedural cloud stands for the first one; its times and speeds. Dice of
// its own: the other scenes are what they were.
inline RandomScene random_scene_of_any_model(std::uint64_t seed) {
    RandomScene random = random_scene(seed);
    SceneDraft& draft = random.draft;
    Dice dice(seed ^ 0x6d6f64656c73);
    if (draft.clouds.empty() || !dice.chance(0.25)) return random;
    Cloud& cloud = draft.clouds[0];
    Whereabouts where;
    where.middle = cloud.translate;
    double most = 0;
    for (const Cube& cube : cloud.cubes) most = std::max(most, cube.radius);
    for (const float radius : cloud.ready.radii) most = std::max(most, static_cast<double>(radius));
    where.size = most > 0 ? 4 * most : 1;
    const auto density = cloud.density;
    const int model = dice.below(4);
    cloud = model == 0   ? random_automaton(dice, where)
            : model == 1 ? random_spheres(dice, where)
            : model == 2 ? random_implicit(dice, where)
                         : random_ellipsoids(dice, where);
    // The model's own share is up to a thousand and multiplies it.
    if (density) cloud.density = std::min(*density, 1e-4 * limits::kMaxDensity);
    draft.time = dice.chance(0.3) ? 0 : dice.chance(0.1) ? dice.any(1e5) : dice.between(-2, 30);
    if (dice.chance(0.3)) cloud.velocity = dice.any_vector(where.size);
    if (dice.chance(0.2)) {
        draft.sequence = Sequence{dice.between(-1, 1), dice.between(0, 5), 3};
        cloud.velocity *= 1e-3;
    }
    if (dice.chance(0.15) && draft.clouds.size() == 1 && model != 2) {
        draft.look = model == 0 ? Look::kUpchurch : model == 1 ? Look::kOstroushko : Look::kGardner;
        draft.accuracy = {};
    }
    if (!validate(draft).ok()) {  // two edges of the world at once
        draft.time = 0;
        draft.sequence.reset();
    }
    return random;
}

}  // namespace awan::test
