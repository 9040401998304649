// The rays by which a pixel's area is seen: a pixel shows the mean of what they show.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/survey/survey.h"

namespace awan::truth {

struct AreaRay {
    glm::dvec3 direction;  // unit
    double share;          // of the pixel, that it stands for
    double depth;  // optical, of the particles without their detail; 0 where it is not wanted
};

struct AreaRays {
    std::vector<AreaRay> rays;
    // Whether some stand at random: another seed would give others.
    bool random = false;
};

// Where every particle is wide beside a pixel, its middle; else the 2 x 2 points of Gauss and Legendre's rule. Where
// particles are narrower than the pixel it is divided as a quadtree until they are wide beside its parts, or there are
// more than `most_parts` (at most four times as many): then, four rays stand at random in each, and what they miss is
// noise. Parts without matter have no rays: shares may sum to less than 1.
//
// near: the particles that the pixel's rays may meet; smallest: least s of what else is seen in the matter, scene units
// (bumps of detail; they ask for the 2 x 2 points at most, since they are left out where they are below a pixel);
// end(direction): how far a ray goes, scene units; null: its depth is not wanted.
AreaRays area_rays(const View& view, int width, int height, int x, int y, const ParticleSet& near,
                   std::size_t most_parts, double smallest,
                   const std::function<double(const glm::dvec3&)>& end, std::uint64_t seed);

}  // namespace awan::truth
