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
    LatticeField lattice = lattice_over(field, resolution);
    if (lattice.nx == 0) return made;
    limit_octaves(cloud, request.key, request.time, lattice.cell, field);
    if (Status late = sample(field, request.threads, deadline, lattice)) return *late;
    if (!request.coarse) {
        // A particle has the mean over its cell, with octaves that the cell itself cannot show: density is far from
        // linear in turbulence, so its value where turbulence is smooth is not its mean.
        LatticeField fine = finer(lattice);
        limit_octaves(cloud, request.key, request.time, fine.cell, field);
        if (Status late = sample(field, request.threads, deadline, fine, &lattice)) return *late;
        take_means(fine, request.threads, lattice);
        made.error = sampling_error(lattice, fine, request.density);
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
