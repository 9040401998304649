#include "core/scene/implicit.h"

#include <algorithm>

#include "core/generate/implicit/sampling.h"
#include "core/generate/models.h"
#include "core/scene/limits.h"

namespace awan {

Result<ModelParticles> implicit_particles(const ImplicitCloud& cloud, const ModelRequest& request,
                                          const Deadline& deadline) {
    const std::uint64_t resolution =
        request.coarse ? limits::kMinImplicitResolution : cloud.resolution;
    ModelParticles made;
    // The cells' size follows from the field's box, and what the noise can show from the cells' size.
    const LatticeField plan =
        lattice_over(prepare_field(cloud, request.key, request.time, 0), resolution);
    if (plan.nx == 0) return made;
    LatticeField lattice = plan, half = coarser(plan);
    const auto fill = [&](LatticeField& one) {
        const ImplicitField field = prepare_field(cloud, request.key, request.time, one.cell);
        return sample(field, request.threads, deadline, one);
    };
    if (Status late = fill(lattice)) return *late;
    if (!request.coarse) {
        if (Status late = fill(half)) return *late;
        made.error = sampling_error(lattice, half);
    }
    const float largest = *std::max_element(lattice.values.begin(), lattice.values.end());
    LatticeOptions options;
    options.threshold = largest * static_cast<float>(cloud.threshold);
    options.sharpen = true;
    made.particles = lattice_particles(lattice, options, request.threads);
    if (auto late = deadline.over()) return *late;
    return made;
}

}  // namespace awan
