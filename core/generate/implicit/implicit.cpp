#include "core/scene/implicit.h"

#include <algorithm>

#include "core/generate/implicit/sampling.h"
#include "core/generate/models.h"
#include "core/scene/limits.h"

namespace awan::implicit {

Result<ModelParticles> make_particles(const ImplicitCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline) {
    const std::uint64_t resolution =
        request.coarse ? limits::kMinImplicitResolution : cloud.resolution;
    ModelParticles made;
    ImplicitField field = prepare_field(cloud, request.key, request.time);
    LatticeField lattice = lattice_over(field, resolution), half = coarser(lattice);
    if (lattice.nx == 0) return made;
    const auto fill = [&](LatticeField& one) {
        limit_octaves(cloud, request.key, request.time, one.cell, field);
        return sample(field, request.threads, deadline, one);
    };
    if (Status late = fill(lattice)) return *late;
    if (!request.coarse) {
        if (Status late = fill(half)) return *late;
        limit_octaves(cloud, request.key, request.time, lattice.cell, field);
        made.error = sampling_error(lattice, half, field);
    }
    const float largest = *std::max_element(lattice.values.begin(), lattice.values.end());
    LatticeOptions options;
    options.threshold = largest * static_cast<float>(cloud.threshold);
    options.sharpen = true;
    made.particles = lattice_particles(lattice, options, request.threads);
    if (auto late = deadline.over()) return *late;
    return made;
}

}  // namespace awan::implicit
