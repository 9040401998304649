#include "core/generate/models.h"

namespace awan {

Result<ModelParticles> model_particles(const Cloud& cloud, const ModelRequest& request,
                                       const Deadline& deadline) {
    switch (cloud.model) {
        case CloudModel::kAutomaton:
            return automaton::make_particles(*cloud.automaton, request, deadline);
        case CloudModel::kSpheres:
            return spheres::make_particles(*cloud.spheres, request, deadline);
        case CloudModel::kImplicit:
            return implicit::make_particles(*cloud.implicit, request, deadline);
        case CloudModel::kEllipsoids:
            return ellipsoids::make_particles(*cloud.ellipsoids, request, deadline);
        case CloudModel::kCubes:
        case CloudModel::kParticles:
            break;
    }
    return ModelParticles{};
}

}  // namespace awan
