// The models that make particles by a procedure of their own: from a cloud's description to Gaussians (particle_set.h)
// in the cloud's own coordinates, before its scale, rotate_y, translate and velocity. Pure, seeded, the same for every
// number of threads. Each bounds its own work and particles by the limits on its fields (core/scene/limits.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "core/base/deadline.h"
#include "core/base/result.h"
#include "core/scene/scene.h"

namespace awan {

struct ModelRequest {
    // Of all that is random in it: keyed(seed, place in the scene).
    std::uint64_t key = 1;
    // Seconds, any finite number.
    double time = 0;
    int threads = 1;
    // Only where the cloud lies matters, not how it looks: some hundred particles of the right bounds will do.
    bool coarse = false;
    // How finely it will be seen: the angle of a pixel, radians (0: as finely as can be), from the eye, in the cloud's
    // own coordinates; none: from where the automatic camera will stand (core/survey/survey.h), the whole cloud in the
    // picture.
    double pixel_angle = 0;
    std::optional<glm::dvec3> eye;
    // The cloud's number in the scene.
    std::uint64_t place = 0;
    // The cloud's or else the scene's: extinction, 1/unit.
    double density = 1;
};

struct ModelParticles {
    // Densities multiply the cloud's density; colours are empty.
    ReadyParticles particles;
    // Densities are extinctions, 1/unit, whatever the cloud's density is.
    bool extinctions = false;
    // Relative error, rms over rms of a picture, of what was left out or made coarser than the description says; 0:
    // none.
    double error = 0;
    // Not 0 where the particles depend on the eye: tells such sets apart.
    std::uint64_t variant = 0;
};

Result<ModelParticles> automaton_particles(const AutomatonCloud& cloud, const ModelRequest& request,
                                           const Deadline& deadline);
Result<ModelParticles> spheres_particles(const SpheresCloud& cloud, const ModelRequest& request,
                                         const Deadline& deadline);
Result<ModelParticles> implicit_particles(const ImplicitCloud& cloud, const ModelRequest& request,
                                          const Deadline& deadline);
Result<ModelParticles> ellipsoids_particles(const EllipsoidsCloud& cloud,
                                            const ModelRequest& request, const Deadline& deadline);

// Of a cloud that is_procedural().
Result<ModelParticles> model_particles(const Cloud& cloud, const ModelRequest& request,
                                       const Deadline& deadline);

}  // namespace awan
