#include "core/scene/spheres.h"

#include "core/generate/models.h"

namespace awan {

Result<ModelParticles> spheres_particles(const SpheresCloud&, const ModelRequest&,
                                         const Deadline&) {
    return ModelParticles{};
}

}  // namespace awan
