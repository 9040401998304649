#include "core/lit_particles.h"

#include "core/draw/particle_light.h"
#include "core/scene/rungs.h"
#include "core/scene/validate.h"

namespace awan {

Result<Scene> scene_of_light(const Scene& scene) {
    SceneDraft draft = *scene;
    const Rung* const named = draft.accuracy.rung ? find_rung(*draft.accuracy.rung) : nullptr;
    if (draft.look != Look::kPhysical)
        return Error{ErrorCode::kInvalidScene, "/look", "a look has no light of particles to give"};
    if (named == nullptr || named->cells == 0)
        draft.accuracy = {{}, {}, rung_of(RungId::kTransport16).name};
    draft.detail.reset();
    draft.sequence.reset();
    return validate(std::move(draft));
}

Result<std::vector<glm::vec3>> light_particles(const Scene& lit, Planned planned,
                                               const ParticleSet& particles,
                                               const ClimbTools& tools, const Deadline& deadline) {
    // Nobody asks how far off it is.
    planned.is_unmeasured = true;
    const auto climbed = climb(lit, planned, tools, deadline);
    if (!climbed) return climbed.error();
    return particle_light(lit, particles, *climbed->light, planned.survey.view.eye, tools.threads);
}

}  // namespace awan
