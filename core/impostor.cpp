#include "core/impostor.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "core/base/exact_math.h"
#include "core/generate/generate.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

double sign(double value) {
    return value < 0 ? -1 : 1;
}

// What every view shares.
SceneDraft shared_draft(const Scene& scene, const ImpostorWish& wish, bool with_depth) {
    SceneDraft draft = *scene;
    draft.sequence.reset();
    draft.haze.reset();
    draft.image.width = draft.image.height = wish.size;
    draft.image.background = Background::kTransparent;
    if (draft.look == Look::kPhysical && !draft.accuracy.rung)
        draft.accuracy = {{}, {}, kImpostorRung};
    const Rung* const rung = draft.accuracy.rung ? find_rung(*draft.accuracy.rung) : nullptr;
    const bool has_depth = with_depth && rung != nullptr && rung->method == Method::kMarch;
    draft.image.layers = has_depth ? "depth" : "none";
    return draft;
}

}  // namespace

glm::dvec3 impostor_direction(ImpostorMapping mapping, double u, double v) {
    glm::dvec3 d(0);
    if (mapping == ImpostorMapping::kHemisphere) {
        d.x = (u + v) / 2;
        d.z = (u - v) / 2;
        d.y = std::max(1 - std::abs(d.x) - std::abs(d.z), 0.0);
    } else {
        d = {u, 1 - std::abs(u) - std::abs(v), v};
        if (d.y < 0) {
            d.x = sign(u) * (1 - std::abs(v));
            d.z = sign(v) * (1 - std::abs(u));
        }
    }
    return glm::normalize(d);
}

Result<Impostor> impostor_of(const Scene& scene, const ImpostorWish& wish, bool with_depth,
                             int threads, const Deadline& deadline) {
    if (wish.views * wish.size > limits::kMaxImageSide)
        return Error{ErrorCode::kTooLarge, "",
                     "an atlas of " + std::to_string(wish.views) + " views of " +
                         std::to_string(wish.size) + " pixels a side is larger than " +
                         std::to_string(limits::kMaxImageSide)};
    const auto particles = generate(scene, threads, deadline, scene->look != Look::kPhysical);
    if (!particles.ok()) return particles.error();
    Impostor impostor{wish, {}, 1, 1, {}};
    if (particles->size() > 0) {
        const Bounds bounds = bounds_of(*particles);
        impostor.center = 0.5 * (bounds.min + bounds.max);
        impostor.radius = 0;
        for (std::size_t i = 0; i < particles->size(); ++i)
            impostor.radius =
                std::max(impostor.radius, glm::length(particles->center[i] - impostor.center) +
                                              static_cast<double>(particles->radius[i]));
    }
    impostor.distance = impostor.radius / exact::sin(glm::radians(kImpostorFov) / 2);
    SceneDraft draft = shared_draft(scene, wish, with_depth);
    draft.camera = Camera{};
    draft.camera.automatic = false;
    draft.camera.target = impostor.center;
    draft.camera.fov = kImpostorFov;
    for (int row = 0; row < wish.views; ++row)
        for (int column = 0; column < wish.views; ++column) {
            const auto coordinate = [&](int i) { return 2.0 * i / (wish.views - 1) - 1; };
            const glm::dvec3 direction =
                impostor_direction(wish.mapping, coordinate(column), coordinate(row));
            draft.camera.eye = impostor.center + impostor.distance * direction;
            // From straight above and below, -z is at the top.
            const bool upright = std::abs(direction.y) < 0.9999;
            draft.camera.up = upright ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
            auto view = validate(draft);
            if (!view.ok()) return view.error();
            impostor.views.push_back({direction, *std::move(view)});
        }
    return impostor;
}

}  // namespace awan
