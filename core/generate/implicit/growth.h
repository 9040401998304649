// The particle system of a growing cloud (Ebert 2002, "Implicit primitive animation"): its particles are primitives.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// A particle of the growth at one time.
struct GrownParticle {
    // From the growth's centre, in radii.
    glm::dvec3 position{0};
    // In radii a second.
    glm::dvec3 velocity{0};
    // When it is full-grown, in radii.
    double size = 1;
    // Seconds. Seeds are born before 0, so that they show at 0.
    double birth = 0;
    // 0..1: how far it has grown.
    double share = 0;
    // It has come to rest, and stays for ever.
    bool dormant = false;
    // Rises with the turbulence; at 1 the particle has a child.
    double fertility = 0;
    std::uint64_t key = 0;
};

// The growth's duration is divided into this many equal steps from time 0 on, whatever time is asked for.
inline constexpr int kGrowthSteps = 240;
// No particle comes farther from the centre along an axis than this, in radii.
inline constexpr double kGrowthReach = 150;

// All particles that there are at `time` (before 0: as at 0; after the duration: as at its end), in the order of
// their birth. A particle once born is in every later answer, at the same index. It depends on the growth, the key
// and the time alone: the steps are always those from time 0, and between two of them places are interpolated.
// What acts on them changes by the growth's keys, smoothly or straight.
std::vector<GrownParticle> grown(const ImplicitGrowth& growth, std::uint64_t key, double time,
                                 bool smooth = true);

// What the whole colony is at a time, its keys followed.
struct ColonySeen {
    glm::dvec3 center{0};
    double radius = 1, weight = 1;
};
ColonySeen colony_seen(const ImplicitGrowth& growth, bool smooth, double time);

// A particle as an element. Its weight and radius grow with its share.
Element element_of(const GrownParticle& particle, const ColonySeen& seen, const Frame& frame);

// A box around all particles at all times, units.
Box growth_box(const ImplicitGrowth& growth, std::uint64_t key, bool smooth = true);

}  // namespace awan::implicit
