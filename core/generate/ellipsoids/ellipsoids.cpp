// Ellipsoids and a sky plane as matter: where Gardner 1985 makes a surface more or less translucent, the extinction
// is more or less.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/generate/ellipsoids/formations.h"
#include "core/generate/ellipsoids/lattice.h"
#include "core/generate/ellipsoids/texture.h"
#include "core/generate/models.h"

namespace awan::ellipsoids {
namespace {

void add_one(const glm::dvec3& p, double radius, double density, ReadyParticles& particles) {
    particles.positions.push_back(p);
    particles.radii.push_back(static_cast<float>(radius));
    particles.densities.push_back(static_cast<float>(density));
}

// Particles that touch the ellipsoid from inside, at the ends of its axes and between them. They give its bounds
// within a tenth, however the cloud is turned.
void add_outline(const PlacedEllipsoid& one, double density, ReadyParticles& particles) {
    constexpr double kInset = 0.1;
    const double radius = kInset * std::min({one.radii.x, one.radii.y, one.radii.z});
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const int used = x * x + y * y + z * z;
                if (used != 1 && used != 3) continue;
                const double length = (1 - kInset) / std::sqrt(static_cast<double>(used));
                add_one(one.from_unit(length * glm::dvec3(x, y, z)), radius, density, particles);
            }
}

// Particles at the corners of the plane's slab.
void add_corners(const SkyPlane& plane, ReadyParticles& particles) {
    const double half = plane.extent / 2;
    const double radius =
        0.5 * std::max(plane.thickness, plane.extent / static_cast<double>(plane.resolution));
    for (const double x : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0})
            add_one({x * (half - radius), plane.altitude, z * (half - radius)}, radius,
                    plane.density, particles);
}

void append(const ReadyParticles& more, ReadyParticles& all) {
    all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
    all.radii.insert(all.radii.end(), more.radii.begin(), more.radii.end());
    all.densities.insert(all.densities.end(), more.densities.begin(), more.densities.end());
}

ModelParticles coarse_particles(const EllipsoidsCloud& cloud,
                                const std::vector<PlacedEllipsoid>& ellipsoids) {
    ModelParticles made;
    // Of more ellipsoids than this, one round particle each will do.
    constexpr std::size_t kFew = 64;
    for (const PlacedEllipsoid& one : ellipsoids) {
        if (ellipsoids.size() <= kFew) {
            add_outline(one, cloud.density, made.particles);
        } else {
            add_one(one.center, std::max({one.radii.x, one.radii.y, one.radii.z}), cloud.density,
                    made.particles);
        }
    }
    if (cloud.plane) add_corners(*cloud.plane, made.particles);
    return made;
}

}  // namespace

Result<ModelParticles> make_particles(const EllipsoidsCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline) {
    const std::vector<PlacedEllipsoid> ellipsoids = placed_ellipsoids(cloud, request.key);
    if (request.coarse) return coarse_particles(cloud, ellipsoids);
    ModelParticles made;
    const glm::dvec3 shift = request.time * cloud.drift;
    if (!ellipsoids.empty()) {
        const TextureFunction texture = texture_function(cloud.texture, true, shift);
        const LatticeField opacity = opacity_of(ellipsoids, cloud.join, cloud.resolution, texture,
                                                request.threads, deadline);
        if (auto error = deadline.over()) return *error;
        made.particles = particles_of(opacity, cloud.density, request.threads);
        made.error = sampling_error(opacity, made.particles, cloud.density, ellipsoids, cloud.join,
                                    texture, request.threads, deadline);
    }
    if (cloud.plane) {
        const PlaneTexture texture = plane_texture(*cloud.plane, shift);
        const LatticeField opacity = opacity_of(*cloud.plane, texture, request.threads, deadline);
        if (auto error = deadline.over()) return *error;
        const ReadyParticles particles =
            particles_of(opacity, cloud.plane->density, request.threads);
        made.error =
            std::max(made.error, sampling_error(opacity, particles, cloud.plane->density,
                                                *cloud.plane, texture, request.threads, deadline));
        append(particles, made.particles);
    }
    if (auto error = deadline.over()) return *error;
    return made;
}

}  // namespace awan::ellipsoids
