// What merging (core/survey/merge.h) does to light on its way.
#pragma once

#include <vector>

#include "core/survey/merge_lattice.h"

namespace awan {

// A ray from a point within the matter.
struct MergeRay {
    glm::dvec3 from{0}, direction{0};  // scene units; unit
};

// Rays from particles that are drawn by their masses, towards the sun and into six directions around, by turns: those
// from which a camera may look. The same whatever the scene's own camera is, so that light can be kept while it moves.
std::vector<MergeRay> merge_rays(const ParticleSet& particles, const glm::dvec3& to_sun);

// The transmittance of each ray through the particles of all blocks.
std::vector<float> transmittances(const ParticleSet& particles, const MergeBlocks& blocks,
                                  const std::vector<MergeRay>& rays, int threads);
// The same, block by block of so many particles in their order.
MergeBlocks in_their_order(const ParticleSet& particles);

// The error of a picture, as root mean square over its own, by how much transmittances differ: from above, in all that
// was tried (merge_test).
double error_of_merging(const std::vector<float>& exact, const std::vector<float>& merged);

}  // namespace awan
