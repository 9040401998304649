#include "core/scene/automaton.h"

#include "core/generate/models.h"

namespace awan {

Result<ModelParticles> automaton_particles(const AutomatonCloud&, const ModelRequest&,
                                           const Deadline&) {
    return ModelParticles{};
}

}  // namespace awan
