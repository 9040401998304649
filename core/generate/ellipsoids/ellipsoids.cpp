#include "core/scene/ellipsoids.h"

#include "core/generate/models.h"

namespace awan {

Result<ModelParticles> ellipsoids_particles(const EllipsoidsCloud&, const ModelRequest&,
                                            const Deadline&) {
    return ModelParticles{};
}

}  // namespace awan
