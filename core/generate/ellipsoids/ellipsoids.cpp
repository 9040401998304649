// Ellipsoids and a sky plane as matter: where the source makes a surface more or less translucent, extinction is more or less.
#include <algorithm>
#include <glm/common.hpp>

#include "core/generate/ellipsoids/formations.h"
#include "core/generate/ellipsoids/lattice.h"
#include "core/generate/ellipsoids/texture.h"
#include "core/generate/models.h"

namespace awan {
namespace {

// Six Gaussians that touch the box from inside, one at the middle of each face.
void add_box(const glm::dvec3& center, const glm::dvec3& half, double density,
             ReadyParticles& particles) {
    const double radius = std::min({half.x, half.y, half.z});
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 p = center;
            p[axis] += side * (half[axis] - radius);
            particles.positions.push_back(p);
            particles.radii.push_back(static_cast<float>(radius));
            particles.densities.push_back(static_cast<float>(density));
        }
}

ModelParticles coarse_particles(const EllipsoidsCloud& cloud,
                                const std::vector<PlacedEllipsoid>& ellipsoids) {
    ModelParticles made;
    // All of some ellipsoids one by one; of many only the box around them.
    constexpr std::size_t kOneByOne = 64;
    if (ellipsoids.size() <= kOneByOne) {
        for (const PlacedEllipsoid& one : ellipsoids)
            add_box(one.center, one.half_box(), cloud.density, made.particles);
    } else {
        glm::dvec3 low = ellipsoids[0].center, high = low;
        for (const PlacedEllipsoid& one : ellipsoids) {
            low = glm::min(low, one.center - one.half_box());
            high = glm::max(high, one.center + one.half_box());
        }
        add_box(0.5 * (low + high), 0.5 * (high - low), cloud.density, made.particles);
    }
    if (cloud.plane) {
        const SkyPlane& plane = *cloud.plane;
        const double cell = plane.extent / static_cast<double>(plane.resolution);
        add_box({0, plane.altitude, 0},
                {plane.extent / 2, std::max(plane.thickness, cell) / 2, plane.extent / 2},
                plane.density, made.particles);
    }
    return made;
}

}  // namespace

Result<ModelParticles> ellipsoids_particles(const EllipsoidsCloud& cloud,
                                            const ModelRequest& request, const Deadline& deadline) {
    const std::vector<PlacedEllipsoid> ellipsoids = placed_ellipsoids(cloud, request.key);
    if (request.coarse) return coarse_particles(cloud, ellipsoids);
    ModelParticles made;
    const glm::dvec3 shift = request.time * cloud.drift;
    if (!ellipsoids.empty()) {
        const TextureFunction texture = texture_function(cloud.texture, true, shift);
        const OpacityLattice lattice =
            lattice_of(ellipsoids, cloud.resolution, texture, request.threads, deadline);
        made.error = sampling_error(lattice, ellipsoids, texture, request.threads, deadline);
        if (auto error = deadline.over()) return *error;
        add_particles(lattice, cloud.density, made.particles);
    }
    if (cloud.plane) {
        const TextureFunction texture = texture_function(cloud.plane->texture, false, shift);
        const OpacityLattice lattice = lattice_of(*cloud.plane, texture, request.threads, deadline);
        if (auto error = deadline.over()) return *error;
        add_particles(lattice, cloud.plane->density, made.particles);
    }
    return made;
}

}  // namespace awan
