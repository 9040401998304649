#include "core/scene/implicit.h"

#include "core/generate/models.h"

namespace awan {

Result<ModelParticles> implicit_particles(const ImplicitCloud&, const ModelRequest&,
                                          const Deadline&) {
    return ModelParticles{};
}

}  // namespace awan
