// The particle system of a growing cloud (document 004, "Implicit primitive animation"): particles are primitives.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/scene/implicit.h"

namespace awan {

struct GrownParticle {
    // Radii, from the growth's centre.
    glm::dvec3 position{0};
    // Radii a second.
    glm::dvec3 velocity{0};
    // Full-grown, radii.
    double size = 1;
    // Seconds; of seeds before 0, so that they show at 0.
    double birth = 0;
    // 0..1: how far it has grown.
    double share = 0;
    // At rest for ever; it stays.
    bool dormant = false;
    // A child at 1.
    double fertility = 0;
    std::uint64_t key = 0;
};

// From time 0 on there are this many equal steps in the growth's duration, whatever time is asked for.
inline constexpr int kGrowthSteps = 240;
// No particle comes farther from the centre along an axis, radii.
inline constexpr double kGrowthReach = 150;

// All particles there are at `time` (before 0: as at 0; after the duration: as at its end), in the order of their
// birth. A particle once born is in every later answer, at the same index. Depends on the growth, the key and the time
// alone: the steps are always those from time 0, and between two of them places are interpolated.
std::vector<GrownParticle> grown(const ImplicitGrowth& growth, std::uint64_t key, double time);

// As an element; its weight and radius grow with its share.
Element element_of(const GrownParticle& particle, const ImplicitGrowth& growth, const Frame& frame);

// Around all particles at all times, units.
Box growth_box(const ImplicitGrowth& growth, std::uint64_t key);

}  // namespace awan
