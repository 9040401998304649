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

// What a model needs to know beside the cloud's description.
struct ModelRequest {
    // The key of all that is random in the cloud: keyed(seed, place in the scene).
    std::uint64_t key = 1;
    // Seconds, any finite number.
    double time = 0;
    int threads = 1;
    // Only where the cloud lies matters, not how it looks: some hundred particles of the right bounds will do.
    bool coarse = false;
    // How finely the cloud will be seen: the angle of a pixel, radians (0: as finely as can be), and the eye, in the
    // cloud's own coordinates. Without an eye: from where the automatic camera will stand (core/survey/survey.h), the
    // whole cloud in the picture.
    double pixel_angle = 0;
    std::optional<glm::dvec3> eye;
    // The cloud's number in the scene.
    std::uint64_t place = 0;
    // The cloud's density or else the scene's: extinction, 1/unit.
    double density = 1;
};

// What a model makes.
struct ModelParticles {
    // Their densities multiply the cloud's density; their colours are empty.
    ReadyParticles particles;
    // Whether their densities are extinctions instead, 1/unit, whatever the cloud's density is.
    bool extinctions = false;
    // The error of what was left out or made coarser than the description says, as root mean square of a picture over
    // that of the picture; 0: nothing was.
    double error = 0;
    // Not 0 where the particles depend on the eye. It tells such sets apart from those of other eyes.
    std::uint64_t variant = 0;
};

// One function a model, in its own folder. Errors: kOverDeadline, kCancelled; of an automaton also kInvalidScene, when
// it is to go on from the state of another cloud.
namespace automaton {
Result<ModelParticles> make_particles(const AutomatonCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline);

// What makes the clouds of its ellipsoids `depth` deep in the mean, along vertical lines, within a factor of two: the
// extinction of a cell full of cloud, 1/unit. By its description alone, so that it is the same at every step. 0: no
// cloud grows in any of them.
//
// In the long run as many cells of an ellipsoid become clouds as vanish. Vapour comes with probability p F(d) a step
// and soon condenses, clouds vanish with e (1 - F(d)): so p F / (p F + e (1 - F)) of the cells at distance d are
// clouds.
double density_for_depth(const AutomatonCloud& cloud, std::uint64_t key, double depth);
}  // namespace automaton
namespace spheres {
Result<ModelParticles> make_particles(const SpheresCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline);
}
namespace implicit {
Result<ModelParticles> make_particles(const ImplicitCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline);
}
namespace ellipsoids {
Result<ModelParticles> make_particles(const EllipsoidsCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline);
}

// cloud: one that is_procedural().
Result<ModelParticles> model_particles(const Cloud& cloud, const ModelRequest& request,
                                       const Deadline& deadline);

}  // namespace awan
