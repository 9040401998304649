// Small scenes of model "ellipsoids".
#pragma once

#include <memory>

#include "core/generate/ellipsoids/formations.h"
#include "tests/scenes.h"

namespace awan::test {

inline SceneDraft scene_of(EllipsoidsCloud model) {
    SceneDraft draft = plain_draft();
    draft.top_level_cubes = false;
    Cloud cloud;
    cloud.model = CloudModel::kEllipsoids;
    cloud.ellipsoids = std::make_shared<const EllipsoidsCloud>(std::move(model));
    draft.clouds.push_back(cloud);
    draft.image.width = 64;
    draft.image.height = 48;
    return draft;
}

inline EllipsoidsCloud with_ellipsoid(const Ellipsoid& one) {
    EllipsoidsCloud model;
    model.ellipsoids = {one};
    return model;
}

inline EllipsoidsCloud with_formation(FormationKind kind, std::uint64_t count) {
    EllipsoidsCloud model;
    Formation& formation = model.formations.emplace_back();
    formation.kind = kind;
    formation.count = count;
    return model;
}

// Opaque wherever there is an ellipsoid or plane, whatever the texture.
inline EllipsoidsCloud opaque(EllipsoidsCloud model) {
    model.translucence = {-5, -5, 1};
    if (model.plane) model.plane->threshold = -5, model.plane->range = 1;
    return model;
}

}  // namespace awan::test
