#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace awan {

struct DetailField;

// How a particle that is a billboard is painted.
struct Paint {
    // The place of its texture in textures_of(scene), counted from 1; 0: it is not painted.
    std::uint8_t texture = 0;
    // The texture is seen from behind: left is right.
    bool mirrored = false;
    // By how much it is turned about the line of sight, of 65536 of a full turn.
    std::uint16_t turn = 0;
};

// Gaussian blobs of extinction: density * exp(-d^2 / (2 s^2)) per unit at distance d from the centre, s = radius / 2.
// A structure of arrays, all of one length; clouds and cubes in the order of the scene.
struct ParticleSet {
    // Scene units. In double, since a cloud may stand 1e9 units from the origin.
    std::vector<glm::dvec3> center;
    // Scene units, > 0.
    std::vector<float> radius;
    // Peak extinction, 1/unit, >= 0.
    std::vector<float> density;
    // 0..1, each multiplies the albedo. EMPTY when every particle is white.
    std::vector<glm::vec3> color;
    // What each is painted with (scene/texture.h). EMPTY when none is.
    std::vector<Paint> paint;
    // Structure finer than the particles (detail.h), for all rooms that see matter. Null where there is none: the
    // extinction is then the sum of the Gaussians.
    std::shared_ptr<const DetailField> detail;

    // Of each cloud of the scene, 1/unit: as given, or what was found for "auto".
    std::vector<double> cloud_density;
    // The first particle of each cloud, and the end of the last; EMPTY of merged ones.
    std::vector<std::size_t> cloud_begin;

    // Of procedural clouds (ModelParticles in models.h) the largest of their errors, or what merging costs; and what
    // tells sets apart that depend on the eye.
    double error = 0;
    std::uint64_t variant = 0;

    // Where these are many particles merged into fewer (core/survey/merge.h), those that they were made from, for who
    // wants to see the matter as it is; without detail. Null: these are as they are.
    std::shared_ptr<const ParticleSet> whole;

    std::size_t size() const { return center.size(); }
};

// An axis-aligned box.
struct Bounds {
    // Scene units; both 0 for an empty set.
    glm::dvec3 min{0}, max{0};
};

// The box around all centres, each widened by its radius (= 2 s, 95% of a particle's mass lies
// within).
Bounds bounds_of(const ParticleSet& particles);

}  // namespace awan
